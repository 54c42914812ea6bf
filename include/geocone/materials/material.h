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
  /** What the law of a step depends on besides the state of its points at t_n. */
  struct StepLaw
  {
    double size = 0.; ///< h (s)

    /**
     * Part of the normal stress on which strength depends that a solver takes from
     * t_n: 0 is the law itself, 1 makes friction explicit
     * (doc/theory/friction_memory.md). Laws without friction have no use for it.
     */
    double friction_lag = 0.;
  };

  /** What a batch of points asks of its material: the same index, one point. */
  struct Increment
  {
    dealii::ArrayView<const Mandel> strain;   ///< strain increments of the step
    dealii::ArrayView<const Mandel> stress_n; ///< stress at t_n (Pa)

    /** History at t_n: n_history numbers for each point, of which the law takes
     *  the first ConstitutiveLaw::n_history(). */
    const double *history_n = nullptr;
    unsigned int  n_history = 0;

    StepLaw step;

    /** Strain increments out of the plane, of axisymmetric scenes; null: none. */
    const double *strain_zz = nullptr;
  };

  /** What a tangent has besides the plane's, where there is strain out of it (Pa). */
  struct OutOfPlaneTangent
  {
    Mandel by_zz; ///< ds/de_zz
    Mandel of_zz; ///< ds_zz/de
    double zz;    ///< ds_zz/de_zz
  };

  /** What the material answers. An empty `tangent` is not computed, nor is the
   *  history if it is null, nor what is out of the plane. */
  struct Response
  {
    dealii::ArrayView<Mandel>       stress;  ///< stress at t_{n+1} (Pa)
    dealii::ArrayView<Mode>         mode;    ///< elastic, cone or apex
    dealii::ArrayView<MandelMatrix> tangent; ///< ds/de, generalised (Pa)
    double *history = nullptr; ///< in: a copy of history_n; out: at t_{n+1}

    /** @name Of laws that are spatial */
    /** @{ */
    double            *stress_zz  = nullptr; ///< at t_{n+1} (Pa)
    OutOfPlaneTangent *tangent_zz = nullptr; ///< with the tangent
    /** @} */
  };

  /**
   * A constitutive law with a return map, which all methods can use: a pure function
   * of a batch of strain increments and states at t_n, with isotropic elasticity,
   * which is linear unless the law says otherwise (elasticity_at()). In plane scenes
   * the out-of-plane stress is
   *   s_zz = nu (s_xx + s_yy) + d,
   * d (Pa) the first history variable, to which laws that harden add theirs. It is
   * constant where plastic flow is in the plane; laws that are spatial change it.
   *
   * Parameters of the base: density (kg/m^3), Young modulus (Pa) where it is constant,
   * Poisson ratio.
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

    std::vector<Shown>
    shown() const override
    {
      if (dim == 3)
        return {};
      return {{"stress_zz", "stress zz (Pa)"}};
    }

    void
    show(const Components &stress,
         const double     *history,
         double           *values) const override
    {
      if (dim == 2)
        values[0] = stress_zz(stress, history);
    }

    /** Whether steps change the history. */
    bool
    has_history() const
    {
      return (dim == 2 && is_spatial()) || n_history() > Material::n_history();
    }

    /** Whether strength and flow are those of all stresses, s_zz with them. */
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

    /** (s_xx, s_yy, s_xy, s_zz) of a stress in the plane. @param history of the point */
    SpatialMandel
    whole_stress(const Mandel &stress, const double *history) const;

    /** The elastic strain between two stresses. Laws of the plane have none along z,
     *  and s_zz does no work. */
    virtual SpatialMandel
    elastic_strain(const SpatialMandel &from, const SpatialMandel &to) const;

    /** By how much a stress is beyond the strength (Pa), negative within it; nothing
     *  for laws without one. @param history of the point */
    virtual std::optional<double>
    overstress(const Mandel &stress, const double *history) const;

    /** Whether steps change flow_cone(). */
    virtual bool
    hardens() const
    {
      return false;
    }

    /**
     * The cone of a cone law at t_n, by which solutions are checked independently
     * of update(); nothing for laws without one.
     * @param history of the point; null will do for laws that do not harden
     */
    virtual std::optional<FlowCone>
    flow_cone(const double * /*history*/) const
    {
      return std::nullopt;
    }

    /** |s_t| <= a s_n + k with s_n = sqrt2 p, |s_t| = q/sqrt2, of flow_cone(). */
    std::vector<YieldCurve>
    yield_curves(const Components   &stress,
                 const double       *history,
                 const SectionPlane &plane) const override;

    /**
     * The cone that a step solves for: flow_cone(), but for what of the normal
     * stress is that of the past (FlowCone::delayed()).
     * @param stress_n,history_n of the point at t_n
     */
    virtual std::optional<FlowCone>
    step_cone(const Mandel  &stress_n,
              const double  *history_n,
              const StepLaw &step) const;

    /**
     * step_cone() at the end of a step with the plastic shear |z_t| = slip, and the
     * same of flow_cone(). They harden no more.
     */
    virtual std::optional<FlowCone>
    end_cone(const Mandel  &stress_n,
             const double  *history_n,
             const StepLaw &step,
             const double   slip) const;
    virtual std::optional<FlowCone>
    exact_end_cone(const double *history_n, const double slip) const;

    /** How well the end of a step obeys the law, found independently of update(), by
     *  flow_cone() if there is one; nothing for laws without a change of variable. */
    virtual std::optional<FlowCheck>
    check_flow(const PointStep &point, const StepLaw &step) const;

    /** @name The law as a root of its natural map, see NaturalMap */
    /** @{ */
    /** Whether it has one in this dimension: laws that are spatial change s_zz besides
     *  what scenes in the plane solve for. */
    virtual bool
    has_natural_map() const
    {
      return !is_spatial();
    }

    /** Of a law that is no cone, where s - rho Psi(z) is projected. */
    struct Projection
    {
      Mode         mode;      ///< where it lies
      Mandel       stress;    ///< P_C (Pa)
      MandelMatrix slope;     ///< J of P_C
      MandelMatrix psi_slope; ///< Psi'
    };
    virtual std::optional<Projection>
    project_natural_map(const Mandel & /*s*/,
                        const Mandel & /*z*/,
                        const double /*rho*/,
                        const Mandel & /*stress_n*/,
                        const double * /*history_n*/,
                        const StepLaw & /*step*/) const
    {
      return std::nullopt;
    }
    /** @} */

    /** overstress() of laws that are spatial. @param history of the point */
    virtual std::optional<double>
    yield_function(const SpatialMandel & /*stress*/,
                   const double * /*history*/) const
    {
      return std::nullopt;
    }

    /** Of laws that are spatial: the work per volume (J/m^3) by which plastic strain at a
     *  stress takes more than the strength without memory would, or less.
     *  @param history of the point */
    virtual double
    power_beyond_strength(const SpatialMandel & /*plastic_strain*/,
                          const SpatialMandel & /*stress*/,
                          const double * /*history*/) const
    {
      return 0.;
    }

    /** The relaxation time tau of friction with memory (s); 0: none. */
    virtual double
    friction_memory() const
    {
      return 0.;
    }

    /** Takes the scene's tau where the file leaves it to it (automatic) and the
     *  exact law would be hard. */
    virtual void
    set_friction_memory(const double /*tau*/)
    {}

    /** That of a point that has not yielded. */
    std::optional<FlowCone>
    initial_cone() const;

    /** The stress that the strength of a point allows which is nearest to a stress
     *  (Pa), which without a cone is itself. @param history of the point */
    Mandel
    nearest_admissible(const Mandel &stress, const double *history) const;

    /** Divides c and tan(phi) of the file by F, and limits theta to the reduced phi.
     *  @throws InputError for a law with a strength of another kind */
    virtual void
    reduce_strength(const double F);

    /** Whether the search for a factor of safety reduces the strength of this one. */
    bool
    is_reduced() const
    {
      return reduced;
    }

    /** How the k of flow_cone() grows with depth: by slope (level - y). */
    struct Growth
    {
      double slope = 0.; ///< (Pa/m)
      double level = 0.; ///< (m)

      double
      at(const double y) const
      {
        return slope * (level - y);
      }
    };
    virtual Growth
    growth() const
    {
      return {};
    }

    /** Whether the strength is given by a formula in the coordinates. */
    virtual bool
    has_strength_formula() const
    {
      return false;
    }

    /**
     * Largest (a - b)/a for which the line search alone was seen to be enough
     * on most meshes: theta >= phi/2 is (nearly) 1/2.
     */
    static constexpr double hard_flow = 0.51;

    /**
     * (a - b)/a between 0 (associated) and 1 (no dilatancy), a and b those of the
     * cone before any hardening.
     */
    virtual double
    non_associativity() const;

    /** Whether soil that flows grows in volume. */
    virtual bool
    dilates() const
    {
      const auto cone = initial_cone();
      return cone && (cone->b > 0. || cone->is_cut());
    }

    /** Whether the tangent is symmetric in all states. */
    virtual bool
    has_symmetric_tangent() const
    {
      return non_associativity() == 0.;
    }

    /** That of all states; of laws whose stiffness is that of the state, the one at
     *  the pressure 100 kPa. */
    const Elasticity &
    elasticity() const
    {
      return elastic;
    }

    /** @name Laws whose stiffness is that of the state */
    /** @{ */
    /** Of a stress, per volume (J/m^3). @param history of the point */
    virtual double
    elastic_energy(const Mandel &stress, const double *history) const;

    /** Elasticity at a stress. @param history of the point */
    virtual Elasticity
    elasticity_at(const Mandel & /*stress*/, const double * /*history*/) const
    {
      return elastic;
    }

    /** Whether it is elasticity() always. */
    virtual bool
    has_constant_stiffness() const
    {
      return true;
    }
    /** @} */

  protected:
    /** What gives the stiffness of a law. */
    enum class Stiffness
    {
      constant, ///< parameters
      of_state  ///< elasticity_at(), by Poisson's ratio
    };
    Material(const std::string &section, const Stiffness stiffness);

    double
    poisson() const
    {
      return poisson_ratio;
    }

    /** Of laws whose stiffness is that of the state, after prepare(). */
    void
    set_elasticity(const Elasticity &elasticity)
    {
      elastic = elasticity;
    }

    /** What a stress at the end of a step must be in: flow_cone(), but for laws
     *  whose strength follows the stress. */
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
