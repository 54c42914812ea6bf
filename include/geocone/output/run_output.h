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
  /** A step with all its substeps: the report is of the last one, works are of the
   *  step. */
  struct ImplicitRecord : StepRecord<StepReport>
  {
    unsigned int substeps     = 0;     ///< accepted
    unsigned int failures     = 0;     ///< substeps tried in vain
    unsigned int iterations   = 0;     ///< of all substeps, failed ones too
    unsigned int regularised  = 0;     ///< Jacobians that needed a blend
    bool         resets       = false; ///< displacements count from here
    double       displacement = 0.;    ///< of the load (m)
    double       load         = 0.;    ///< (N/m)
    double       raised       = 0.;    ///< way of raised loads (m)
    std::vector<double>
      pressures; ///< in excess, of observed points in undrained soil

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
          raised,
          pressures);
    }
  };

  /** Whether what presses moves on in one direction over three records. */
  bool
  moves_on(const ImplicitRecord &a,
           const ImplicitRecord &b,
           const ImplicitRecord &c);

  /** How a stage ended that was to go on until failure. */
  struct Failure
  {
    std::string stage;
    double      carried_until; ///< time of the last step that was solved (s)
    double      not_until;     ///< that of the smallest step that was not (s)
    std::string reason;
  };

  /**
   * The folder of an implicit run: statistics.csv (a line per step), newton.csv (a line
   * per iteration), summary.json, VTU series. Read only with respect to the state.
   */
  class RunOutput : public SceneOutput<ImplicitRecord>
  {
  public:
    using SceneOutput::SceneOutput;

    /**
     * Makes the folder, or enters that of the run before.
     * @param points_move through the mesh
     * @param points_leave may leave it
     * @throws InputError if it exists and may not be used, or cannot be written
     */
    void
    prepare(const RunOptions &options,
            const Scene      &scene,
            const bool        points_move,
            const bool        points_leave);

    void
    state_of_run(StateRow &row) override;

    /** The energy that the losses start from. */
    void
    set_initial_energy(const Energies &energies)
    {
      balance.begin(energies);
    }

    /** Takes away the energy of what is removed, and adds that of what is added. */
    void
    change_body(const BodyChange &change)
    {
      balance.change_body(change.before, change.after);
    }

    /** Adds a tried (sub)step to newton.csv. */
    void
    add_newton_table(const unsigned int step,
                     const double       time,
                     const double       h,
                     const StepReport  &report);

    /** Adds an accepted step to statistics.csv and to the balance of energy. */
    void
    add_step(const ImplicitRecord &record);

    /** Writes fields, if wanted. */
    void
    write_fields(const double                    time,
                 const BackgroundMesh           &mesh,
                 const Space                    &space,
                 const MaterialPoints           &points,
                 const Kinematics               &kinematics,
                 const std::vector<RigidMotion> &moved_obstacles);

    /** The topics of the summary: all that the steps have brought. */
    Json
    results() const;

    /** Adds the errors against exact fields to the summaries to come. */
    void
    set_field_errors(const FieldErrors &errors)
    {
      field_errors = errors;
    }

    /** Adds the strict bounds of the load to the summaries to come. */
    void
    set_bracket(const LoadBracket &of_load)
    {
      bracket = of_load;
    }

    /** Tells, at once and in the summaries to come, how the run ended. */
    void
    set_failure(const Failure &failure);

    void
    print_result() const override;

  private:
    using Record = ImplicitRecord;

    /** @name The columns of statistics.csv */
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
    add_pressure_columns();
    /** @} */

    /** @name Topics of the summary */
    /** @{ */
    /** The last ones: the factor of safety, bounds, errors and how the run failed. */
    void
    add_outcome(Json &json) const;

    Json
    limit_load() const;
    Json
    safety() const;

    /** How much faster the observed point that moves most does by the last reduction of
     *  the strength than by the first one, per factor; nothing: none is observed. */
    std::optional<double>
    growth_of_displacement() const;

    Json
    contact() const;
    Json
    friction_memory() const;
    Json
    motion() const; ///< whether particles that move are sound
    /** @} */

    void
    print_limit_load() const;

    void
    report_results(std::ostream &out) const override;

    /** The load of a summary that stands beside the bracket, if there are both in one
     *  unit. */
    std::optional<double>
    bracketed_load(const Json &of_run) const;

    /** Warns if the memory of friction has changed the result by more than about 1 %. */
    void
    warn_of_memory() const;

    void
    print_safety() const;

    /** Whether the load is of raised loads that 'Factor' does not turn into a force. */
    bool
    load_is_number() const;

    /** Warns of the first load that jumps by more than half and back. */
    void
    warn_of_jump();

    CsvFile                    newton;
    std::unique_ptr<Fields>    fields;
    std::optional<FieldErrors> field_errors;
    std::optional<Failure>     failure;
    std::optional<LoadBracket> bracket;

    bool         points_move  = false;
    bool         points_leave = false;
    unsigned int n_load_jumps = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
