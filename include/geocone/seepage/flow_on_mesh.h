// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_on_mesh_h
#define geocone_seepage_flow_on_mesh_h

#include <geocone/base/log.h>
#include <geocone/functions/triangle_field.h>
#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/scene/scene.h>
#include <geocone/seepage/flow_solution.h>

#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Steady flow through the body of a scene on meshes that are refined at the free
   *  surface and where the velocity changes. */
  class FlowOnMesh
  {
  public:
    /** @param levels of the open water at the boundaries
     *  @throws InputError if a material has no permeability */
    FlowOnMesh(const Scene           &scene,
               const Seepage::Levels &levels,
               const MPI_Comm         comm);

    /** @throws InputError for a level that is not above the lowest point of its side on
     *  the present mesh */
    void
    check(const Seepage::Levels &levels) const;

    /** Solves a step of a transient flow on the present mesh. @throws RunError */
    void
    advance(const Seepage::Step &step);

    /** Water above that which cannot drain (m^2; m^3 in axisymmetry). @pre drainable
     *  porosities are given */
    double
    stored() const;

    /** Number of meshes. */
    unsigned int
    n_levels() const;

    /** Solves the flow on the first mesh, or on one with twice as many triangles as the
     *  last. Collective. @throws InputError, RunError */
    void
    refine();

    /** Pore pressures and free surface. */
    Water::Flow
    result() const;

    const Triangles &
    triangles() const
    {
      return *mesh;
    }

    const FlowSolution &
    flow() const
    {
      return steady;
    }

    /** Darcy velocity of a cell (m/s). */
    dealii::Tensor<1, dim>
    velocity(const unsigned int cell) const
    {
      return darcy_velocity(*mesh, permeability, steady, cell);
    }

    /** Flow into the body through each boundary of the list (m^2/s; m^3/s in
     *  axisymmetry). */
    std::vector<double>
    inflows() const;

    /** Flow through the body: the sum of all inflows, or of all outflows if it is larger
     *  (m^2/s). */
    double
    discharge() const;

    /** Relative change of the discharge from the mesh before; none on the first mesh. */
    std::optional<double>
    change() const;

    /** Whether more water flows than by rounding. */
    bool
    flows() const;

    /** Sum of the flows through all boundaries, less what is stored, over the
     *  discharge. */
    double
    imbalance() const;

    /** The discharge with its change, for the log. */
    std::string
    text() const;

  private:
    /** Edges of the mesh at a boundary or a drain. @throws InputError if there are none */
    std::vector<unsigned int>
    edges_of(const SeepageBoundary &boundary) const;

    FlowConditions
    conditions();

    /** Contribution of each cell to the error: jumps of the normal velocity. */
    std::vector<double>
    jumps() const;

    /** chi of each vertex, not restricted to [0, 1]. */
    std::vector<double>
    saturation() const;

    /** Drainable volume of each vertex (m^2). */
    std::vector<double>
    drainable() const;

    /** Solves the flow on the present mesh. */
    void
    solve(const FlowConditions &conditions, std::vector<double> start);

    /** Start of Newton's method: from the last mesh, or hydrostatic pressures. */
    std::vector<double>
    start(const std::vector<dealii::Point<dim>> &vertices,
          const std::optional<TriangleField>    &last) const;

    const Scene                               &scene;
    Seepage::Levels                            levels;
    const MPI_Comm                             comm;
    const bool                                 is_transient; ///< now or later
    std::vector<dealii::SymmetricTensor<2, 2>> permeability;
    CellSizes                                  sizes;
    std::optional<Triangles>                   mesh;
    FlowSolution                               steady;
    std::vector<int>      boundary_of; ///< of each vertex, or -1
    std::vector<int>      boundary_of_edge;
    std::optional<double> discharge_before;
    double                rate_of_storage = 0.; ///< (m^2/s)
  };

  /** Solves all flows of a scene, and gives their pressures to its water. Collective.
   *  @param dry_run whether the first flow, on a coarse mesh, will do
   *  @param time whose pressures are the initial ones (s) */
  void
  let_water_flow(Scene         &scene,
                 const MPI_Comm comm,
                 Log           &log,
                 const bool     dry_run,
                 const double   time = 0.);
} // namespace geocone::GEOCONE_DIM

#endif
