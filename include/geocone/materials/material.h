// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_material_h
#define geocone_materials_material_h

#include <geocone/base/types.h>
#include <geocone/materials/constitutive_law.h>
#include <geocone/materials/elasticity.h>
#include <geocone/materials/second_order_cone.h>

#include <deal.II/base/array_view.h>
#include <optional>
#include <string>

namespace geocone
{
  /** What a batch of points asks of its material: the same index, one point. */
  struct Increment
  {
    dealii::ArrayView<const Mandel> strain;   ///< strain increments of the step
    dealii::ArrayView<const Mandel> stress_n; ///< stress at t_n (Pa)

    /**
     * Part of the normal stress on which strength depends that is taken from
     * t_n: 0 is the exact law, 1 makes it explicit (doc/theory.md, section
     * "Delayed friction"). Laws without friction have no use for it.
     */
    double friction_lag = 0.;
  };

  /** What the material answers. An empty `tangent` is not computed. */
  struct Response
  {
    dealii::ArrayView<Mandel>       stress;  ///< stress at t_{n+1} (Pa)
    dealii::ArrayView<Mode>         mode;    ///< elastic, cone or apex
    dealii::ArrayView<MandelMatrix> tangent; ///< ds/de, generalised (Pa)
  };

  /**
   * A constitutive law in closed form, which all methods can use: a pure function
   * of a batch of strain increments and states at t_n, with isotropic linear
   * elasticity.
   *
   * Parameters of the base: density (kg/m^3), Young modulus (Pa), Poisson ratio.
   */
  class Material : public ConstitutiveLaw
  {
  public:
    /** @param section e.g. "Materials/soil" */
    explicit Material(const std::string &section);

    /** Checks the parameters and computes what derives from them. */
    void
    prepare() override;

    /** The law, for all points of the batch. */
    virtual void
    update(const Increment &increment, const Response &response) const = 0;

    /**
     * Jaky's 1 - a = 1 - sin(phi) where there is a cone, which lies in it: it
     * bears K0 >= (1 - a)/(1 + a) - 2 c cos(phi)/((1 + a) |s_yy|), Rankine's
     * active pressure. Otherwise nu/(1 - nu), uniaxial strain.
     */
    double
    earth_pressure_at_rest() const override;

    /** An explicit step: by the cone's kernel if there is a cone, or else by
     *  update() of the turned stress. */
    void
    advance(const PointBlock &block, LawCounts &counts) const override;

    double
    wave_modulus(const Stress &stress, const double *history) const override;

    /**
     * The cone of a cone law, by which solutions are checked independently of
     * update(); nothing for laws without one.
     */
    virtual std::optional<FlowCone>
    flow_cone() const
    {
      return std::nullopt;
    }

    /**
     * (a - b)/a between 0 (associated: the tangent is symmetric) and 1 (no
     * dilatancy). A law without a cone whose tangent is not symmetric must
     * override this with a positive value.
     */
    virtual double
    non_associativity() const;

    const Elasticity &
    elasticity() const
    {
      return elastic;
    }

  private:
    double     young_modulus = 1e8;
    double     poisson_ratio = 0.3;
    Elasticity elastic;
  };
} // namespace geocone

#endif
