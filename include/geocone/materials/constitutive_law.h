// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_constitutive_law_h
#define geocone_materials_constitutive_law_h

#include <geocone/base/types.h>
#include <geocone/kernels/point_block.h>
#include <geocone/kernels/yield_curve.h>
#include <geocone/materials/frictional_strength.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone
{
  class Retention;
}

namespace geocone::GEOCONE_DIM
{
  /**
   * Base class of all constitutive laws, with mass density and explicit stress
   * update (advance()). Laws with a closed-form return mapping, which implicit
   * methods can also use, derive from Material; laws with their own stress
   * integration derive from this class. Each law is one unit in this folder
   * with its own parameters, and one line in material_library.cc.
   */
  class ConstitutiveLaw : public dealii::ParameterAcceptor
  {
  public:
    /** Components xx, yy, zz, xy and, in three dimensions, yz, zx of the full
     *  stress tensor (Pa), tension positive. */
    using Stress = std::array<double, n_spatial>;

    /** Stress components in the order of tensor_component (Pa); zz is omitted
     *  in plane problems. */
    using Components = std::array<double, n_mandel>;

    /** Declares the common parameters of all constitutive laws. @param section
     *  name of the parameter section, e.g. "Materials/soil" */
    explicit ConstitutiveLaw(const std::string &section);

    /** Checks the material parameters and computes the derived constants. */
    virtual void
    prepare();

    /** Mass density rho above the water table (kg/m^3). */
    double
    density() const
    {
      return rho;
    }

    /** Saturated mass density, below the water table (kg/m^3). */
    double
    saturated_density() const
    {
      return rho_saturated;
    }

    /** Computes the mass densities from the unit weights in the parameter file.
     *  @param g gravitational acceleration (m/s^2)
     *  @throws InputError for unit weights with zero gravity */
    void
    set_gravity(const double g);

    /** Bulk modulus K_w/n (Pa) of the pore fluid in undrained soil; 0 in
     *  drained soil. The excess pore pressure increases by dp = -K_w/n
     *  tr(de). */
    double
    fluid_modulus() const
    {
      return pore_fluid;
    }

    /** Elastic energy density of the pore fluid at a given excess pore pressure
     *  (J/m^3). */
    double
    fluid_energy(const double pressure) const
    {
      return pore_fluid > 0. ? pressure * pressure / (2. * pore_fluid) : 0.;
    }

    /** Hydraulic conductivity (m/s). @throws InputError if it is not given */
    dealii::SymmetricTensor<2, dim>
    permeability() const;

    /** Drainable porosity (-): volume of water drained per unit volume of soil
     *  as the free surface falls.
     *  @throws InputError if it is not given */
    double
    drainable_porosity() const;

    /** Retention curve and relative permeability of the unsaturated soil. */
    const Retention &
    retention() const
    {
      return *unsaturated;
    }

    /** Earth pressure coefficient at rest K0 from the parameter file (-); 0 if
     *  not specified. */
    double
    given_k0() const
    {
      return k0;
    }

    /**
     * Default earth pressure coefficient at rest K0 of a constitutive law (-).
     * K0 is the ratio of horizontal to vertical effective stress in level
     * ground without lateral strain; the stress is admissible at any depth. K0
     * = 1 is an isotropic stress state.
     */
    virtual double
    earth_pressure_at_rest() const
    {
      return 1.;
    }

    /** Strength parameters that determine Prandtl's limit load in plane strain.
     *  No value for laws without cohesion and friction angle. */
    virtual std::optional<FrictionalStrength>
    plane_strain_strength() const
    {
      return std::nullopt;
    }

    /** Enables out-of-plane (hoop) strain for axisymmetric problems. @return
     *  whether the law supports out-of-plane strain */
    virtual bool
    set_axisymmetric()
    {
      return false;
    }

    /** @name Explicit steps */
    /** @{ */

    /**
     * Updates the stress at all points of a block in an explicit step. Stress
     * and tensorial history variables are first rotated by the spin increment
     * exactly; the response to the strain increment sym(dt grad v) is then
     * added.
     */
    virtual void
    advance(const PointBlock &block, LawCounts &counts) const = 0;

    /** Number of history variables per point. Their meaning is internal to the
     *  law. */
    virtual unsigned int
    n_history() const = 0;

    /**
     * Initialises the history variables of a point from the initial stress and
     * the parameters of the law.
     * @param size length over which strain localises (m), for softening laws:
     * cell size over polynomial degree; 0: a single point with uniform strain
     * @param[out] history n_history() values
     * @return a note on values that had to be changed, or empty
     * @throws InputError if the stress is not admissible
     */
    virtual std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const = 0;

    /** Initialises history variables that depend on the initial position of a
     *  point. To be called before initialise(). @throws InputError at a
     *  position where the law is not valid */
    virtual void
    initialise_at(const dealii::Point<dim> & /*place*/,
                  double * /*history*/) const
    {}

    /** Name of the material parameter that is given by a formula in the initial
     *  coordinates; empty if there is none. */
    virtual std::string
    formula_of_place() const
    {
      return "";
    }

    /** Localisation length stored by initialise() (m); 0 for laws that do not
     *  depend on the cell size. */
    virtual double
    size(const double * /*history*/) const
    {
      return 0.;
    }

    /** Out-of-plane stress s_zz in plane problems (Pa). */
    virtual double
    stress_zz(const Components &stress, const double *history) const = 0;

    /** Full stress tensor of a point (Pa). */
    Stress
    full_stress(const Components &stress, const double *history) const;

    /** Elastic P-wave modulus M (Pa); the wave speed is sqrt(M/rho). */
    virtual double
    wave_modulus(const Stress &stress, const double *history) const = 0;

    /** Output quantity of a constitutive law in addition to the stress
     *  components. */
    struct OutputQuantity
    {
      std::string name;  ///< field name, e.g. "stress_zz"
      std::string title; ///< column title with unit, e.g. "stress zz (Pa)"
    };
    virtual std::vector<OutputQuantity>
    output_quantities() const = 0;

    /** Plane sections of the yield surfaces at a given state, outermost first.
     *  Empty for laws that do not provide curves. */
    virtual std::vector<YieldCurve>
    yield_curves(const Components & /*stress*/,
                 const double * /*history*/,
                 const SectionPlane & /*plane*/) const
    {
      return {};
    }

    /** Computes the output quantities in the order of output_quantities(). */
    virtual void
    output(const Components &stress,
           const double     *history,
           double           *values) const = 0;
    /** @} */

  protected:
    /** Full parameter name for error messages, e.g. "Materials/soil/NAME"; if
     *  the name is empty, the name of the section. */
    std::string
    parameter(const std::string &name = "") const;

    /** Checks a condition on a material constant. @throws InputError unless
     *  @p holds */
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

    std::vector<double> conductivities;          ///< principal values (m/s)
    double              conductivity_angle = 0.; ///< (degrees)
    double              drainable          = 0.;

    std::shared_ptr<Retention> unsaturated;
  };

  /** Evaluates an output quantity selected by name; NaN for laws without this
   *  quantity. */
  class ShownValue
  {
  public:
    ShownValue(const ConstitutiveLaw &law, const std::string &name);

    /** Evaluates the output quantity selected in the constructor, see
     *  ConstitutiveLaw::output(). */
    double
    operator()(const ConstitutiveLaw::Components &stress,
               const double                      *history);

  private:
    const ConstitutiveLaw *law;
    std::vector<double>    values;
    std::size_t            place = 0;
  };

  /** Converts a Mandel vector into stress components (Pa). */
  inline ConstitutiveLaw::Stress
  stress_of(const SpatialMandel &t)
  {
    ConstitutiveLaw::Stress s = {{t[0], t[1], t[3], t[2] / sqrt2}};
    for (int i = 4; i < n_spatial; ++i)
      s[i] = t[i] / sqrt2;
    return s;
  }

  /** Converts stress components into a Mandel vector (Pa), the inverse of
   *  stress_of(). */
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
