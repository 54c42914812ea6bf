// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What stages of the implicit material point method do to the body before their first
// step, and its state as part of a checkpoint.
#include <geocone/base/log.h>
#include <geocone/implicit/implicit_mpm.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  Vector
  ImplicitMPM::net_force(const MaterialPoints &points, const double t)
  {
    evaluate_force(points, t);
    Vector net = force, of_stress = problem->make_vector();
    problem->internal_forces().forces_at_start(of_stress);
    net -= of_stress;
    return net;
  }

  BodyChange
  ImplicitMPM::change_body(const Stage    &stage,
                           const double    t,
                           TimerOutput    &timer,
                           Kinematics     &kinematics,
                           MaterialPoints &points)
  {
    if (!begun)
      begin(points, timer);
    BodyChange change;
    change.before = state_energies(kinematics, points, t);
    Vector     difference;
    const auto take = [&](const double duration) {
      begin(points, timer);
      difference -= net_force(points, t);
      for (unsigned int i = 0; i < difference.locally_owned_size(); ++i)
        if (!constraints->has_mass(i))
          difference.local_element(i) = 0.;
      fading.add(std::move(difference), t, duration);
    };
    if (stage.removes())
      {
        std::vector<bool> stays;
        for (const Point<dim> &x : points.position)
          stays.push_back(!stage.removes(x));
        const MPI_Comm comm = force.get_mpi_communicator();
        change.remarks.push_back(stage.removal_text(
          Utilities::MPI::sum(std::count(stays.begin(), stays.end(), false),
                              comm),
          Utilities::MPI::sum(stays.size(), comm),
          "points"));
        difference = net_force(points, t);
        particles.keep(stays, points);
        take(stage.removal_duration);
      }
    if (!stage.added_materials.empty())
      {
        difference = net_force(points, t);
        for (unsigned int m = 0; m < scene->materials.size(); ++m)
          if (const std::string &name = scene->materials.name(m);
              std::count(stage.added_materials.begin(),
                         stage.added_materials.end(),
                         name) > 0)
            {
              change.remarks.push_back(
                format("added %lu points of the material '",
                       particles.add(m, points)) +
                name + "'");
              added.push_back(m);
            }
        take(stage.addition_duration);
      }
    if (!stage.changed_materials.empty())
      {
        for (const std::string &remark : change_materials(
               stage, *scene, *space, force.get_mpi_communicator(), points))
          change.remarks.push_back(remark);
        begin(points, timer);
      }
    change.after = state_energies(kinematics, points, t);
    return change;
  }

  void
  ImplicitMPM::save(Archive &archive, const MaterialPoints &points)
  {
    if (scene->loading.changes_body())
      {
        StateRow row;
        row(added);
        archive.write_row("added", row);
      }
    particles.save(archive, points);
    save_grid(archive);
  }

  void
  ImplicitMPM::save_grid(Archive &archive) const
  {
    if (scene->loading.changes_body())
      fading.save(archive, *mesh, *space);
    Vector mass(velocity_L);
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      mass.local_element(i) = had_mass.empty() || had_mass[i];
    save_nodes(archive, "had mass", *mesh, *space, mass);
    StateRow row;
    moving->state(row);
    obstacles->state(row);
    archive.write_row("sides", row);
  }

  void
  ImplicitMPM::take_points(const Archive &archive, MaterialPoints &points)
  {
    particles.load(archive, points);
    particles.forget_lost();
    begun = false;
  }

  void
  ImplicitMPM::load(const Archive &archive, MaterialPoints &points)
  {
    if (scene->loading.changes_body())
      {
        archive.read_row("added")(added);
        for (const unsigned int material : added)
          particles.forget(material); // they will not be again
      }
    load_grid(archive);
    if (following)
      follow_side();
    particles.load(archive, points);
    begun = false;
  }

  void
  ImplicitMPM::load_grid(const Archive &archive)
  {
    if (scene->loading.changes_body())
      fading.load(archive, *mesh, *space);
    StateRow row = archive.read_row("sides");
    moving->state(row);
    obstacles->state(row);
    Vector mass(velocity_L);
    load_nodes(archive, "had mass", *mesh, *space, mass);
    had_mass.resize(mass.locally_owned_size());
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      had_mass[i] = mass.local_element(i) > 0.;
  }
} // namespace geocone::GEOCONE_DIM
