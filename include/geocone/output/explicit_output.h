// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_explicit_output_h
#define geocone_output_explicit_output_h

#include <geocone/explicit/explicit_mpm.h>
#include <geocone/output/field_files.h>
#include <geocone/output/scene_output.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Record of a step of the loading programme, which consists of explicit time
   *  steps. */
  struct ExplicitRecord : StepRecord<ExplicitState>
  {
    double         cpu = 0.; ///< CPU time of the explicit steps, this rank (s)
    ExplicitReport report;
    Exchange       exchange;

    void
    state(StateRow &row)
    {
      StepRecord::state(row);
      row(cpu, report, exchange);
    }
  };

  /**
   * Output folder of an explicit run: statistics.csv (a line per step of the
   * loading programme, of many explicit time steps each), summary.json and
   * points-NNNN.vtu, with
   *   numerical loss    = work of gravity and supports - stress work
   *                       - damping - removed - kinetic energy gained,
   * as in EnergyBalance, and
   *   momentum residual = momentum gained + removed - impulse of gravity,
   *                       supports and damping,
   * which is zero within rounding. The state of the run is only read.
   */
  class ExplicitOutput : public SceneOutput<ExplicitRecord>
  {
  public:
    using SceneOutput::SceneOutput;

    /** Creates the output folder, or reopens the folder of a resumed run.
     *  @throws InputError */
    void
    prepare(const RunOptions &options, const Scene &scene);

    void
    state_of_run(StateRow &row) override;

    /** Sets the initial state, the reference of energy and momentum gained. */
    void
    set_initial(const ExplicitState &state);

    /** Appends a step to statistics.csv and to the energy balance. */
    void
    add_step(const ExplicitRecord &record);

    /** Writes the fields at the particles, if requested. */
    void
    write_points(const double time, const std::vector<PointArrays> &groups);

    /** Results of all steps, as topics of the summary.
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
    /** @} */

    void
    update_balance(const ExplicitRecord &record);

    /** Momentum residual. */
    dealii::Tensor<1, dim>
    momentum_residual(const ExplicitRecord &record) const;

    void
    report_results(std::ostream &out) const override;

    /** Output quantity of the constitutive laws at the points of a group; NaN if
     *  the law of the group does not define it. */
    void
    show(const std::string &name,
         const PointArrays &group,
         double            *values) const;

    ExplicitState               initial;
    std::unique_ptr<FieldFiles> point_files;
    double largest_impulse = 0.; ///< over all records, scale of the residual
  };
} // namespace geocone::GEOCONE_DIM

#endif
