// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_initial_state_h
#define geocone_scene_initial_state_h

#include <geocone/base/choice.h>
#include <geocone/boundary/loading.h>
#include <geocone/functions/expression.h>
#include <geocone/geometry/regions.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  class Water;

  /** Initial velocity field: zero, or given by formulas. */
  class InitialVelocity : public dealii::ParameterAcceptor
  {
  public:
    InitialVelocity();

    void
    prepare();

    dealii::Tensor<1, dim>
    at(const dealii::Point<dim> &x) const;

    /** Returns the initial velocity gradient dv_i/dx_j (1/s) by central
     *  differences. The step is the size of a material point (m). The result is
     *  exact for a linear velocity field. */
    dealii::Tensor<2, dim>
    gradient(const dealii::Point<dim> &x, const double size) const;

    /** Returns true if the initial velocity is not identically zero. */
    bool
    is_given() const;

  private:
    std::array<std::string, dim> texts;
    std::array<Expression, dim>  components;
  };

  /**
   * Initial stress field: zero, given by formulas, or geostatic. Geostatic
   * stresses are
   *   s_yy = -(surcharge + integral of rho |g| from y to the surface - u),
   *   s_xx = K0 s_yy, s_xy = 0,
   * with the densities of the materials above, and with u the difference of the
   * hydrostatic pressure between y and the surface. K0 is given, or computed by
   * the law of each material (ConstitutiveLaw::earth_pressure_at_rest()).
   * Materials that a stage adds have neither stress nor weight initially.
   */
  class InitialStress : public dealii::ParameterAcceptor
  {
  public:
    InitialStress();

    void
    prepare(const Gravity          &gravity,
            const Geometry         &geometry,
            const Regions          &regions,
            const Water            &water,
            const std::vector<int> &stage_that_adds);

    /** Returns the initial stress (Pa) of a material at the point x. */
    Mandel
    at(const dealii::Point<dim> &x,
       const unsigned int        material,
       const Materials          &materials,
       const Regions            &regions) const;

    /** Returns the initial out-of-plane stress s_zz (Pa): s_xx, unless given by
     *  a formula. Plane-strain laws store s_zz, but do not depend on it. */
    double
    zz_at(const dealii::Point<dim> &x,
          const unsigned int        material,
          const Mandel             &in_plane) const;

  private:
    /** Reads the coefficient of earth pressure at rest, K0. @throws
     *  InputError */
    void
    prepare_k0();

    /** Checks that the ground before the first stage is level and not above
     *  the surface level. @throws InputError */
    void
    check_level_ground(const Geometry &geometry, const Regions &regions) const;

    /** Checks that the water table is horizontal. @throws InputError */
    void
    check_level_water() const;

    enum class Type
    {
      zero,
      given,
      geostatic
    };
    Choice<Type> type     = {{{"zero", Type::zero},
                              {"given", Type::given},
                              {"geostatic", Type::geostatic}}};
    Choice<Type> of_added = {{{"zero", Type::zero},
                              {"given", Type::given},
                              {"geostatic", Type::geostatic}}};

    /** Returns how the initial stress in a material is defined: zero, by
     *  formulas or geostatic. */
    Type
    type_of(const unsigned int material) const
    {
      return stage_of[material] < 0 ? type.get() : of_added.get();
    }

    /** Returns true if a stage adds material whose initial stress has the given
     *  type. */
    bool
    adds(const Type one) const;

    /** Checks that gravity and material regions allow a geostatic stress state.
     *  @throws InputError if the weight of a column of soil is not defined */
    void
    check_geostatic(const std::string &parameter,
                    const std::string &word,
                    const Gravity     &gravity,
                    const Regions     &regions) const;

    /** Returns the vertical effective stress (Pa) at x due to the weight of the
     *  soil above.
     *  @param stage stage that adds the soil; -1: the initially present soil */
    double
    vertical_stress(const dealii::Point<dim> &x,
                    const int                 stage,
                    const Materials          &materials,
                    const Regions            &regions) const;

    std::array<std::string, n_mandel> texts;
    std::array<Expression, n_mandel>  components;
    std::string                       text_zz; ///< formula of s_zz
    Expression                        component_zz;
    std::string                       k0_text = "0.5";
    std::optional<double>             k0; ///< no value: K0 of each material
    double                            surface   = 0.;
    double                            surcharge = 0.;
    double                            g         = 0.;
    const Water                      *water = nullptr; ///< null without water
    /** For each material, the index of the stage that adds the material,
     *  counted from 0; -1 for initially present materials. */
    std::vector<int> stage_of;
    double           top = 0.; ///< y of the top of the body (m)
  };
} // namespace geocone::GEOCONE_DIM

#endif
