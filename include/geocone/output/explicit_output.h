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
  /** Step of the loading programme, with the explicit steps it consists of. */
  struct ExplicitRecord : StepRecord<ExplicitState>
  {
    double         cpu = 0.; ///< CPU time of its explicit steps, this rank (s)
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
   * Folder of an explicit run: statistics.csv (a line per step of the loading
   * programme, each of many explicit ones), summary.json and points-NNNN.vtu, with
   *   numerical loss    = gravity's and the supports' work - stress work
   *                       - damping - removed - kinetic energy gained,
   * as in EnergyBalance, and
   *   momentum residual = momentum gained + removed - impulse of gravity,
   *                       supports and damping,
   * which is zero within rounding. The state is only read.
   */
  class ExplicitOutput : public SceneOutput<ExplicitRecord>
  {
  public:
    using SceneOutput::SceneOutput;

    /** Makes the folder, or reopens that of a resumed run. @throws InputError */
    void
    prepare(const RunOptions &options, const Scene &scene);

    void
    state_of_run(StateRow &row) override;

    /** Sets the reference state of all gains. */
    void
    set_initial(const ExplicitState &state);

    /** Adds a step to statistics.csv and to the balance of energy. */
    void
    add_step(const ExplicitRecord &record);

    /** Writes the points if requested. */
    void
    write_points(const double time, const std::vector<PointArrays> &groups);

    /** Topics of the summary: the results of all steps.
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

    /** Output quantity of the laws at the points of a group; not a number if undefined
     *  for the group's law. */
    void
    show(const std::string &name,
         const PointArrays &group,
         double            *values) const;

    ExplicitState               initial;
    std::unique_ptr<FieldFiles> point_files;
    double largest_impulse = 0.; ///< of all records, as a scale
  };
} // namespace geocone::GEOCONE_DIM

#endif
