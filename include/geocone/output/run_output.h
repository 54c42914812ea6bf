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
  /** Step with all its substeps: the report is that of the last one, works are of the
   *  whole step. */
  struct ImplicitRecord : StepRecord<StepReport>
  {
    unsigned int substeps     = 0;     ///< accepted
    unsigned int failures     = 0;     ///< failed substeps
    unsigned int iterations   = 0;     ///< of all substeps, incl. failed
    unsigned int regularised  = 0;     ///< regularised Jacobians
    bool         resets       = false; ///< displacement is reset here
    double       displacement = 0.;    ///< of the load (m)
    double       load         = 0.;    ///< (N/m)
    double       scaled       = 0.;    ///< path under load control (m)
    std::vector<double>
      pressures; ///< excess, of observed points in undrained soil

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

  /** Whether the loading support moves in one direction over three records. */
  bool
  moves_on(const ImplicitRecord &a,
           const ImplicitRecord &b,
           const ImplicitRecord &c);

  /** End of a stage that continues until failure. */
  struct Failure
  {
    std::string stage;
    double      carried_until; ///< time of the last converged step (s)
    double      not_until;     ///< time of the smallest failed step (s)
    std::string reason;
  };

  /** Folder of an implicit run: statistics.csv (a line per step), newton.csv (a line
   *  per iteration), plates.csv (lines per step), summary.json, VTU series. The state is only read. */
  class RunOutput : public SceneOutput<ImplicitRecord>
  {
  public:
    using SceneOutput::SceneOutput;

    /**
     * Makes the folder, or reopens that of a resumed run.
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

    /** Sets the initial energy of the balance. */
    void
    set_initial_energy(const Energies &energies)
    {
      balance.begin(energies);
    }

    /** Accounts for the energies of removed and added parts of the body. */
    void
    change_body(const BodyChange &change)
    {
      balance.change_body(change.before, change.after);
    }

    /** Adds an attempted (sub)step to newton.csv. */
    void
    add_newton_table(const unsigned int step,
                     const double       time,
                     const double       h,
                     const StepReport  &report);

    /** Adds an accepted step to statistics.csv and to the energy balance. */
    void
    add_step(const ImplicitRecord &record);

    /** Writes fields if requested. */
    void
    write_fields(const double                    time,
                 const BackgroundMesh           &mesh,
                 const Space                    &space,
                 const MaterialPoints           &points,
                 const Kinematics               &kinematics,
                 const std::vector<RigidMotion> &moved_obstacles);

    /** Topics of the summary: the results of all steps. */
    Json
    results() const;

    /** Adds the errors against exact fields to subsequent summaries. */
    void
    set_field_errors(const FieldErrors &errors)
    {
      field_errors = errors;
    }

    /** Adds the strict bounds of the load to subsequent summaries. */
    void
    set_bracket(const LoadBracket &of_load)
    {
      bracket = of_load;
    }

    /** Reports how the run ended, now and in subsequent summaries. */
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
    /** Last topics: the factor of safety, bounds, errors and the failure. */
    void
    add_outcome(Json &json) const;

    Json
    limit_load() const;
    Json
    safety() const;

    /** Displacement per strength factor in the last reduction of the strength over that
     *  in the first one, for the observed point that moves most; empty if none is
     *  observed. */
    std::optional<double>
    growth_of_displacement() const;

    Json
    contact() const;
    Json
    structures() const; ///< bars and plates at the last step
    void
    add_plate(Json &json, const unsigned int plate) const;
    Json
    friction_memory() const;
    Json
    motion() const; ///< quality of particle motion
    /** @} */

    void
    print_limit_load() const;

    void
    report_results(std::ostream &out) const override;

    /** Load of a summary in the unit of the bracket, if both exist. */
    std::optional<double>
    bracketed_load(const Json &of_run) const;

    /** Warns if friction with memory has changed the result by more than about 1 %. */
    void
    warn_of_memory() const;

    void
    print_safety() const;

    /** Whether the load is a load-stepping factor that 'Factor' does not convert into a
     *  force. */
    bool
    load_is_number() const;

    /** Warns of the first load that jumps by more than half of its value and
     *  back. */
    void
    warn_of_jump();

    /** Adds the plates at the end of a step to plates.csv. */
    void
    add_plates(const Record &record);

    CsvFile                    newton, plates;
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
