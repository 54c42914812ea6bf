// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_seepage_flow_on_mesh_h
#define geocone_seepage_flow_on_mesh_h

#include <geocone/base/log.h>
#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/mesh/mesh_parameters.h>
#include <geocone/scene/scene.h>
#include <geocone/seepage/confined_flow.h>
#include <geocone/seepage/flow_boundaries.h>
#include <geocone/seepage/flow_solution.h>
#include <geocone/seepage/unsaturated_flow.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Seepage through the body of a scene. Steady flow is solved on meshes
   *  refined at the free surface and where the velocity varies, transient flow
   *  on one mesh. In three dimensions the first mesh is that of the scene. If the
   *  materials have retention curves, the soil above the free surface is
   *  unsaturated (UnsaturatedFlow), otherwise it has no suction. */
  class FlowOnMesh
  {
  public:
    /** Creates the first mesh of the seepage analysis. Collective.
     *  @param parameters of the mesh of the scene, in three dimensions
     *  @throws InputError for materials without a permeability or, in transient
     *  flow, a drainable porosity, and for water levels that are not above the
     *  lowest point of their boundary */
    FlowOnMesh(const Scene          &scene,
               const MPI_Comm        comm,
               const MeshParameters *parameters);

    /** Solves steady flow on successively refined meshes, or one time step of
     *  transient flow on the current mesh. Collective.
     *  @param after_mesh called after each mesh
     *  @throws RunError, Stopped */
    void
    solve(
      const Seepage::Step         &step,
      const std::function<void()> &after_mesh = []() {});

    /** Solves the steady flow problem on the first mesh, without refinement.
     *  @throws RunError */
    void
    solve_on_first_mesh(const Seepage::Step &step);

    /** Returns true if the flow on the current mesh has been solved. */
    bool
    is_solved() const
    {
      return solution.s.size() == mesh.vertices.size();
    }

    /** Volume of drainable water stored in the body (m^2; m^3 in axisymmetry).
     *  In unsaturated soil it is the volume of all water.
     *  @pre drainable porosities are given */
    double
    stored() const;

    /** Pore pressures and free surface of the computed flow. */
    Water::Flow
    result() const;

    const FlowMesh &
    current_mesh() const
    {
      return mesh;
    }

    const FlowSolution &
    flow() const
    {
      return solution;
    }

    /** Darcy velocity at the centre of each cell (m/s). */
    std::vector<dealii::Tensor<1, dim>>
    velocities() const;

    /** Darcy velocities at the corners of each cell, one after the other. */
    std::vector<dealii::Tensor<1, dim>>
    velocities_at_corners() const;

    /** Flow rate into the body through each seepage boundary of the scene
     *  (m^2/s; m^3/s in axisymmetry). */
    std::vector<double>
    inflows() const;

    /** Discharge through the body: the larger of total inflow and total outflow
     *  (m^2/s; m^3/s in axisymmetry). */
    double
    discharge() const;

    /** Relative change of the discharge from the previous to the current mesh
     *  (-). Empty on the first mesh and for transient flow. */
    std::optional<double>
    change() const;

    /** Returns true if the discharge is larger than rounding errors. */
    bool
    flows() const;

    /** Returns true if the soil is unsaturated above the free surface. */
    bool
    is_unsaturated() const
    {
      return !curves.empty();
    }

    /** Retention curve of the material in a cell. @pre is_unsaturated() */
    const Retention &
    curve(const unsigned int cell) const
    {
      return *curves[mesh.material[cell]];
    }

    /** Number of time steps of the last transient flow problem. */
    unsigned int
    n_steps() const
    {
      return steps_taken;
    }

    /** Relative error of the water balance (-). It is the net inflow through
     *  all boundaries minus the rate of storage, divided by the discharge. For
     *  unsaturated flow it is the maximum over the time steps, and the divisor
     *  is the larger of discharge and rate of redistribution. */
    double
    imbalance() const;

    /** Discharge and its relative change as text, for the log. */
    std::string
    text() const;

    /** Warnings of a discharge that is infinite, or changed by more than 3 % on the
     *  last mesh. */
    std::vector<std::string>
    warnings() const;

  private:
    unsigned int
    n_levels() const;

    /** Sets the current mesh and finds its seepage boundaries and drainable
     *  volumes. The latter belong to the vertices. */
    void
    take(const FlowMesh &next);

    void
    solve_on_mesh(const FlowConditions &conditions, std::vector<double> start);

    /** Computes the flow with heads of a higher degree after the linear ones.
     *  @throws InputError for a flow with a free surface */
    void
    solve_confined(const Seepage::Levels &levels);

    /** Refines the mesh adaptively to twice as many cells and solves steady
     *  flow. Collective. */
    void
    refine(const Seepage::Step &step);

    /** Checks the parameters of unsaturated flow. @throws InputError */
    void
    check_unsaturated() const;

    /** Sets hydrostatic initial pressures relative to a water table.
     *  @param table height y (m) */
    void
    begin_at_rest(const double table);

    /** Solves a time step of transient flow. */
    void
    advance(const Seepage::Step &step);

    /** Solves transient unsaturated flow by adaptive time steps.
     *  @throws RunError */
    void
    advance_unsaturated(const Seepage::Step &step);

    /** Water levels at a time within a step: the prescribed ones, otherwise in
     *  proportion between those at both ends of the step.
     *  @param left time to the end of the step (s) */
    Seepage::Levels
    levels_within(const Seepage::Step   &step,
                  const Seepage::Levels &from,
                  const double           left) const;

    /** Takes over the solution after a time step of h seconds, and records the
     *  rate of storage and the error of the water balance. */
    void
    accept(const UnsaturatedFlow &flow, FlowSolution next, const double h);

    /** Error indicator of each cell, computed from the jumps of the normal
     *  velocity across the facets of the cell. */
    std::vector<double>
    jumps() const;

    /** Relative permeability chi at each vertex, not limited to [0, 1]. */
    std::vector<double>
    saturation() const;

    const Scene                                 &scene;
    const MPI_Comm                               comm;
    const bool                                   is_transient; ///< in any step
    std::vector<dealii::SymmetricTensor<2, dim>> permeability;
    std::vector<const Retention *> curves; ///< by material; empty: no suction
    FlowMesh                       first_mesh;

    /** @name The current mesh */
    /** @{ */
    FlowMesh            mesh;
    std::vector<double> measure;     ///< area factor by cell
    std::optional<FlowBoundaries> boundaries;
    std::vector<double> drainable; ///< drainable volume by vertex (m^2)
    /** @} */

    FlowSolution                solution;
    std::optional<ConfinedFlow> confined;         ///< of a higher degree
    std::vector<int>            boundary_of_node; ///< of it
    std::optional<double>       discharge_before;
    FlowBoundaries::Jump        jump; ///< the largest one so far
    double                      rate_of_storage = 0.; ///< (m^2/s)

    /** @name Time steps in unsaturated soil */
    /** @{ */
    Seepage::Levels     levels_now;
    double              step_size = 0.; ///< of the next step; 0: none yet (s)
    double              last_step = 0.; ///< (s)
    std::vector<double> last_change;    ///< of saturations in it
    unsigned int        steps_taken   = 0;  ///< of the last flow
    double              largest_error = 0.; ///< of the balance in them
    /** @} */
  };

  /** Solves all seepage flow problems of a scene. The pore pressures are passed
   *  to Scene::water. Collective.
   *  @param dry_run whether to solve only the first flow problem, on a coarse
   *  mesh
   *  @param time at which the pressures are the initial pore pressures (s)
   *  @param parameters of the mesh of the scene, in three dimensions */
  void
  let_water_flow(Scene                &scene,
                 const MPI_Comm        comm,
                 Log                  &log,
                 const bool            dry_run,
                 const double          time       = 0.,
                 const MeshParameters *parameters = nullptr);
} // namespace geocone::GEOCONE_DIM

#endif
