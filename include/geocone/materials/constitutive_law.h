// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_constitutive_law_h
#define geocone_materials_constitutive_law_h

#include <geocone/base/types.h>
#include <geocone/kernels/point_block.h>
#include <geocone/kernels/yield_curve.h>
#include <geocone/materials/frictional_strength.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * What every constitutive law can do: it has a density, and it carries points
   * along in explicit steps (advance()). Laws of closed form, which implicit
   * methods can use as well, derive from Material; laws with an integrator of
   * their own derive from this class. Each law is one unit in this folder with
   * its own parameters, and one line in material_library.cc.
   */
  class ConstitutiveLaw : public dealii::ParameterAcceptor
  {
  public:
    /** A whole stress, tension positive (Pa): xx, yy, zz, xy, which are all in
     *  plane strain, and in three dimensions yz, zx. */
    using Stress = std::array<double, n_spatial>;

    /** Stress components in the order of tensor_component, in the plane without
     *  zz (Pa). */
    using Components = std::array<double, n_mandel>;

    /** @param section e.g. "Materials/soil" */
    explicit ConstitutiveLaw(const std::string &section);

    /** Checks the parameters and computes what derives from them. */
    virtual void
    prepare();

    /** Mass density rho above the water (kg/m^3). */
    double
    density() const
    {
      return rho;
    }

    /** Mass density below the water (kg/m^3). */
    double
    saturated_density() const
    {
      return rho_saturated;
    }

    /** Takes the densities from the unit weights of the file. @param g (m/s^2)
     *  @throws InputError if there are any, and g is zero */
    void
    set_gravity(const double g);

    /** K_w/n (Pa) of the fluid in the pores of soil that is undrained: the excess
     *  pressure of a point grows by dp = -K_w/n tr(de). 0: drained. */
    double
    fluid_modulus() const
    {
      return pore_fluid;
    }

    /** What the fluid stores at an excess pressure, per volume (J/m^3). */
    double
    fluid_energy(const double pressure) const
    {
      return pore_fluid > 0. ? pressure * pressure / (2. * pore_fluid) : 0.;
    }

    /** Horizontal over vertical effective stress that the file gives, or 0. */
    double
    given_k0() const
    {
      return k0;
    }

    /**
     * K0 (-), the ratio of horizontal to vertical effective stress in level
     * ground that has never been strained sideways, and which the law can bear
     * at any depth. One is an isotropic state.
     */
    virtual double
    earth_pressure_at_rest() const
    {
      return 1.;
    }

    /** What Prandtl's load is that of in plane strain, of laws that have one. */
    virtual std::optional<FrictionalStrength>
    plane_strain_strength() const
    {
      return std::nullopt;
    }

    /** Says that there will be strain out of the plane. @return whether the law
     *  knows it */
    virtual bool
    set_axisymmetric()
    {
      return false;
    }

    /** @name Explicit steps */
    /** @{ */

    /**
     * One step of all points of a block: turns stress and tensorial history by
     * the exact rotation of the spin increment, then adds the response to the
     * strain increment sym(dt grad v).
     */
    virtual void
    advance(const PointBlock &block, LawCounts &counts) const = 0;

    /** Number of history variables of a point, which are the law's own affair. */
    virtual unsigned int
    n_history() const = 0;

    /**
     * The history of a point that has this stress, by the parameters of the law.
     * @param size in which strain localises there, that of a cell over the degree of
     * its functions (m), for laws that soften; 0: of a lone point, which is uniform
     * @param[out] history n_history() values
     * @return what had to be changed for it, or nothing
     * @throws InputError if the law cannot have this stress
     */
    virtual std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const = 0;

    /** Sets what of the history depends on where a point begins, before initialise().
     *  @throws InputError for a place where the law cannot be */
    virtual void
    take_place(const dealii::Point<dim> & /*place*/, double * /*history*/) const
    {}

    /** The size that a point was given by initialise(), of laws that need it (m). */
    virtual double
    size(const double * /*history*/) const
    {
      return 0.;
    }

    /** Out-of-plane stress s_zz of plane scenes (Pa). */
    virtual double
    stress_zz(const Components &stress, const double *history) const = 0;

    /** All of the stress of a point. */
    Stress
    whole(const Components &stress, const double *history) const;

    /** Modulus M of the elastic pressure wave, c = sqrt(M/rho) (Pa). */
    virtual double
    wave_modulus(const Stress &stress, const double *history) const = 0;

    /** What can be shown of the state beyond the components of the stress. */
    struct Shown
    {
      std::string name;  ///< of a field, e.g. "stress_zz"
      std::string title; ///< of a column, with its unit, e.g. "stress zz (Pa)"
    };
    virtual std::vector<Shown>
    shown() const = 0;

    /** Sections of the yield surfaces of a state, the outermost first; none where the
     *  law does not tell them. */
    virtual std::vector<YieldCurve>
    yield_curves(const Components & /*stress*/,
                 const double * /*history*/,
                 const SectionPlane & /*plane*/) const
    {
      return {};
    }

    /** The values for shown(). */
    virtual void
    show(const Components &stress,
         const double     *history,
         double           *values) const = 0;
    /** @} */

  protected:
    /** "Materials/soil/NAME", for messages; without a name, of the section. */
    std::string
    parameter(const std::string &name = "") const;

    /** @throws InputError for a constant that is not as it must be */
    void
    require(const bool         holds,
            const char        *name,
            const double       value,
            const std::string &allowed,
            const char        *remedy) const;

  private:
    double rho = 2000., rho_saturated = rho;
    double unit_weight = 0., saturated_unit_weight = 0.;
    double pore_fluid = 0., k0 = 0.;
  };

  /** One of what a law can show, or not a number if it cannot. */
  class ShownValue
  {
  public:
    ShownValue(const ConstitutiveLaw &law, const std::string &name);

    /** As ConstitutiveLaw::show(). */
    double
    operator()(const ConstitutiveLaw::Components &stress,
               const double                      *history);

  private:
    const ConstitutiveLaw *law;
    std::vector<double>    values;
    std::size_t            place = 0;
  };

  /** The components of a stress that is given as a Mandel vector (Pa). */
  inline ConstitutiveLaw::Stress
  stress_of(const SpatialMandel &t)
  {
    ConstitutiveLaw::Stress s = {{t[0], t[1], t[3], t[2] / sqrt2}};
    for (int i = 4; i < n_spatial; ++i)
      s[i] = t[i] / sqrt2;
    return s;
  }

  /** And back. */
  inline SpatialMandel
  spatial_of(const ConstitutiveLaw::Stress &s)
  {
    SpatialMandel t;
    t[0] = s[0];
    t[1] = s[1];
    t[2] = sqrt2 * s[3];
    t[3] = s[2];
    for (int i = 4; i < n_spatial; ++i)
      t[i] = sqrt2 * s[i];
    return t;
  }
} // namespace geocone::GEOCONE_DIM

#endif
