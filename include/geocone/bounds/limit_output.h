// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_limit_output_h
#define geocone_bounds_limit_output_h

#include <geocone/output/load_bracket.h>
#include <geocone/output/mesh_output.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Results of one refinement level (mesh) of a limit analysis, with both bounds in the
   *  unit of the load. The computational cost is included. */
  struct BoundLevel
  {
    unsigned int number = 0; ///< level number, from 1
    unsigned int cells = 0, unknowns_upper = 0, unknowns_lower = 0;
    double       lower = 0., upper = 0., gap = 0.; ///< gap: upper/lower - 1
    bool         lower_certified = false, upper_certified = false;
    unsigned int iterations_lower = 0, iterations_upper = 0;
    double       violation_lower = 0., violation_upper = 0.;
    double       error_lower = 0., error_upper = 0.;
    double       gap_share   = 0.; ///< CertifiedBounds::gap_share
    double       cpu_seconds = 0., mesh_seconds = 0.;
    double       memory = 0.; ///< largest of the process so far (MB)

    bool
    certified() const
    {
      return lower_certified && upper_certified;
    }

    void
    state(StateRow &row);
  };

  /** Returns the tightest certified bounds over a list of refinement levels,
   *  with the total cost of all levels. This is possible because the bounds of
   *  every mesh are valid for the body. */
  LoadBracket
  best_of(const std::vector<BoundLevel> &levels);

  /**
   * Returns the order of convergence of the gap between the bounds, with respect to the
   * number of cells. It is minus the slope of log(gap) over log(cells) of the last three
   * meshes with both bounds, by least squares. Empty if fewer than two meshes have both
   * bounds.
   */
  std::optional<double>
  order_of_gap(const std::vector<BoundLevel> &levels);

  /**
   * Returns an estimate of the limit load, which is no bound: the middle between the
   * bounds, extrapolated linearly in the gap from the last two meshes with both bounds to
   * a gap of zero. Empty if fewer than two meshes have both bounds, if the gap has not
   * decreased, or if the estimate is not between the best bounds.
   */
  std::optional<double>
  middle_without_gap(const std::vector<BoundLevel> &levels);

  /** Output of a limit analysis: table of levels, fields of each level, and summary. The
   *  table bounds.csv has a line for each level. */
  class LimitOutput : public MeshOutput<BoundLevel>
  {
  public:
    using MeshOutput::MeshOutput;

    /** Declares the parameter for files that prove both bounds. */
    void
    declare_certificates();

    /** Returns true if files that prove both bounds are requested. */
    bool
    writes_certificates() const
    {
      return with_certificates;
    }

    /** Opens the output files of a limit analysis. @param unit of the load,
     *  e.g. "N/m"
     *  @param reference value of the load or factor of safety, if known */
    void
    prepare(const RunOptions           &options,
            const std::string          &unit,
            const std::optional<double> reference);

    /** Returns the JSON object "bounds" of summary.json. At least one level is
     *  required. */
    Json
    bounds(const LoadBracket &bracket) const;

  private:
    void
    report_results(std::ostream &out) const override;

    bool with_certificates = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
