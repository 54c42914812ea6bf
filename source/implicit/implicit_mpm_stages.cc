// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Changes of the body at the beginning of stages of the implicit material point
// method, and its state in a checkpoint.
#include <geocone/base/log.h>
#include <geocone/implicit/implicit_mpm.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  void
  ImplicitMPM::remove(const Stage              &stage,
                      MaterialPoints           &points,
                      std::vector<std::string> &remarks)
  {
    std::vector<bool> stays;
    for (const Point<dim> &x : points.position)
      stays.push_back(!stage.removes(x));
    const MPI_Comm comm = force.get_mpi_communicator();
    remarks.push_back(stage.removal_text(
      Utilities::MPI::sum(std::count(stays.begin(), stays.end(), false), comm),
      Utilities::MPI::sum(stays.size(), comm),
      "points"));
    particles.keep(stays, points);
    moving->remove(stage, 0., 0.); // its forces are ramped on the nodes
  }

  void
  ImplicitMPM::add(const Stage              &stage,
                   MaterialPoints           &points,
                   std::vector<std::string> &remarks)
  {
    for (unsigned int m = 0; m < scene->materials.size(); ++m)
      if (const std::string &name = scene->materials.name(m);
          std::count(stage.added_materials.begin(),
                     stage.added_materials.end(),
                     name) > 0)
        {
          remarks.push_back(format("added %lu points of the material '",
                                   particles.add(m, points)) +
                            name + "'");
          added.push_back(m);
          moving->add(m);
        }
  }

  void
  ImplicitMPM::change_nodes(const std::vector<bool> & /* had_mass */,
                            Kinematics & /* kinematics */,
                            Vector &difference) const
  {
    for (unsigned int i = 0; i < difference.locally_owned_size(); ++i)
      if (!constraints->has_mass(i))
        difference.local_element(i) = 0.;
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
      ramped.save(archive, *mesh, *space);
    Vector mass(velocity_L);
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      mass.local_element(i) = had_mass.empty() || had_mass[i];
    save_nodes(archive, "had mass", *mesh, *space, mass);
    if (drainage.acts)
      save_nodes(archive, "pore pressure", *mesh, *space, pore_pressure);
    StateRow row;
    moving->state(row);
    obstacles->state(row);
    if (bars)
      bars->state(row);
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
          particles.forget(material); // for good
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
      ramped.load(archive, *mesh, *space);
    StateRow row = archive.read_row("sides");
    moving->state(row);
    obstacles->state(row);
    if (bars)
      bars->state(row);
    Vector mass(velocity_L);
    load_nodes(archive, "had mass", *mesh, *space, mass);
    if (drainage.acts)
      load_nodes(archive, "pore pressure", *mesh, *space, pore_pressure);
    had_mass.resize(mass.locally_owned_size());
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      had_mass[i] = mass.local_element(i) > 0.;
  }
} // namespace geocone::GEOCONE_DIM
