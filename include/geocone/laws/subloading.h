// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_subloading_h
#define geocone_laws_subloading_h

#include <geocone/base/choice.h>
#include <geocone/kernels/subloading_model.h>
#include <geocone/materials/constitutive_law.h>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Subloading soil model (SubloadingModel) as a constitutive law for explicit
   * steps. It describes anisotropy, cyclic behaviour, structure and
   * non-associated flow. With default parameters the law is Modified Cam-Clay
   * with a subloading surface. Tension is positive in this interface,
   * compression in the model.
   *
   * History of a point, components without Mandel factors: stress_zz, in the
   * plane only; the similarity centre a (xx, yy, zz, xy, in three dimensions
   * also yz, zx), tension positive; the rotation beta in the same components;
   * the size pcb; the structure ratio Rb.
   */
  class Subloading : public ConstitutiveLaw
  {
  public:
    /** Declares the parameters of the subloading model. @param section name of
     *  the parameter section, e.g. "Materials/soil" */
    explicit Subloading(const std::string &section);

    void
    prepare() override;

    bool
    set_axisymmetric() override
    {
      return true;
    }

    void
    advance(const PointBlock &block, LawCounts &counts) const override;

    unsigned int
    n_history() const override
    {
      return (dim == 2) + 2 * n_spatial + 2;
    }

    std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const override;

    double
    wave_modulus(const Stress &stress, const double *history) const override;

    /** Earth pressure coefficient at rest by Jaky's formula 1 - sin(phi), with
     *  sin(phi) = 3 Mc/(6 + Mc). */
    double
    earth_pressure_at_rest() const override
    {
      return 1. - 3. * c.Mc / (6. + c.Mc);
    }

    double
    stress_zz(const Components &, const double *history) const override
    {
      return history[0];
    }

    std::vector<OutputQuantity>
    output_quantities() const override;

    void
    output(const Components &stress,
           const double     *history,
           double           *values) const override;

    std::vector<YieldCurve>
    yield_curves(const Components   &stress,
                 const double       *history,
                 const SectionPlane &plane) const override;

    /** @name Model and state of one point with n = 4 or 6 stress components,
     *  compression positive */
    /** @{ */
    template <int n>
    const SubloadingModel<n> &
    model() const
    {
      if constexpr (n == 4)
        return in_plane;
      else
        return in_space;
    }

    /**
     * Computes the initial state variables for a given stress (Pa) from the
     * parameters. The similarity centre is a = chi sigma; beta and Rb are
     * given; pcb is given or follows from the overconsolidation ratio.
     * @return a note on values that had to be changed, or empty
     * @throws InputError if no such state exists
     */
    template <int n>
    std::string
    initial_state(const typename SubloadingModel<n>::Vector &stress,
                  SubloadingState<n>                        &state) const;

    /** State variables of the subloading model at a point.
     *  @param stress tension positive */
    SubloadingState<n_spatial>
    state(const Components &stress, const double *history) const;
    /** @} */

  private:
    void
    check_constants() const;
    void
    check_initial() const;

    /** Pressure that multiplies the rotation tensor beta, selected by a
     *  parameter. */
    enum class Rotation
    {
      p,
      ph
    };

    enum class Outside
    {
      refuse,
      raise_size
    };

    SubloadingConstants c;
    Choice<Rotation>    rotation = {{{"p", Rotation::p}, {"ph", Rotation::ph}}};

    double              ocr        = 1.;
    double              given_size = 0.;
    double              chi        = 0.;
    double              zeta       = 0.;
    std::vector<double> given_beta = {0., 0., 0., 0.};
    std::vector<double> given_centre; ///< tension positive; empty: chi sigma
    bool                output_tensors = false;
    double              initial_Rb   = 1.;

    Choice<Outside> if_outside = {
      {{"refuse", Outside::refuse}, {"raise size", Outside::raise_size}}};

    SubloadingModel<4> in_plane;
    SubloadingModel<6> in_space;
  };

  extern template std::string
  Subloading::initial_state<4>(const SubloadingModel<4>::Vector &,
                               SubloadingState<4> &) const;
  extern template std::string
  Subloading::initial_state<6>(const SubloadingModel<6>::Vector &,
                               SubloadingState<6> &) const;
} // namespace geocone::GEOCONE_DIM

#endif
