// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_on_mesh_h
#define geocone_seepage_flow_on_mesh_h

#include <geocone/base/log.h>
#include <geocone/functions/triangle_field.h>
#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/scene/scene.h>
#include <geocone/seepage/flow_solution.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Flow through the body of a scene: steady on meshes that are refined at the free
   *  surface and where the velocity changes, transient on one mesh. */
  class FlowOnMesh
  {
  public:
    /** Makes the first mesh. Collective.
     *  @throws InputError for materials without a permeability, or a porosity where it
     *  is needed, and for levels of any step that are not above their sides */
    FlowOnMesh(const Scene &scene, const MPI_Comm comm);

    /** Solves a steady flow on all meshes, or a step of a transient flow on the present
     *  one. Collective.
     *  @param after_mesh called after each mesh
     *  @throws RunError, Stopped */
    void
    solve(
      const Seepage::Step         &step,
      const std::function<void()> &after_mesh = []() {});

    /** Solves a steady flow on the first mesh only. @throws RunError */
    void
    solve_on_first_mesh(const Seepage::Levels &levels);

    /** Whether there is a flow on the present mesh. */
    bool
    is_solved() const
    {
      return solution.s.size() == mesh.vertices.size();
    }

    /** Drainable water in the body (m^2; m^3 in axisymmetry). @pre drainable porosities
     *  are given */
    double
    stored() const;

    /** Pore pressures and free surface. */
    Water::Flow
    result() const;

    const Triangles &
    triangles() const
    {
      return mesh;
    }

    const FlowSolution &
    flow() const
    {
      return solution;
    }

    /** Darcy velocity of each cell (m/s). */
    std::vector<dealii::Tensor<1, dim>>
    velocities() const;

    /** Flow into the body through each boundary of the list (m^2/s; m^3/s in
     *  axisymmetry). */
    std::vector<double>
    inflows() const;

    /** Flow through the body: the sum of all inflows, or of all outflows if it is larger
     *  (m^2/s). */
    double
    discharge() const;

    /** Relative change of the discharge from the previous mesh; none on the
     *  first mesh, and in transient flow. */
    std::optional<double>
    change() const;

    /** Whether the discharge exceeds rounding errors. */
    bool
    flows() const;

    /** Defect of the mass balance: net inflow through all boundaries minus the
     *  rate of storage, over the discharge. */
    double
    imbalance() const;

    /** The discharge with its change, for the log. */
    std::string
    text() const;

  private:
    unsigned int
    n_levels() const;

    /** Adopts a mesh, and finds its boundaries and the volumes of its
     *  vertices. */
    void
    take(const Triangles &next);

    /** Mesh of triangles with these sizes. Collective. */
    Triangles
    mesh_with(const CellSizes &sizes) const;

    /** Edges of the mesh at a boundary or a drain. @throws InputError if there are none */
    std::vector<unsigned int>
    edges_of(const SeepageBoundary &boundary) const;

    /** @throws InputError for a level that is not above the lowest point of its side */
    void
    check(const Seepage::Levels &levels) const;

    FlowConditions
    conditions(const Seepage::Levels &levels) const;

    void
    solve_on_mesh(const FlowConditions &conditions, std::vector<double> start);

    /** Initial guess of Newton's method: hydrostatic pressures below the
     *  highest level. */
    std::vector<double>
    hydrostatic(const Seepage::Levels &levels) const;

    /** Refines the mesh to twice as many triangles. Collective. */
    void
    refine(const Seepage::Levels &levels);

    /** Solves a step of a transient flow. */
    void
    advance(const Seepage::Step &step);

    /** Contribution of each cell to the error: jumps of the normal velocity. */
    std::vector<double>
    jumps() const;

    /** chi of each vertex, not restricted to [0, 1]. */
    std::vector<double>
    saturation() const;

    const Scene                               &scene;
    const MPI_Comm                             comm;
    const bool                                 is_transient; ///< now or later
    std::vector<dealii::SymmetricTensor<2, 2>> permeability;
    Triangles                                  first_mesh;

    /** @name The present mesh */
    /** @{ */
    Triangles           mesh;
    std::vector<double> measure;     ///< factor of the area of each cell
    std::vector<int>    boundary_of; ///< of each vertex, or -1
    std::vector<int>    boundary_of_edge;
    std::vector<double> drainable; ///< volume of each vertex (m^2)
    /** @} */

    FlowSolution          solution;
    std::optional<double> discharge_before;
    double                rate_of_storage = 0.; ///< (m^2/s)
  };

  /** Solves all flows of a scene, and passes their pressures to its water.
   *  Collective.
   *  @param dry_run whether only the first flow is solved, on a coarse mesh
   *  @param time whose pressures are the initial ones (s) */
  void
  let_water_flow(Scene         &scene,
                 const MPI_Comm comm,
                 Log           &log,
                 const bool     dry_run,
                 const double   time = 0.);
} // namespace geocone::GEOCONE_DIM

#endif
