// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Consolidation in steps with fixed and moving points: its checks, drained sides,
// and pressures as a part of the incremental problem.
#include <geocone/base/exceptions.h>
#include <geocone/base/over_ranks.h>
#include <geocone/implicit/implicit_fem.h>
#include <geocone/implicit/implicit_mpm.h>
#include <geocone/materials/retention.h>
#include <geocone/points/point_elasticity.h>
#include <geocone/problem/consolidation.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    [[noreturn]] void
    refuse_consolidation(const std::string &allowed, const std::string &remedy)
    {
      throw InputError(Drainage::parameter, "true", allowed, remedy);
    }

    /** Refuses water so stiff that rounding of the volumetric strain decides the
     *  level of the pressures of a closed body. Collective. */
    void
    check_level(const Scene             &scene,
                const MaterialPoints    &points,
                const PressureFunctions &functions,
                const MPI_Comm           comm)
    {
      std::array<double, 3> sums = {}; // drained nodes, outflow, flow
      for (const bool is_drained : functions.is_drained)
        sums[0] += is_drained;
      const unsigned int n = functions.n_vertices;
      for (unsigned int i = 0; i < functions.flow.size() / n; ++i)
        {
          double row = 0.;
          for (unsigned int j = 0; j < n; ++j)
            row += functions.flow[n * i + j];
          sums[1] += std::abs(row);
          sums[2] += functions.flow[n * i + i % n];
        }
      sum_over_ranks(sums, comm);
      if (sums[0] > 0. || sums[1] > 1e-10 * sums[2])
        return;
      for (unsigned int p = 0; p < points.n_points(); ++p)
        {
          const unsigned int m     = points.material[p];
          const double       fluid = scene.materials.law(m).fluid_modulus(),
                       most =
                         1e10 *
                         elasticity_at_start(scene.materials, points, p).two_G;
          if (fluid > most)
            throw InputError(
              "Materials/" + scene.materials.name(m) +
                "/Pore fluid bulk modulus",
              fluid,
              format("at most %g Pa where no side is drained", most),
              "the level of the pressures would be rounding: "
              "water has 2.2 GPa, over the porosity; or name "
              "'Time stepping/Drained sides'");
        }
    }
  } // namespace

  void
  ImplicitStepper::check_consolidation(
    const LinearSolverParameters &linear_solver) const
  {
    if (dim == 3)
      refuse_consolidation("false in three dimensions",
                           "compute a plane or axisymmetric scene");
    scene->refuse_contact(std::string(Drainage::parameter) + " = true",
                          "leave out contact, or consolidation");
    if (scene->loading.changes_body())
      refuse_consolidation(
        "false with stages that remove, add or change material",
        "compute these stages with undrained or drained soil");
    for (unsigned int m = 0; m < scene->materials.size(); ++m)
      if (scene->water.seepage.acts() &&
          scene->materials.law(m).retention().adds_strength())
        refuse_consolidation(
          "false with a 'Bishop parameter'",
          "consolidating soil is saturated: leave out 'Materials/" +
            scene->materials.name(m) + "/Bishop parameter'");
    if (scene->water.scales_with_weight())
      refuse_consolidation("false with a 'Water/Pore pressure ratio'",
                           "its pressures do not dissipate: give steady ones "
                           "by 'Water/Table'");
    if (scene->water.flow_steps().size() > 1)
      refuse_consolidation(
        "false where the steady pore pressures change in time",
        "keep the water levels of all stages");
    if (space->has_b_bar() && scene->materials.traits().dilates)
      throw InputError("Discretisation/B-bar",
                       "true",
                       std::string("false with ") + Drainage::parameter +
                         " and a 'Dilatancy angle' > 0",
                       "take triangles, P2 or P3, or no dilatancy");
    if (linear_solver.is_iterative())
      throw InputError("Linear solver/Name",
                       linear_solver.name.word(),
                       "a direct solver with 'Time stepping/Consolidation'",
                       "set it to automatic");
  }

  void
  ImplicitStepper::add_flow(const MaterialPoints &points,
                            PressureFunctions     functions,
                            Vector               *at_vertices)
  {
    if constexpr (dim == 2)
      {
        check_level(
          *scene, points, functions, mesh->triangulation().get_communicator());
        flow = std::make_unique<Consolidation>(scene->materials,
                                               points,
                                               *constraints,
                                               std::move(functions),
                                               space->partitioner(),
                                               at_vertices);
        problem->add(*flow);
      }
  }

  void
  ImplicitFEM::check_consolidation(
    const LinearSolverParameters &linear_solver) const
  {
    ImplicitStepper::check_consolidation(linear_solver);
    if (inertia)
      refuse_consolidation("false with inertia",
                           "set Time stepping/Inertia = false");
    if (space->is_spline() || space->degree() < 2)
      throw InputError("Discretisation/Element",
                       space->element(),
                       std::string("P2, P3, Q2 or Q3 with ") +
                         Drainage::parameter,
                       "pressures are linear: velocities of degree 1 give "
                       "oscillating ones");
    if (space->has_ties())
      refuse_consolidation("false with tied sides",
                           "leave out 'Discretisation/Tied sides'");
    for (const auto &boundary : scene->water.seepage.list)
      if (!boundary->drain.empty())
        refuse_consolidation("false with drains in the body",
                             "leave out 'Seepage/" + boundary->name +
                               "/Drain'");
  }

  std::vector<bool>
  ImplicitFEM::drained_nodes() const
  {
    std::vector<bool> is_drained(space->n_local_nodes(), false);
    for (const std::string &name : drainage.sides)
      for (const unsigned int node : space->nodes_on_sides(
             {mesh->side_id(name,
                            Drainage::parameter_of_sides,
                            "leave it out where no water leaves")}))
        is_drained[node] = true;
    for (const auto &boundary : scene->water.seepage.list)
      for (const auto &[name, id] : mesh->named_sides())
        if (boundary->is_on_side(name))
          for (const unsigned int node : space->nodes_on_sides({id}))
            if (boundary->holds_at(space->node_positions()[node]))
              is_drained[node] = true;
    return is_drained;
  }

  void
  ImplicitMPM::check_consolidation(
    const LinearSolverParameters &linear_solver) const
  {
    ImplicitStepper::check_consolidation(linear_solver);
    if (!space->is_spline())
      throw InputError("Discretisation/Element",
                       space->element(),
                       std::string("B-spline 2 | B-spline 3 with MPM and ") +
                         Drainage::parameter,
                       "take splines: the gradients of other functions jump "
                       "where particles change cells");
    if (!integration.is_backward_euler())
      throw InputError("Material point method/Integration",
                       integration.word(),
                       std::string("backward Euler with ") +
                         Drainage::parameter,
                       "take it: the water balance is of first order in time");
    if (!grid_follows.empty())
      throw InputError(FollowingGrid::parameter,
                       grid_follows,
                       std::string("nothing with ") + Drainage::parameter,
                       "leave it out");
    scene->structures.refuse(std::string(Drainage::parameter) + " and MPM",
                             "set Discretisation/Method = FEM");
    // A steady flow is that through the body at the start.
    scene->water.seepage.refuse(std::string(Drainage::parameter) + " and MPM",
                                "give water at rest by 'Water/Table', or set "
                                "Discretisation/Method = FEM");
    scene->dirichlet.refuse_stages(
      std::string(Drainage::parameter) + " and MPM",
      "let them act in all stages: a side is "
      "impervious where its velocity is prescribed");
  }

  void
  ImplicitMPM::add_flow_between(const MaterialPoints &points)
  {
    std::set<dealii::types::boundary_id> named;
    for (const std::string &name : drainage.sides)
      named.insert(mesh->side_id(name,
                                 Drainage::parameter_of_sides,
                                 "leave it out where no water leaves"));
    const auto &conditions = scene->dirichlet.list;
    std::vector<std::set<dealii::types::boundary_id>> sides;
    for (const auto &condition : conditions)
      sides.push_back(mesh->side_ids(*condition)); // collective
    // Axes of the normals of the sides of the box.
    std::map<dealii::types::boundary_id, unsigned int> axis;
    for (unsigned int d = 0; d < dim; ++d)
      for (const char *name : side_of_box[d])
        if (const auto side = mesh->named_sides().find(name);
            side != mesh->named_sides().end())
          axis[side->second] = d;
    const auto is_held = [&](const dealii::types::boundary_id side,
                             const dealii::Point<dim>        &x) {
      const auto along = axis.find(side);
      for (unsigned int c = 0; c < conditions.size(); ++c)
        {
          const BoundaryCondition &one = *conditions[c];
          if (sides[c].count(side) > 0 && !one.moves_with_body() &&
              one.holds_at(x) &&
              (along == axis.end() || one.normal ||
               one.components[along->second]))
            return true;
        }
      return false;
    };
    if constexpr (dim == 2)
      add_flow(points,
               pressures_of_particles(*scene,
                                      *mesh,
                                      *space,
                                      points,
                                      [&](const dealii::types::boundary_id side,
                                          const dealii::Point<dim>        &x) {
                                        return named.count(side) > 0 ||
                                               !is_held(side, x);
                                      }),
               &pore_pressure);
  }
} // namespace geocone::GEOCONE_DIM
