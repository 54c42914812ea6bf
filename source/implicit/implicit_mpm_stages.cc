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
    moving->loads().remove(stage, 0., 0.); // its forces are ramped on the nodes
  }

  namespace
  {
    /** Least share of the volume of a material that overlaps other soil: what
     *  exceeds the volumes of its cells. Collective. */
    double
    overlapping_share(const BackgroundMesh &mesh,
                      const MaterialPoints &points,
                      const unsigned int    material)
    {
      const unsigned int  n = mesh.triangulation().n_active_cells();
      std::vector<double> all(n, 0.), own(n, 0.);
      for (unsigned int p = 0; p < points.n_points(); ++p)
        {
          all[points.cell[p]] += points.volume[p];
          if (points.material[p] == material)
            own[points.cell[p]] += points.volume[p];
        }
      double too_much = 0., whole = 0.;
      for (const auto &cell : mesh.own_cells())
        {
          const unsigned int c = cell->active_cell_index();
          const double volume  = cell->measure() * mesh.measure(cell->center());
          too_much += std::clamp(all[c] - volume, 0., own[c]);
          whole += own[c];
        }
      const MPI_Comm comm = mesh.triangulation().get_communicator();
      whole               = Utilities::MPI::sum(whole, comm);
      too_much            = Utilities::MPI::sum(too_much, comm);
      return whole > 0. ? too_much / whole : 0.;
    }
  } // namespace

  void
  ImplicitMPM::add(const Stage    &stage,
                   MaterialPoints &points,
                   BodyChange     &change)
  {
    for (unsigned int m = 0; m < scene->materials.size(); ++m)
      if (const std::string &name = scene->materials.name(m);
          std::count(stage.added_materials.begin(),
                     stage.added_materials.end(),
                     name) > 0)
        {
          change.remarks.push_back(format("added %lu points of the material '",
                                          particles.add(m, points)) +
                                   name + "'");
          if (const double share = overlapping_share(*mesh, points, m);
              share > 0.05)
            change.warnings.push_back(
              format("%.2g %% of the material '%s', or more, is put where soil "
                     "is that has moved there: begin it above that soil",
                     100. * share,
                     name.c_str()));
          added.push_back(m);
          moving->loads().add(m);
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
