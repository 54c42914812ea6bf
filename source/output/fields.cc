// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/fields.h>

namespace geocone
{
  using namespace dealii;

  namespace
  {
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
                const double          time,
                const BackgroundMesh &mesh,
                const Space          &space,
                const MaterialPoints &points,
                const Kinematics     &kinematics)
  {
    const MPI_Comm comm = mesh.triangulation().get_communicator();
    // Also on a rank that has no points, to write the same data as the others.
    const bool moving =
      Utilities::MPI::logical_or(!points.values.empty(), comm);
    PatchOutput<dim>    on_cells;
    std::vector<Vector> on_nodes;
    if (!moving)
      {
        on_cells.add_vector("displacement");
        on_nodes.push_back(kinematics.displacement);
      }
    on_cells.add_vector("velocity");
    on_nodes.push_back(kinematics.velocity);
    for (Vector &vector : on_nodes)
      vector.update_ghost_values();
    const unsigned int scalars = on_cells.names.size(); // from there on
    for (const char *name : {"material",
                             "stress_xx",
                             "stress_yy",
                             "stress_xy",
                             "plastic_strain_rate",
                             "cumulative_plastic_strain"})
      on_cells.add_scalar(name);

    const auto          parts = sub_cells(space.degree(), mesh.is_simplicial());
    std::vector<double> N(points.n_nodes);
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      {
        const auto        &cell     = points.cells[c];
        const unsigned int first    = points.first_point[c];
        double             means[5] = {}, area = 0.;
        for (unsigned int p = first; p < points.first_point[c + 1]; ++p)
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
                space.evaluate(cell, part[k], N.data(), nullptr);
                for (unsigned int i = 0; i < points.n_nodes; ++i)
                  for (unsigned int f = 0; f < on_nodes.size(); ++f)
                    for (unsigned int d = 0; d < dim; ++d)
                      patch.data(dim * f + d, k) +=
                        N[i] * on_nodes[f].local_element(dim * nodes[i] + d);
                patch.data(scalars, k) = points.material[first];
                for (unsigned int m = 0; m < 5; ++m)
                  patch.data(scalars + 1 + m, k) = means[m] / area;
              }
            on_cells.patches.push_back(patch);
          }
      }
    cells.write(on_cells, folder, time, comm);

    PatchOutput<0> on_points;
    for (const char *name : {"material",
                             "volume",
                             "stress_xx",
                             "stress_yy",
                             "stress_xy",
                             "plastic_strain_xx",
                             "plastic_strain_yy",
                             "plastic_strain_xy",
                             "plastic_strain_rate",
                             "cumulative_plastic_strain"})
      on_points.add_scalar(name);
    if (moving)
      {
        // Their order changes from time to time.
        on_points.add_scalar("id");
        for (const char *name : {"velocity", "displacement"})
          on_points.add_vector(name);
      }
    for (unsigned int p = 0; p < points.n_points(); ++p)
      {
        PatchOutput<0>::Patch patch;
        patch.patch_index = p;
        patch.vertices[0] = points.position[p];
        patch.data.reinit(on_points.names.size(), 1);
        const Mandel       &s = points.stress[p], &e = points.plastic_strain[p];
        std::vector<double> values = {static_cast<double>(points.material[p]),
                                      points.weight[p],
                                      s[0],
                                      s[1],
                                      s[2] / sqrt2,
                                      e[0],
                                      e[1],
                                      e[2] / sqrt2,
                                      points.plastic_strain_rate[p],
                                      points.cumulative_plastic_strain[p]};
        if (moving)
          {
            values.push_back(points.id[p]);
            for (const auto *vectors : {&points.velocity, &points.displacement})
              for (unsigned int d = 0; d < dim; ++d)
                values.push_back((*vectors)[p][d]);
          }
        for (unsigned int i = 0; i < values.size(); ++i)
          patch.data(i, 0) = values[i];
        on_points.patches.push_back(patch);
      }
    point_clouds.write(on_points, folder, time, comm);
  }
} // namespace geocone
