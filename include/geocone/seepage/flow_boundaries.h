// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_boundaries_h
#define geocone_seepage_flow_boundaries_h

#include <geocone/scene/scene.h>
#include <geocone/seepage/flow_balance.h>
#include <geocone/seepage/flow_mesh.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Seepage boundaries and drains of a scene on a mesh, and the boundary conditions
   *  of the flow. */
  class FlowBoundaries
  {
  public:
    /** @param mesh must outlive this object
     *  @throws InputError as part_of() */
    FlowBoundaries(const Scene &scene, const FlowMesh &mesh);

    /** Part of the mesh on a seepage boundary or on a drain. */
    struct Part
    {
      std::vector<unsigned int> facets; ///< none of a drain in three dimensions
      std::vector<unsigned int> vertices;
    };

    /** @throws InputError if there is none, or no edges follow a drain */
    Part
    part_of(const SeepageBoundary &boundary) const;

    /** Checks water levels. @throws InputError for a level that is not above
     *  the lowest point of its boundary */
    void
    check(const Seepage::Levels &levels) const;

    /** @param time end of the step (s)
     *  @param duration of the step, whose mean rainfall rate is taken (s); 0:
     *  the rate at that time */
    FlowConditions
    conditions(const Seepage::Levels &levels,
               const double           time,
               const double           duration) const;

    /** Initial guess for Newton's method: hydrostatic pressures below the
     *  highest water level. */
    std::vector<double>
    hydrostatic(const Seepage::Levels &levels, const bool is_unsaturated) const;

    /** @name Index of the seepage boundary; -1: none */
    /** @{ */
    std::vector<int> of_vertex, of_facet;
    /** @} */

  private:
    const Scene    &scene;
    const FlowMesh &mesh;
  };
} // namespace geocone::GEOCONE_DIM

#endif
