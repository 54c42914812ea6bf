// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_spatial_mohr_coulomb_h
#define geocone_laws_spatial_mohr_coulomb_h

#include <geocone/laws/spatial_law.h>

#include <Eigen/Dense>

#include <limits>

namespace geocone::GEOCONE_DIM
{
  /**
   * Three-dimensional Mohr-Coulomb law. With s_1 >= s_2 >= s_3, the yield
   * condition for each pair i < j is
   *   f_ij = s_i - s_j + (s_i + s_j) sin(phi) - 2 c cos(phi) <= 0,
   * and the plastic potential is the same pyramid for theta. MohrCoulomb is its
   * in-plane pair in plane strain; this law also yields on edges of the pyramid
   * where s_zz is the largest or the smallest stress.
   *
   * Return map in principal stresses: onto the plane f_13 = 0; if this violates
   * the order of the stresses, to the edge f_13 = f_12 = 0 (s_2 = s_3) or f_13
   * = f_23 = 0 (s_1 = s_2); if the order is still violated, to the apex s_i = c
   * cot(phi) (de Souza Neto, Peric and Owen 2008, section 8.2). All three are
   * linear in the trial stress, and so are their derivatives; the principal
   * directions are those of the trial stress. Friction with memory
   * (FrictionMemory) leads to another pyramid with the same flow: a part of s_1
   * + s_3, times sin(phi) - sin(theta), is replaced by -2 p.
   */
  class SpatialMohrCoulomb : public FrictionalSpatialLaw
  {
  public:
    explicit SpatialMohrCoulomb(const std::string &section)
      : FrictionalSpatialLaw(section)
    {
      declare_tension();
    }

    std::optional<FrictionalStrength>
    plane_strain_strength() const override
    {
      return given;
    }

    /** Degree of non-associativity (sin(phi) - sin(theta))/sin(phi). */
    double
    non_associativity() const override;
    bool
    dilates() const override
    {
      return sin_theta > 0.;
    }

    /** Explicit stress update of a block of points by a vectorised kernel. */
    void
    advance(const PointBlock &block, LawCounts &counts) const override;

    std::optional<double>
    yield_function(const SpatialMandel &stress,
                   const double        *history) const override;

    void
    set_friction_memory(const double tau) override;

    bool
    has_natural_map() const override
    {
      return dim == 3;
    }

    std::optional<Projection>
    project_natural_map(const Mandel   &s,
                        const Mandel   &z,
                        const double    rho,
                        const Mandel   &stress_n,
                        const double   *history_n,
                        const StepData &step) const override;

    double
    excess_work_density(const SpatialMandel &plastic_strain,
                        const SpatialMandel &stress,
                        const double        *history) const override;

  protected:
    /** @param documentation of the cohesion */
    SpatialMohrCoulomb(const std::string &section,
                       const std::string &documentation)
      : FrictionalSpatialLaw(section, documentation)
    {
      declare_tension();
    }

    void
    set_strength(const double F) override;

    FlowCheck
    check_plastic_strain(const SpatialMandel &plastic_strain,
                         const SpatialMandel &stress,
                         const OwnStrength   &own) const override;

    /** Normal stress -(s_1 + s_3)/2 at the centre of the largest Mohr circle
     *  (Pa). */
    double
    normal_stress(const SpatialMandel &stress) const override;

    Mode
    return_to_strength(const SpatialMandel &trial,
                       const OwnStrength   &own,
                       SpatialMandel       &stress,
                       SpatialMandelMatrix *tangent) const override;

  private:
    /** Declares the tensile strength in three dimensions, where bounds of limit
     *  loads use it and steps refuse it (Scene::prepare()). */
    void
    declare_tension()
    {
      if constexpr (dim == 3)
        given.declare_tension(*this);
    }

    using Principal       = Eigen::Vector3d;
    using PrincipalMatrix = Eigen::Matrix3d;

    /** Mohr-Coulomb pyramid with the yield functions f_ij = s_i - s_j + (s_i +
     *  s_j) sin(phi) - 2 c cos(phi) of principal stresses. */
    struct Pyramid
    {
      double sine, size; ///< sin(phi) (-), 2 c cos(phi) (Pa)

      double
      apex() const
      {
        return sine > 0. ? size / (2. * sine)
                         : std::numeric_limits<double>::infinity();
      }

      /** Largest of the Mohr-Coulomb yield functions, f_13 (Pa), for principal
       *  stresses s sorted in decreasing order. */
      double
      yield_function(const Principal &s) const
      {
        return s[0] - s[2] + (s[0] + s[2]) * sine - size;
      }

      /**
       * Returns true if a stress lies in the circular cone inscribed in the
       * pyramid. The test requires no principal stresses: f_13 <= 2 sqrt(J_2 (1
       * + sine^2/3)) + 2 p sine - size over all Lode angles, with p = tr(s)/3
       * and J_2 = |dev s|^2/2.
       */
      bool
      holds_cone(const SpatialMandel &stress) const
      {
        const double p  = trace(stress) / 3.;
        const double J2 = (stress.squaredNorm() - 3. * p * p) / 2.;
        const double q  = size - 2. * p * sine;
        return q > 0. && 4. * J2 * (1. + sine * sine / 3.) <= q * q;
      }
    };

    /** Mohr-Coulomb pyramid after an increase of the cohesion by @p cohesion
     *  (Pa). */
    Pyramid
    pyramid_with(const double cohesion) const
    {
      return {exact.sine, exact.size + size_per_cohesion * cohesion};
    }

    /** Mohr-Coulomb pyramid of a step with friction memory, i.e. with delayed
     *  normal stress. Part of the normal stress in the strength is the delayed
     *  normal stress, as in FlowCone::delayed(). */
    Pyramid
    delayed(const OwnStrength &own) const;

    /** Result of de Saxce's change of variable: tensor y, and sums of the
     *  positive and of the negative principal values of y. */
    struct Normal
    {
      SpatialMandel whole;
      double        plus = 0., minus = 0.;
    };

    /**
     * De Saxce's change of variable for the Mohr-Coulomb pyramid. Flow
     * directions of the pyramid for theta are mapped to normals of the pyramid
     * for phi by
     *   y_i = e_i (1 + sin(phi))/(1 + sin(theta))   if e_i > 0,
     *   y_i = e_i (1 - sin(phi))/(1 - sin(theta))   if e_i < 0,
     * for the principal values e_i of the plastic strain increment, in its
     * principal axes (doc/theory/laws.md).
     * @param[out] slope dy/de, or null
     */
    Normal
    normal_of(const SpatialMandel &plastic_strain,
              const Pyramid       &pyramid,
              SpatialMandelMatrix *slope) const;

    /** Return mapping of one material point. @param flow sine of the dilatancy
     *  angle
     *  @param[out] tangent ds/de, or null */
    static Mode
    return_to(const Elasticity    &elastic,
              const Pyramid       &pyramid,
              const double         flow,
              const SpatialMandel &trial,
              SpatialMandel       &stress,
              SpatialMandelMatrix *tangent);

    /** Projects a stress onto a Mohr-Coulomb pyramid by the associated return
     *  mapping with unit stiffness. */
    static Mode
    project(const Pyramid       &pyramid,
            const SpatialMandel &x,
            SpatialMandel       &projected,
            SpatialMandelMatrix *slope)
    {
      return return_to(
        Elasticity(1., 0.), pyramid, pyramid.sine, x, projected, slope);
    }

    /** Return mapping in ordered principal stresses; see return_to().
     *  @param flow sine of the dilatancy angle
     *  @param[out] tangent ds/de of principal values */
    static Mode
    return_principal(const Elasticity &elastic,
                     const Pyramid    &strength,
                     const double      flow,
                     const Principal  &trial,
                     Principal        &stress,
                     PrincipalMatrix  &tangent);

    Pyramid exact             = {0., 0.}; ///< with sin(phi)
    double  sin_theta         = 0.;
    double  size_per_cohesion = 0.; ///< d(size)/dc after reduction (-)
  };

  /** Three-dimensional Tresca law, s_1 - s_3 <= 2c. */
  class SpatialTresca : public SpatialMohrCoulomb
  {
  public:
    explicit SpatialTresca(const std::string &section)
      : SpatialMohrCoulomb(section, "Undrained shear strength c (Pa), > 0.")
    {}
  };
} // namespace geocone::GEOCONE_DIM

#endif
