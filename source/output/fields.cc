// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/output/fields.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <deal.II/numerics/data_component_interpretation.h>

namespace geocone
{
  using namespace dealii;

  namespace
  {
    /** Patches with named data, which the base class writes as VTU. */
    template <int patch_dim>
    class PatchOutput : public DataOutInterface<patch_dim, dim>
    {
    public:
      using Patch = DataOutBase::Patch<patch_dim, dim>;

      std::vector<Patch>       patches;
      std::vector<std::string> names;
      std::vector<
        std::tuple<unsigned int,
                   unsigned int,
                   std::string,
                   DataComponentInterpretation::DataComponentInterpretation>>
        vectors;

      void
      add_scalar(const std::string &name)
      {
        names.push_back(name);
      }

      void
      add_vector(const std::string &name)
      {
        vectors.emplace_back(
          names.size(),
          names.size() + dim - 1,
          name,
          DataComponentInterpretation::component_is_part_of_vector);
        for (unsigned int c = 0; c < dim; ++c)
          names.push_back(name);
      }

      /** Writes base-NNNN.vtu (or a file per rank and base-NNNN.pvtu). */
      void
      write(const std::string                           &folder,
            const std::string                           &base,
            const unsigned int                           number,
            const double                                 time,
            const MPI_Comm                               comm,
            std::vector<std::pair<double, std::string>> &series)
      {
        const unsigned int    n_ranks = Utilities::MPI::n_mpi_processes(comm);
        const unsigned int    rank    = Utilities::MPI::this_mpi_process(comm);
        DataOutBase::VtkFlags flags;
        flags.time  = time;
        flags.cycle = number;
        this->set_flags(flags);

        const std::string stem  = base + format("-%04u", number);
        const auto        piece = [&](const unsigned int r) {
          return n_ranks == 1 ? stem + ".vtu" : stem + format(".%03u.vtu", r);
        };
        write_file(folder + "/" + piece(rank),
                   [&](std::ostream &out) { this->write_vtu(out); });
        if (rank != 0)
          return;
        std::string whole = piece(0);
        if (n_ranks > 1)
          {
            std::vector<std::string> pieces;
            for (unsigned int r = 0; r < n_ranks; ++r)
              pieces.push_back(piece(r));
            whole = stem + ".pvtu";
            write_file(folder + "/" + whole, [&](std::ostream &out) {
              this->write_pvtu_record(out, pieces);
            });
          }
        series.emplace_back(time, whole);
        write_file(folder + "/" + base + ".pvd", [&](std::ostream &out) {
          DataOutBase::write_pvd_record(out, series);
        });
      }

    protected:
      const std::vector<Patch> &
      get_patches() const override
      {
        return patches;
      }

      std::vector<std::string>
      get_dataset_names() const override
      {
        return names;
      }

      std::vector<
        std::tuple<unsigned int,
                   unsigned int,
                   std::string,
                   DataComponentInterpretation::DataComponentInterpretation>>
      get_nonscalar_data_ranges() const override
      {
        return vectors;
      }
    };

    /** The linear cells, in unit coordinates, that a cell of degree p shows as. */
    std::vector<std::vector<Point<dim>>>
    sub_cells(const unsigned int p, const bool simplicial)
    {
      std::vector<std::vector<Point<dim>>> cells;
      const double                         d = 1. / p;
      const auto                           x = [&](const int i, const int j) {
        return Point<dim>(i * d, j * d);
      };
      for (int j = 0; j < static_cast<int>(p); ++j)
        for (int i = 0; i < static_cast<int>(p); ++i)
          if (!simplicial)
            cells.push_back(
              {x(i, j), x(i + 1, j), x(i, j + 1), x(i + 1, j + 1)});
          else
            {
              const int left = p - i - j;
              if (left > 0)
                cells.push_back({x(i, j), x(i + 1, j), x(i, j + 1)});
              if (left > 1)
                cells.push_back({x(i + 1, j), x(i + 1, j + 1), x(i, j + 1)});
            }
      return cells;
    }
  } // namespace

  void
  Fields::write(const std::string    &folder,
                const unsigned int    number,
                const double          time,
                const BackgroundMesh &mesh,
                const Space          &space,
                const MaterialPoints &points,
                const Kinematics     &kinematics)
  {
    const MPI_Comm comm = mesh.triangulation().get_communicator();
    Vector         u = kinematics.displacement, v = kinematics.velocity;
    u.update_ghost_values();
    v.update_ghost_values();

    PatchOutput<dim> on_cells;
    on_cells.add_vector("displacement");
    on_cells.add_vector("velocity");
    for (const char *name : {"material",
                             "stress_xx",
                             "stress_yy",
                             "stress_xy",
                             "plastic_strain_rate",
                             "cumulative_plastic_strain"})
      on_cells.add_scalar(name);

    const auto   parts = sub_cells(space.degree(), mesh.is_simplicial());
    unsigned int c     = 0;
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          double means[5] = {}, area = 0.;
          for (unsigned int p = points.first_point[c];
               p < points.first_point[c + 1];
               ++p)
            {
              const double V = points.weight[p];
              area += V;
              means[0] += V * points.stress[p][0];
              means[1] += V * points.stress[p][1];
              means[2] += V * points.stress[p][2] / sqrt2;
              means[3] += V * points.plastic_strain_rate[p];
              means[4] += V * points.cumulative_plastic_strain[p];
            }
          const unsigned int *nodes = &points.nodes[c * points.n_nodes];
          for (const auto &part : parts)
            {
              PatchOutput<dim>::Patch patch;
              patch.patch_index    = on_cells.patches.size();
              patch.n_subdivisions = 1;
              patch.reference_cell = cell->reference_cell();
              patch.data.reinit(on_cells.names.size(), part.size());
              for (unsigned int k = 0; k < part.size(); ++k)
                {
                  patch.vertices[k] =
                    mesh.mapping().transform_unit_to_real_cell(cell, part[k]);
                  for (unsigned int i = 0; i < points.n_nodes; ++i)
                    {
                      const double N =
                        space.finite_element().shape_value(i, part[k]);
                      for (unsigned int d = 0; d < dim; ++d)
                        {
                          patch.data(d, k) +=
                            N * u.local_element(dim * nodes[i] + d);
                          patch.data(dim + d, k) +=
                            N * v.local_element(dim * nodes[i] + d);
                        }
                    }
                  patch.data(2 * dim, k) = cell->material_id();
                  for (unsigned int m = 0; m < 5; ++m)
                    patch.data(2 * dim + 1 + m, k) = means[m] / area;
                }
              on_cells.patches.push_back(patch);
            }
          ++c;
        }
    on_cells.write(folder, "cells", number, time, comm, cells);

    PatchOutput<0> on_points;
    for (const char *name : {"material",
                             "stress_xx",
                             "stress_yy",
                             "stress_xy",
                             "plastic_strain_xx",
                             "plastic_strain_yy",
                             "plastic_strain_xy",
                             "plastic_strain_rate",
                             "cumulative_plastic_strain"})
      on_points.add_scalar(name);
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        PatchOutput<0>::Patch patch;
        patch.patch_index = p;
        patch.vertices[0] = points.position[p];
        patch.data.reinit(on_points.names.size(), 1);
        const Mandel &s = points.stress[p], &e = points.plastic_strain[p];
        const double  values[] = {static_cast<double>(points.material[p]),
                                  s[0],
                                  s[1],
                                  s[2] / sqrt2,
                                  e[0],
                                  e[1],
                                  e[2] / sqrt2,
                                  points.plastic_strain_rate[p],
                                  points.cumulative_plastic_strain[p]};
        for (unsigned int i = 0; i < on_points.names.size(); ++i)
          patch.data(i, 0) = values[i];
        on_points.patches.push_back(patch);
      }
    on_points.write(folder, "points", number, time, comm, point_clouds);
  }
} // namespace geocone
