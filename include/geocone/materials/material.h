// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_material_h
#define geocone_materials_material_h

#include <geocone/base/types.h>
#include <geocone/cone/flow_check.h>
#include <geocone/cone/second_order_cone.h>
#include <geocone/kernels/elasticity.h>
#include <geocone/materials/constitutive_law.h>

#include <deal.II/base/array_view.h>
#include <optional>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Time step data for a material update, in addition to the state at t_n. */
  struct StepData
  {
    double size = 0.; ///< step size h (s)

    /**
     * Weight of the lagged normal stress (at t_n) in the yield condition. The
     * weight is set by the solver: 0 is the exact law, 1 explicit friction
     * (doc/theory/friction_memory.md). Laws without friction ignore it.
     */
    double friction_lag = 0.;
  };

  /** Input of a material update for a batch of points, as arrays over the
   *  points. */
  struct Increment
  {
    dealii::ArrayView<const Mandel> strain;   ///< strain increments of the step
    dealii::ArrayView<const Mandel> stress_n; ///< stress at t_n (Pa)

    /** History variables at t_n, n_history values per point. The law uses the
     *  first ConstitutiveLaw::n_history() values. */
    const double *history_n = nullptr;
    unsigned int  n_history = 0;

    StepData step;

    /** Out-of-plane strain increments in axisymmetric problems; null in other
     *  problems. */
    const double *strain_zz = nullptr;
  };

  /** Out-of-plane components of a tangent stiffness (Pa). */
  struct OutOfPlaneTangent
  {
    Mandel by_zz; ///< ds/de_zz
    Mandel of_zz; ///< ds_zz/de
    double zz;    ///< ds_zz/de_zz
  };

  /** Output of a material update. Optional quantities (empty `tangent`, null
   *  pointers) are not computed. */
  struct Response
  {
    dealii::ArrayView<Mandel>       stress;  ///< stress at t_{n+1} (Pa)
    dealii::ArrayView<Mode>         mode;    ///< elastic, cone or apex
    dealii::ArrayView<MandelMatrix> tangent; ///< ds/de, generalised (Pa)
    double *history = nullptr; ///< in: copy of history_n; out: at t_{n+1}

    /** @name Output of three-dimensional laws in plane problems */
    /** @{ */
    double            *stress_zz  = nullptr; ///< at t_{n+1} (Pa)
    OutOfPlaneTangent *tangent_zz = nullptr; ///< if the tangent is computed
    /** @} */
  };

  /**
   * Base class of constitutive laws with a return mapping, available for all
   * numerical methods. The state at t_{n+1} is a function of the strain
   * increments and the state at t_n. Elasticity is isotropic, and linear by
   * default (elasticity_at()). In plane problems the out-of-plane stress is
   *   s_zz = nu (s_xx + s_yy) + d,
   * where d (Pa) is the first history variable, followed by the history
   * variables of hardening laws. d is constant for plastic flow in the plane;
   * it evolves in spatial laws.
   *
   * Parameters of the base: density (kg/m^3), Young modulus (Pa) if it is
   * constant, Poisson ratio.
   */
  class Material : public ConstitutiveLaw
  {
  public:
    /** Declares the common parameters of laws with a return mapping.
     *  @param section name of the parameter section, e.g. "Materials/soil" */
    explicit Material(const std::string &section);

    /** Checks the material parameters and computes the derived constants. */
    void
    prepare() override;

    /** Computes stresses, history variables and tangents for a batch of
     *  points. */
    virtual void
    update(const Increment &increment, const Response &response) const = 0;

    /**
     * Default earth pressure coefficient at rest K0 (-), by Jaky's formula or
     * linear elasticity. Laws with a yield cone have K0 = 1 - sin(phi); other
     * laws have K0 = nu/(1 - nu), uniaxial strain. Jaky's value 1 - a = 1 -
     * sin(phi) is admissible, since the cone sustains K0 >= (1 - a)/(1 + a) - 2
     * c cos(phi)/((1 + a) |s_yy|), Rankine's active pressure.
     */
    double
    earth_pressure_at_rest() const override;

    /** Explicit stress update by the cone kernel for laws with a yield cone.
     *  Other laws call update() from the rotated stress. */
    void
    advance(const PointBlock &block, LawCounts &counts) const override;

    double
    wave_modulus(const Stress &stress, const double *history) const override;

    unsigned int
    n_history() const override
    {
      return dim == 2 ? 1 : 0;
    }

    std::string
    initialise(const Stress &stress,
               const double  size,
               double       *history) const override;

    double
    stress_zz(const Components &stress, const double *history) const override;

    std::vector<OutputQuantity>
    output_quantities() const override
    {
      if (dim == 3)
        return {};
      return {{"stress_zz", "stress zz (Pa)"}};
    }

    void
    output(const Components &stress,
           const double     *history,
           double           *values) const override
    {
      if (dim == 2)
        values[0] = stress_zz(stress, history);
    }

    /** Returns true if the law has history variables that evolve during a
     *  step. */
    bool
    has_history() const
    {
      return (dim == 2 && is_spatial()) || n_history() > Material::n_history();
    }

    /** Returns true if the yield condition and the flow rule depend on all
     *  stress components, including s_zz. */
    virtual bool
    is_spatial() const
    {
      return false;
    }

    bool
    set_axisymmetric() override
    {
      return is_spatial();
    }

    /** Full stress tensor of a point in a plane problem, in the order xx, yy,
     *  xy, zz (Pa).
     *  @param history of the point */
    SpatialMandel
    whole_stress(const Mandel &stress, const double *history) const;

    /** Elastic strain increment between two stress states. For plane laws the
     *  increment has no zz component, and s_zz does no work. @param history of
     *  the point */
    virtual SpatialMandel
    elastic_strain(const SpatialMandel &from,
                   const SpatialMandel &to,
                   const double        *history) const;

    /** Value of the yield function (Pa), positive outside the yield surface. No
     *  value for laws without a yield condition. @param history of the point */
    virtual std::optional<double>
    overstress(const Mandel &stress, const double *history) const;

    /** Returns true if the yield cone flow_cone() evolves with plastic strain
     *  (hardening or softening). */
    virtual bool
    hardens() const
    {
      return false;
    }

    /**
     * Yield and flow cone at t_n, used to check solutions independently of
     * update(). No value for laws without a yield cone.
     * @param history of the point; null is allowed for laws without hardening
     */
    virtual std::optional<FlowCone>
    flow_cone(const double * /*history*/) const
    {
      return std::nullopt;
    }

    /** Section of the yield cone flow_cone() by a plane in stress space. The
     *  curve is the line |s_t| = a s_n + k with s_n = sqrt2 p and |s_t| =
     *  q/sqrt2. */
    std::vector<YieldCurve>
    yield_curves(const Components   &stress,
                 const double       *history,
                 const SectionPlane &plane) const override;

    /**
     * Yield cone of an implicit step, in which the strength includes the
     * delayed part of the normal stress (FlowCone::delayed()).
     * @param stress_n,history_n state of the point at t_n
     */
    virtual std::optional<FlowCone>
    step_cone(const Mandel   &stress_n,
              const double   *history_n,
              const StepData &step) const;

    /**
     * Yield cones at the end of a step, after hardening by the plastic shear
     * |z_t| = slip. Initial cones are step_cone() for end_cone() and
     * flow_cone() for exact_end_cone().
     */
    virtual std::optional<FlowCone>
    end_cone(const Mandel   &stress_n,
             const double   *history_n,
             const StepData &step,
             const double    slip) const;
    virtual std::optional<FlowCone>
    exact_end_cone(const double *history_n, const double slip) const;

    /** Checks the yield condition and the flow rule at the end of a step,
     *  independently of update(). Cone laws are checked by flow_cone(); no value for laws
     *  without de Saxce's change of variable. */
    virtual std::optional<FlowCheck>
    check_flow(const PointStep &point, const StepData &step) const;

    /** @name Formulation of the law as a root of its natural map, see
     *  NaturalMap */
    /** @{ */
    /** Returns true if the natural map s - P_C(s - rho Psi(z)) is implemented
     *  for the law in this space dimension. Spatial laws have no natural map in
     *  plane problems, where s_zz is not an unknown. */
    virtual bool
    has_natural_map() const
    {
      return !is_spatial();
    }

    /** Projection of the natural-map argument s - rho Psi(z) onto the set of
     *  admissible stresses, for laws without a yield cone. */
    struct Projection
    {
      Mode         mode;      ///< region of the projection
      Mandel       stress;    ///< P_C (Pa)
      MandelMatrix slope;     ///< Jacobian of P_C
      MandelMatrix psi_slope; ///< derivative Psi'
    };
    virtual std::optional<Projection>
    project_natural_map(const Mandel & /*s*/,
                        const Mandel & /*z*/,
                        const double /*rho*/,
                        const Mandel & /*stress_n*/,
                        const double * /*history_n*/,
                        const StepData & /*step*/) const
    {
      return std::nullopt;
    }
    /** @} */

    /** Value of the yield function of three-dimensional laws (Pa), positive
     *  outside the yield surface.
     *  @param history of the point */
    virtual std::optional<double>
    yield_function(const SpatialMandel & /*stress*/,
                   const double * /*history*/) const
    {
      return std::nullopt;
    }

    /** Plastic work density minus the dissipation density of the exact law
     *  (without friction memory), for three-dimensional laws (J/m^3). The
     *  difference can be negative.
     *  @param history of the point */
    virtual double
    excess_work_density(const SpatialMandel & /*plastic_strain*/,
                        const SpatialMandel & /*stress*/,
                        const double * /*history*/) const
    {
      return 0.;
    }

    /** Relaxation time tau (s) with which the strength follows the normal
     *  stress (friction with memory); 0 without friction memory. */
    virtual double
    friction_memory() const
    {
      return 0.;
    }

    /** Sets the relaxation time tau (s) of laws whose parameter 'Friction
     *  memory' is "automatic". Without effect if the exact law is not hard to
     *  solve. */
    virtual void
    set_friction_memory(const double /*tau*/)
    {}

    /** Initial yield cone, before hardening. No value for laws without a yield
     *  cone. */
    std::optional<FlowCone>
    initial_cone() const;

    /** Admissible stress nearest to a given stress (Pa). Laws without a yield
     *  cone return the given stress. @param history of the point */
    Mandel
    nearest_admissible(const Mandel &stress, const double *history) const;

    /** Reduces the strength: divides c and tan(phi) of the parameter file by F,
     *  and limits the dilatancy angle theta to the reduced phi.
     *  @throws InputError for laws without cohesion and friction */
    virtual void
    reduce_strength(const double F);

    /** Returns true if strength reduction applies to this material. */
    bool
    is_reduced() const
    {
      return reduced;
    }

    /** Linear increase of the cone strength k with depth, equal to slope (level
     *  - y). */
    struct StrengthGradient
    {
      double slope = 0.; ///< (Pa/m)
      double level = 0.; ///< (m)

      double
      at(const double y) const
      {
        return slope * (level - y);
      }
    };
    virtual StrengthGradient
    growth() const
    {
      return {};
    }

    /** Name of the parameter that makes the strength a nonlinear function of
     *  the coordinates; empty if there is none. */
    virtual std::string
    strength_formula() const
    {
      return "";
    }

    /**
     * Threshold between weakly and strongly non-associated laws: largest degree
     * of non-associativity at which Newton's method with line search converged
     * on most meshes. The degree is (a - b)/a, with the apertures a of yield
     * and b of flow. Dilatancy angles theta >= phi/2 correspond to values up to
     * about 1/2.
     */
    static constexpr double strong_non_associativity = 0.51;

    /**
     * Degree of non-associativity of the initial cone, from 0 (associated) to 1
     * (no dilatancy). The degree is (a - b)/a, with the apertures a of yield
     * and b of flow.
     */
    virtual double
    non_associativity() const;

    /** Returns true if plastic flow increases the volume. */
    virtual bool
    dilates() const
    {
      const auto cone = initial_cone();
      return cone && (cone->b > 0. || cone->is_cut());
    }

    /** Returns true if the tangent stiffness is symmetric in all states. */
    virtual bool
    has_symmetric_tangent() const
    {
      return non_associativity() == 0.;
    }

    /** Elastic moduli of the constitutive law. For a stress-dependent
     *  stiffness, these are the moduli at the pressure 100 kPa; for a stiffness
     *  formula, the moduli for 'Young modulus'. */
    const Elasticity &
    elasticity() const
    {
      return elastic;
    }

    /** @name Laws with a stiffness that depends on stress or position */
    /** @{ */
    /** Elastic energy density at a given stress (J/m^3). @param history of the
     *  point */
    virtual double
    elastic_energy(const Mandel &stress, const double *history) const;

    /** Elastic moduli of a material point at a given stress. @param history of
     *  the point */
    virtual Elasticity
    elasticity_at(const Mandel & /*stress*/, const double * /*history*/) const
    {
      return elastic;
    }

    /** Returns true if the elastic stiffness is the same at all stresses. */
    virtual bool
    has_constant_stiffness() const
    {
      return true;
    }
    /** @} */

  protected:
    /** Origin of the elastic moduli: constant parameters, or a function of the
     *  state. */
    enum class Stiffness
    {
      constant, ///< by parameters
      of_state  ///< by elasticity_at(), with constant Poisson's ratio
    };
    Material(const std::string &section, const Stiffness stiffness);

    double
    poisson() const
    {
      return poisson_ratio;
    }

    /** Sets the reference elastic moduli of laws with a stress-dependent
     *  stiffness. To be called after prepare(). */
    void
    set_elasticity(const Elasticity &elasticity)
    {
      elastic = elasticity;
    }

    /** Yield cone that contains the stress at the end of a step. This is
     *  flow_cone(); for friction with memory the cone includes the delayed
     *  normal stress. */
    virtual std::optional<FlowCone>
    strength(const double *history) const
    {
      return flow_cone(history);
    }

  private:
    double     young_modulus = 1e8;
    double     poisson_ratio = 0.3;
    bool       reduced       = true;
    Elasticity elastic;
  };
} // namespace geocone::GEOCONE_DIM

#endif
