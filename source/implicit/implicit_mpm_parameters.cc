// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Parameters of the implicit material point method, and their checks.
#include <geocone/base/exceptions.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/implicit/implicit_mpm.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    const UsedWhere used_implicit_mpm_parameters[] = {
      {"Material point method/Consistent integration",
       "Discretisation/Method",
       {"MPM"}},
      {"Material point method/Advection", "Discretisation/Method", {"MPM"}},
      {"Material point method/Consistent mass part",
       "Discretisation/Method",
       {"MPM"}},
      {"Material point method/Ghost stiffness",
       "Discretisation/Method",
       {"MPM"}},
      {"Material point method/Ghost stiffness of",
       "Discretisation/Method",
       {"MPM"}},
      {"Material point method/Ghost stiffness",
       "Material point method/Advection",
       {"grid velocity", "particle velocity"}},
      {"Material point method/Ghost stiffness of",
       "Material point method/Advection",
       {"grid velocity", "particle velocity"}},
      {"Material point method/Integration", "Discretisation/Method", {"MPM"}},
      {"Material point method/Start", "Discretisation/Method", {"MPM"}},
      {"Material point method/Largest move", "Discretisation/Method", {"MPM"}},
      {"Material point method/Grid follows", "Discretisation/Method", {"MPM"}}};
  } // namespace

  ImplicitMPM::ImplicitMPM(const ParameterFile &file)
    : ImplicitStepper("transfer")
    , ParameterAcceptor("/Material point method")
    , particles(file)
  {
    advection.declare(
      *this,
      "Advection",
      ": velocity by which particles move. Particle velocity lets loads drift "
      "with FLIP. None: particles and supports keep their positions, for limit "
      "loads by small strains.");
    add_parameter(
      "Consistent mass part",
      consistent_mass,
      "Part c of the consistent mass [-] in M = (1 - c) M_lumped + c "
      "M_consistent, 0 to 1. Values up to 0.999 are safe; with 1, M is "
      "singular where a cell has fewer particles than basis functions.",
      prm,
      Patterns::Double(0., 1.));
    add_parameter("Consistent integration",
                  consistent_integration,
                  "For B-splines and moving particles, with B-bar or "
                  "tractions, in full cells and those cut by a loaded side: "
                  "scales the weights of the particles to the volume of "
                  "the cell and corrects the mean gradients to those of the "
                  "cell. false: weights are the volumes of the particles.");
    add_parameter("Ghost stiffness",
                  ghost_part,
                  "Ghost stiffness gamma [-], 0 to 1: viscous stiffness, as a "
                  "part of Young's modulus, that couples low-mass B-splines of "
                  "small cut cells to their neighbours. It prevents spurious "
                  "velocities where few particles carry a load. 0: none.",
                  prm,
                  Patterns::Double(0., 1.));
    ghosts.declare(
      *this,
      "Ghost stiffness of",
      ": basis functions with ghost stiffness. All: fewer iterations where "
      "soil yields, but a dissipation of some per cent of the energy.");
    integration.declare(*this, ". All but the first lose less energy.");
    start_asked.declare(
      *this,
      "Start",
      ": initial guess of Newton's method. Grid velocity: that of the last "
      "step; best for slow loading. Particle velocity: velocity mapped from "
      "the particles, with the elastic tangent in the first iteration. "
      "Automatic: grid velocity, or particle velocity if that fails.");
    add_parameter(
      "Grid follows",
      grid_follows,
      "Name of a boundary condition imposed on averages or segments of a side "
      "that the grid follows: between steps its grid lines move with the side, "
      "and the cells beyond stretch to the ends of the grid, which are fixed. "
      "Empty: the grid is fixed.");
    add_parameter("Largest move",
                  largest_move,
                  "Largest displacement of a particle in a step, in cells [-]; "
                  "a step beyond it is halved.");
  }

  void
  ImplicitMPM::check_scene(const LinearSolverParameters &linear_solver)
  {
    const std::string section = "Material point method/";
    if (rule.is_affine() && consistent_mass > 0.)
      throw InputError(section + "Consistent mass part",
                       consistent_mass,
                       "0 with Transfer = " + rule.name(),
                       rule.name() +
                         " hands over momentum by the lumped mass and grows "
                         "without bound with another: set it to 0, or Transfer "
                         "= FLIP");
    if (!(largest_move > 0.))
      throw InputError(
        section + "Largest move", largest_move, "> 0 cells", "3 is usual");
    balance.prepare();
    integration.check(*scene, section);
    if (integration.is_newmark() && consistent_mass > 0.)
      throw InputError(section + "Consistent mass part",
                       consistent_mass,
                       "0 with Integration = Newmark",
                       "accelerations are forces over the lumped mass: set it "
                       "to 0, or take the theta-scheme");
    if (ghosts == Ghosts::all && !space->is_spline())
      throw InputError(
        section + "Ghost stiffness of",
        "all",
        "loaded sides, or Discretisation/Element = B-spline 2 | "
        "B-spline 3",
        "only splines have ghost stiffness: leave it out, or take "
        "splines");
    if (start_asked != Start::particles)
      starts.push_back(Start::nodes);
    if (start_asked != Start::nodes)
      starts.push_back(Start::particles);
    if (!space->is_non_negative() && consistent_mass < 1.)
      throw InputError("Discretisation/Basis",
                       "Lagrange",
                       "Bernstein where MPM lumps the mass",
                       "Lagrange's functions of degree 2 and 3 are negative "
                       "in places, and so would be masses: set Basis = "
                       "automatic, or '" +
                         section + "Consistent mass part' = 1");
    if (!scene->structures.list.empty())
      check_structures();
    ScaledLoads::check(*scene);
    if (drainage.acts)
      check_consolidation(linear_solver);
    check_axisymmetric_body(*scene);
    for (const auto &condition : scene->dirichlet.list)
      condition->refuse_normal("free with MPM",
                               "give Velocity x and y, or set "
                               "Discretisation/Method = FEM");
  }

  std::string
  ImplicitMPM::check_tractions(const unsigned int k) const
  {
    if (scene->tractions.list.empty())
      return "";
    const bool has_water = scene->materials.traits().undrained;
    if (has_water && !drainage.acts && !space->has_b_bar())
      throw InputError("Discretisation/B-bar",
                       "false",
                       "true where undrained particles move under tractions",
                       "set it to true with Element = B-spline 3, or let the "
                       "soil drain by 'Time stepping/Consolidation'");
    const std::string subject =
      "tractions on " + space->element() + " whose particles move: ";
    if (!space->is_spline() || !consistent_integration)
      return subject +
             "where they cross cells, stresses near the loaded side are off by "
             "up to the traction; take 'Discretisation/Element' = B-spline 3 "
             "with 'Material point method/Consistent integration' = true";
    const auto &conditions = scene->dirichlet.list;
    const bool  moves =
      std::any_of(conditions.begin(), conditions.end(), [](const auto &c) {
        return c->moves_with_body();
      });
    if (space->degree() < 3 && (moves || (has_water && !drainage.acts)))
      return subject +
             "stresses near moving sides, and pressures of undrained soil "
             "everywhere, are off by a third of the traction, by more than "
             "that "
             "with 2 particles per direction; take B-spline 3";
    if (k < 3)
      return subject +
             (has_water && moves
                ? "pore pressures near moving sides are off by up to a fifth"
                : "stresses in single points are off by up to two fifths") +
             " of the traction with 2 per direction, at inclined sides by "
             "more than it; take "
             "'Particles/Points per direction' = 3";
    return "";
  }

  void
  ImplicitMPM::check_structures() const
  {
    const std::string what   = "structures with MPM",
                      remedy = "leave out 'Structures/Names'";
    scene->refuse_contact(what, remedy);
    if (!integration.is_backward_euler())
      throw InputError("Material point method/Integration",
                       integration.word(),
                       "backward Euler with structures",
                       "take it, or " + remedy);
    if (!grid_follows.empty())
      throw InputError(FollowingGrid::parameter,
                       grid_follows,
                       "nothing with structures, which have places in the grid",
                       "leave it out, or " + remedy);
    if (const unsigned int n = Utilities::MPI::n_mpi_processes(
          mesh->triangulation().get_communicator());
        n > 1)
      scene->structures.refuse("MPM on " + std::to_string(n) + " ranks",
                               "take one rank, or Discretisation/Method = FEM");
  }

  void
  ImplicitMPM::check_contact(const MaterialPoints &points) const
  {
    if (!obstacles->exists())
      return;
    for (const auto &condition : scene->dirichlet.list)
      if (condition->moves_with_body())
        throw InputError(
          condition->parameter("Imposed on"),
          condition->imposition.word(),
          "nodes where there are obstacles or contacts",
          "press by an obstacle that moves, or by the nodes of a "
          "side");
    check_obstacles_of_particles(points.position,
                                 scene->obstacles,
                                 mesh->triangulation().get_communicator());
    if (bodies)
      check_bodies();
  }

  void
  ImplicitMPM::check_bodies() const
  {
    scene->tractions.refuse("bodies of particles that touch ('Contacts')",
                            "press by an obstacle that moves, or by weight");
    for (const auto &pair : scene->contacts.list)
      pair->law.check_without_area("Contacts/" + pair->name + "/");
    const Materials &materials = scene->materials;
    bool             is_fixed  = false;
    for (unsigned int m = 0; m < materials.size(); ++m)
      is_fixed = is_fixed || scene->regions.are_fixed(m);
    if (is_fixed && advection == Advection::none)
      throw InputError("Material point method/Advection",
                       advection.word(),
                       "grid velocity | particle velocity where some points "
                       "are fixed and touch others that are not",
                       "leave out 'Points = fixed': all of them stay");
    for (const auto &stage : scene->loading.list)
      {
        const std::string section = "Loading/" + stage->name + "/";
        if (stage->reset_displacement && is_fixed)
          throw InputError(section + "Reset displacement",
                           "true",
                           "false where points stay ('Points = fixed') and "
                           "touch others: these find them by their "
                           "displacement",
                           "leave it out, or let the points move");
        const std::vector<unsigned int> after =
          materials_after(*stage, materials);
        for (unsigned int m = 0; m < materials.size(); ++m)
          if (scene->contacts.body_of(m) != scene->contacts.body_of(after[m]))
            {
              const std::string from = materials.name(m),
                                to   = materials.name(after[m]);
              throw InputError(section + "Changed materials",
                               from + ": " + to,
                               "materials of one body",
                               "name '" + to + "' beside '" + from +
                                 "' in the contacts");
            }
      }
  }
} // namespace geocone::GEOCONE_DIM
