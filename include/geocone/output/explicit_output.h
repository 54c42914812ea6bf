// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_explicit_output_h
#define geocone_output_explicit_output_h

#include <geocone/explicit/explicit_mpm.h>
#include <geocone/output/energy_balance.h>
#include <geocone/output/field_files.h>
#include <geocone/output/output_base.h>
#include <geocone/output/statistics_table.h>
#include <geocone/scene/scene.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** The points and the balance at the end of a step of the loading programme. */
  struct ExplicitRecord
  {
    unsigned int   step = 0;
    double         time = 0.;
    double         cpu  = 0.; ///< CPU time of its explicit steps, this rank (s)
    ExplicitReport report;
    ExplicitState  state;
    Exchange       exchange;
    std::vector<dealii::Tensor<1, dim>> displacements; ///< of observed points

    /** For checkpoints. */
    void
    to_row(StateRow &row)
    {
      row(step, time, cpu, report, state, exchange, displacements);
    }
  };

  /**
   * The folder of an explicit run: statistics.csv (a line per step of the loading
   * programme, each of many explicit ones), summary.json and points-NNNN.vtu, with
   *   numerical loss    = gravity's and the supports' work - stress work
   *                       - damping - removed - kinetic energy gained,
   * which is that of EnergyBalance, and
   *   momentum residual = momentum gained + removed - impulse of gravity,
   *                       supports and damping,
   * which is zero up to rounding. Read only with respect to the state.
   */
  class ExplicitOutput : public OutputBase
  {
  public:
    ExplicitOutput(const MPI_Comm comm, Log &log);

    /** Makes the folder, or enters that of the run before. @throws InputError */
    void
    prepare(const RunOptions &options, const Scene &scene);

    void
    state_of_run(StateRow &row) override;

    /** The state that gains are counted from. */
    void
    set_initial(const ExplicitState &state);

    /** Adds a line to statistics.csv. */
    void
    add_record(const ExplicitRecord &record);

    /** Writes the points, if wanted. */
    void
    write_points(const double time, const std::vector<PointArrays> &groups);

    /** Writes summary.json. @param status running | finished | failed: why */
    void
    write_summary(const std::string &status,
                  const LawCounts   &counts,
                  const Json        &size,
                  const Json        &cost);

    /** Prints the result; in tests also a file `output` with all records. */
    void
    print_result() const;

  private:
    using Record = ExplicitRecord;

    /** @name The columns of statistics.csv, with their units in plane strain */
    /** @{ */
    void
    add(const std::string &column, const StatisticsTable<Record>::Value &value);
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

    /** See the class. */
    dealii::Tensor<1, dim>
    momentum_residual(const ExplicitRecord &record) const;

    /** As Geometry::unit(). */
    std::string
    unit(const std::string &in_plane_strain) const
    {
      return scene->geometry.unit(in_plane_strain);
    }

    /** One of the values that laws show, of the points of a group; not a number
     *  where its law does not know it. */
    void
    show(const std::string &name,
         const PointArrays &group,
         double            *values) const;

    const Scene            *scene = nullptr;
    StatisticsTable<Record> table;

    ExplicitState               initial;
    std::vector<ExplicitRecord> records;
    std::unique_ptr<FieldFiles> point_files;

    EnergyBalance balance;
    double        largest_impulse = 0.; ///< of all records, for scales
  };
} // namespace geocone::GEOCONE_DIM

#endif
