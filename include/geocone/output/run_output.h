// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_run_output_h
#define geocone_output_run_output_h

#include <geocone/base/parameter_file.h>
#include <geocone/output/exact_solution.h>
#include <geocone/output/fields.h>
#include <geocone/output/limit_load.h>
#include <geocone/output/load_bracket.h>
#include <geocone/output/scene_output.h>
#include <geocone/time_stepping/time_stepper.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Record of one step of the loading programme in an implicit run. The report refers
   *  to the last substep, the work to the whole step. */
  struct ImplicitRecord : StepRecord<StepReport>
  {
    unsigned int substeps     = 0;     ///< accepted substeps
    unsigned int failures     = 0;     ///< failed substeps
    unsigned int iterations   = 0;     ///< including failed substeps
    unsigned int regularised  = 0;     ///< regularised Jacobians
    bool         resets       = false; ///< displacement is reset here
    double       displacement = 0.;    ///< of the loaded support (m)
    double       load         = 0.;    ///< reaction of the loaded support (N/m)
    double       scaled       = 0.;    ///< path under load control (m)
    std::vector<double>
      pressures; ///< excess pore pressures at observed points (Pa)

    void
    state(StateRow &row)
    {
      StepRecord::state(row);
      row(substeps,
          failures,
          iterations,
          regularised,
          resets,
          displacement,
          load,
          scaled,
          pressures);
    }
  };

  /** Returns true if the loaded support moves in the same direction in three
   *  successive steps. */
  bool
  moves_on(const ImplicitRecord &a,
           const ImplicitRecord &b,
           const ImplicitRecord &c);

  /** Failure of the body in a stage with loading until failure. */
  struct Failure
  {
    std::string stage;
    double      carried_until; ///< time of the last converged step (s)
    double      not_until;     ///< time of the smallest failed step (s)
    std::string reason;
  };

  /** Output folder of an implicit run. It contains statistics.csv (a line per step),
   *  newton.csv (a line per iteration), plates.csv (lines per step), summary.json and
   *  a VTU series. The state of the run is only read. */
  class RunOutput : public SceneOutput<ImplicitRecord>
  {
  public:
    using SceneOutput::SceneOutput;

    /**
     * Creates the output folder, or reopens the folder of a resumed run.
     * @param points_move whether points move through the mesh
     * @param points_leave whether points can leave the mesh
     * @param consolidates whether excess pore pressures dissipate by flow
     * @throws InputError if the folder exists and may not be used, or cannot be
     * written
     */
    void
    prepare(const RunOptions &options,
            const Scene      &scene,
            const bool        points_move,
            const bool        points_leave,
            const bool        consolidates);

    void
    state_of_run(StateRow &row) override;

    /** Sets the initial energies of the energy balance. */
    void
    set_initial_energy(const Energies &energies)
    {
      balance.begin(energies);
    }

    /** Updates the energy balance for added and removed parts of the body. */
    void
    change_body(const BodyChange &change)
    {
      balance.change_body(change.before, change.after);
    }

    /** Appends the Newton iterations of an attempted step or substep to newton.csv. */
    void
    add_newton_table(const unsigned int step,
                     const double       time,
                     const double       h,
                     const StepReport  &report);

    /** Appends an accepted step to statistics.csv and to the energy balance. */
    void
    add_step(const ImplicitRecord &record);

    /** Writes the field files if field output is enabled. */
    void
    write_fields(const double                    time,
                 const BackgroundMesh           &mesh,
                 const Space                    &space,
                 const MaterialPoints           &points,
                 const Kinematics               &kinematics,
                 const std::vector<RigidMotion> &moved_obstacles);

    /** Returns the sections (topics) of summary.json that contain the results
     *  of all steps. */
    Json
    results() const;

    /** Sets the errors with respect to the exact solution, for summary.json. */
    void
    set_field_errors(const FieldErrors &errors)
    {
      field_errors = errors;
    }

    /** Sets the strict bounds on the limit load, for summary.json. */
    void
    set_bracket(const LoadBracket &of_load)
    {
      bracket = of_load;
    }

    /** Reports the failure of the body and stores it for summary.json. */
    void
    set_failure(const Failure &failure);

    void
    print_result() const override;

  private:
    using Record = ImplicitRecord;

    /** @name Columns of statistics.csv */
    /** @{ */
    void
    add_load_columns();
    void
    add_solver_columns();
    void
    add_balance_columns();
    void
    add_contact_columns();
    void
    add_structure_columns();
    void
    add_pressure_columns();
    /** @} */

    /** @name Topics of the summary */
    /** @{ */
    /** Appends the final sections of summary.json: factor of safety, bounds,
     *  errors and failure. */
    void
    add_outcome(Json &json) const;

    Json
    limit_load() const;
    Json
    safety() const;

    /** Returns the first step with reduced strength in which the body
     *  accelerates, of stages that do not end at failure (see
     *  Stage::no_equilibrium()). */
    std::optional<Failure>
    onset_of_motion() const;

    /** Ratio of the last to the first displacement rate during strength
     *  reduction, a measure of acceleration (-). The rate is the displacement
     *  per increment of the strength factor in one reduction, at the observed
     *  point that moves most. Empty without observed points. */
    std::optional<double>
    growth_of_displacement() const;

    Json
    contact() const;
    Json
    structures() const; ///< bars and plates at the last step
    void
    add_plate(Json &json, const unsigned int plate) const;
    Json
    newton_statistics() const;
    Json
    friction_memory() const;
    Json
    motion() const; ///< quality of particle motion
    /** @} */

    void
    print_limit_load() const;

    void
    report_results(std::ostream &out) const override;

    /** Limit load of the incremental analysis in the unit of its strict bounds. Empty
     *  if the summary contains no limit load or no bounds. */
    std::optional<double>
    bracketed_load(const Json &of_run) const;

    /** Warns if friction memory contributes to the plastic work. If its effect
     *  on the work or the load exceeds 0.5 %, recommends a comparison run with
     *  half the memory time, or a longer run. */
    void
    warn_of_memory() const;

    void
    print_safety() const;

    /** Returns true if the load is a dimensionless load factor. False if the parameter
     *  'Factor' converts it into a force. */
    bool
    load_is_number() const;

    /** Warns once if the loads before and after a step are about equal, but the
     *  load of the step differs from their mean by more than 50 %. */
    void
    warn_of_jump();

    /** Appends the results of the plates at the end of a step to plates.csv. */
    void
    add_plates(const Record &record);

    CsvFile                    newton, plates;
    std::unique_ptr<Fields>    fields;
    std::optional<FieldErrors> field_errors;
    std::optional<Failure>     failure;
    std::optional<LoadBracket> bracket;

    bool         points_move  = false;
    bool         points_leave = false;
    bool         consolidates = false;
    unsigned int n_load_jumps = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
