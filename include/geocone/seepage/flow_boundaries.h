// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_boundaries_h
#define geocone_seepage_flow_boundaries_h

#include <geocone/scene/scene.h>
#include <geocone/seepage/flow_balance.h>
#include <geocone/seepage/flow_mesh.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Seepage boundaries and drains of a scene on a mesh, and the boundary conditions
   *  of the flow. */
  class FlowBoundaries
  {
  public:
    /** @param mesh must outlive this object
     *  @throws InputError for a boundary that is no part of the mesh */
    FlowBoundaries(const Scene &scene, const FlowMesh &mesh);

    /** Part of the mesh on a seepage boundary or on a drain. */
    struct Part
    {
      std::vector<unsigned int> facets; ///< none of a drain in three dimensions
      std::vector<unsigned int> connections; ///< of a drain
      std::vector<unsigned int> vertices;
    };

    /** Facets and vertices of one boundary whose soil has one permeability. */
    struct Group : Part
    {
      double permeability = 0.; ///< trace, of the more permeable cell (m/s)
      int    boundary     = -1;
    };

    /** Groups of all boundaries. A node of several groups belongs to the last of
     *  them, that of the most permeable soil, as the flow there determines the
     *  head; in the same soil to that of the highest initial level. */
    const std::vector<Group> &
    groups() const
    {
      return all_groups;
    }

    /** Difference of the heads that two boundaries prescribe where they meet. The
     *  discharge is infinite there: that between the distances a and b of the
     *  vertex is flow ln(b/a)/pi. */
    struct Jump
    {
      double             size = 0.; ///< (m)
      double             flow = 0.; ///< size times harmonic mean of k (m^2/s)
      dealii::Point<dim> at;
      int                higher = -1, lower = -1; ///< boundaries
    };

    /** The jump with the largest flow. */
    Jump
    largest_jump(const Seepage::Levels &levels) const;

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
    /** @throws InputError if there is none, or no edges follow a drain */
    Part
    part_of(const SeepageBoundary &boundary) const;

    std::vector<Group>
    sorted_groups() const;

    /** Pressure head that a boundary prescribes at a vertex; 0 above its level,
     *  and without one. */
    double
    head(const std::optional<double> &level, const unsigned int vertex) const
    {
      return level ? std::max(*level - mesh.vertices[vertex][1], 0.) : 0.;
    }

    const Scene       &scene;
    const FlowMesh    &mesh;
    std::vector<Part>  parts; ///< of all boundaries; they may overlap
    std::vector<Group> all_groups;
  };
} // namespace geocone::GEOCONE_DIM

#endif
