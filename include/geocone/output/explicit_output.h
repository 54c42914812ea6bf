// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_explicit_output_h
#define geocone_output_explicit_output_h

#include <geocone/explicit/explicit_mpm.h>
#include <geocone/output/fields.h>
#include <geocone/output/scene_output.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Record of one step of the loading programme in an explicit run. The step
   *  consists of many explicit time steps. */
  struct ExplicitRecord : StepRecord<ExplicitState>
  {
    double         cpu = 0.; ///< CPU time of the explicit steps, this rank (s)
    ExplicitReport report;
    Exchange       exchange;
    std::vector<double>
      pressures; ///< excess pore pressures at observed points (Pa)
    std::vector<RigidMotion> moved_obstacles; ///< displacements since the start

    void
    state(StateRow &row)
    {
      StepRecord::state(row);
      row(cpu, report, exchange, pressures, moved_obstacles);
    }
  };

  /**
   * Output folder of an explicit run. It contains statistics.csv (a line per
   * step of the loading programme, of many explicit time steps each),
   * summary.json and points-NNNN.vtu. As in EnergyBalance,
   *   numerical loss    = work of gravity and supports - stress work
   *                       - damping - removed - kinetic energy gained,
   * and
   *   momentum residual = momentum gained + removed - impulse of gravity,
   *                       supports and damping,
   * which is zero within rounding. The state of the run is only read.
   */
  class ExplicitOutput : public SceneOutput<ExplicitRecord>
  {
  public:
    using SceneOutput::SceneOutput;

    /** Creates the output folder, or reopens the folder of a resumed run.
     *  @param water pore water of the points
     *  @throws InputError */
    void
    prepare(const RunOptions &options,
            const Scene      &scene,
            const PoreWater  &water);

    void
    state_of_run(StateRow &row) override;

    /** Sets the initial state, relative to which changes in energy and momentum
     *  are measured. */
    void
    set_initial(const ExplicitState &state);

    /** Appends a step to statistics.csv and to the energy balance. */
    void
    add_step(const ExplicitRecord &record);

    /** Writes the field file of the particles if field output is enabled. */
    void
    write_points(const double time, const std::vector<PointArrays> &groups);

    /** Writes the field file of the obstacles if there are any and field output is
     *  enabled. */
    void
    write_obstacles(const double time, const std::vector<RigidMotion> &moved);

    /** Returns the sections (topics) of summary.json that contain the results
     *  of all steps.
     *  @param counts since the start, of all ranks */
    Json
    results(const LawCounts &counts) const;

    void
    print_result() const override;

  private:
    using Record = ExplicitRecord;

    /** @name Columns of statistics.csv, with their units in plane strain */
    /** @{ */
    void
    add_step_columns();
    void
    add_body_columns();
    void
    add_balance_columns();
    /** @} */

    /** @name Topics of the summary */
    /** @{ */
    Json
    steps() const;
    Json
    body() const;
    Json
    energy() const;
    Json
    momentum() const;

    /** Mean force of each obstacle on the body in the last record and the largest of
     *  all records, and its displacement. */
    Json
    obstacles() const;
    /** @} */

    bool
    has_obstacles() const
    {
      return !scene->obstacles.list.empty();
    }

    void
    update_balance(const ExplicitRecord &record);

    /** Error of the water balance: sum of the outflow, the change of the volume
     *  of the saturated points and that of the water that their pressure stores,
     *  over the sum of the absolute values of the latter two; 0 for water at
     *  rest. Removed points do not count as changes. */
    double
    water_error(const ExplicitRecord &record) const;

    /** Momentum residual. */
    dealii::Tensor<1, dim>
    momentum_residual(const ExplicitRecord &record) const;

    void
    report_results(std::ostream &out) const override;

    /** Evaluates an output quantity of the constitutive law at the points of a
     *  group. The values are NaN if the law does not define the quantity. */
    void
    show(const std::string &name,
         const PointArrays &group,
         double            *values) const;

    const PoreWater            *water = nullptr; ///< null without flow
    ExplicitState               initial;
    std::unique_ptr<FieldFiles> point_files, obstacle_files;
    double largest_impulse = 0.; ///< over all records, scale of the residual
  };
} // namespace geocone::GEOCONE_DIM

#endif
