// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/limit_analysis/bounded_load.h>
#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/limit_analysis/mesh_from_bounds.h>
#include <geocone/mesh/adapted_sizes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace geocone::GEOCONE_DIM
{
  namespace mpi = dealii::Utilities::MPI;

  namespace
  {
    /** Load of a bound, if certified. @param unit the load that a problem's 1
     *  corresponds to */
    std::optional<double>
    proven(const Bound &bound, const double unit)
    {
      return bound.certified ? std::optional(unit * bound.load) : std::nullopt;
    }

    /** States which load is bracketed. */
    void
    describe(const BoundedLoad &load, const Scene &scene, LoadBracket &bracket)
    {
      bracket.unit                = load.unit() == "-" ? "" : load.unit();
      bracket.is_associated       = !load.non_associated();
      bracket.other_than_observed = load.other_than_observed(scene);
    }
  } // namespace

  std::pair<CellSizes, LoadBracket>
  sizes_from_bounds(const MeshParameters &parameters,
                    const Scene          &scene,
                    const MPI_Comm        comm,
                    Log                  &log)
  {
    constexpr double         growth = 2., tolerance = 1e-3;
    constexpr unsigned int   most_levels = 16;
    dealii::Timer            time;
    BoundedLoad              load;
    std::optional<CellSizes> sizes;
    LoadBracket              bracket;
    unsigned int             n_large = 0;
    double                   n_asked = 0.;
    for (unsigned int level = 0;; ++level)
      {
        const Triangles triangles(
          fitted_mesh(parameters, scene, comm, sizes ? &*sizes : nullptr));
        if (level == 0)
          load.prepare(scene, triangles);
        const double n_cells = triangles.cells.size();
        n_large += n_cells > 0.7 * parameters.number;
        const bool is_last = n_large == 4 || level + 1 == most_levels;
        // gmsh makes some more triangles than requested.
        const double surplus =
          n_asked > 0. ? std::clamp(n_cells / n_asked, 1., 1.4) : 1.;
        n_asked =
          std::min<double>(growth * n_cells, parameters.number) / surplus;
        std::string fault;
        CellSizes   next;
        double      gap = 0.;
        if (mpi::this_mpi_process(comm) == 0)
          try
            {
              const CertifiedBounds bounds =
                certified_bounds(load.on(scene, triangles), tolerance);
              const double lower = bounds.lower.bound.load,
                           upper = bounds.upper.bound.load;
              if (!std::isfinite(lower + upper) ||
                  bounds.upper.solution.grows || bounds.lower.solution.grows)
                fault = "the limit load of this scene has no finite bounds";
              else
                {
                  next = adapted_sizes(
                    triangles, bounds.refinement_indicator, n_asked);
                  gap = (upper - lower) / std::abs(lower);
                  bracket.take(
                    proven(bounds.lower.bound, load.load_of_unit_factor()),
                    proven(bounds.upper.bound, load.load_of_unit_factor()));
                  bracket.cells = triangles.cells.size();
                  if (is_last && load.non_associated())
                    bracket.davis = {
                      davis_estimate(load, scene, triangles, tolerance)};
                }
            }
          catch (const Stopped &)
            {} // all ranks are together here
        stop_if_asked(comm);
        fault = mpi::broadcast(comm, fault);
        if (!fault.empty())
          throw InputError("Mesh/Type",
                           parameters.type.word(),
                           "scenes whose limit load can be bounded: " + fault,
                           "set Mesh/Type = unstructured");
        sizes = CellSizes{mpi::broadcast(comm, next.triangles),
                          mpi::broadcast(comm, next.sizes)};
        if (is_last)
          {
            log.print(format("a mesh from the bounds: level %u with %.0f "
                             "triangles had a gap of %.2g %%; %.1f s",
                             level + 1,
                             n_cells,
                             100. * gap,
                             time.wall_time()));
            describe(load, scene, bracket);
            bracket.seconds = time.cpu_time();
            return {*sizes, bracket};
          }
      }
  }
} // namespace geocone::GEOCONE_DIM
