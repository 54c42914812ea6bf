// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/output/fields.h>

#include <array>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Linear cells, in unit coordinates, that represent a cell of degree p. */
    std::vector<std::vector<Point<dim>>>
    sub_cells(const unsigned int p, const bool simplicial)
    {
      std::vector<std::vector<Point<dim>>> cells;
      const auto                           x = [&](const unsigned int i,
                         const unsigned int j,
                         const unsigned int k = 0) {
        Point<dim> place;
        place[dim - 1] = double(k) / p;
        place[0]       = double(i) / p;
        place[1]       = double(j) / p;
        return place;
      };
      if constexpr (dim == 3)
        {
          if (simplicial)
            {
              // For degree 2: four at the corners, and the octahedron between them
              // split into four around its diagonal from the midpoint of 01 to that of
              // 23.
              if (p == 1)
                return {{x(0, 0, 0), x(1, 0, 0), x(0, 1, 0), x(0, 0, 1)}};
              const Point<dim> o = x(1, 0, 0), q = x(0, 1, 1);
              return {{x(0, 0, 0), x(1, 0, 0), x(0, 1, 0), x(0, 0, 1)},
                      {x(1, 0, 0), x(2, 0, 0), x(1, 1, 0), x(1, 0, 1)},
                      {x(0, 1, 0), x(1, 1, 0), x(0, 2, 0), x(0, 1, 1)},
                      {x(0, 0, 1), x(1, 0, 1), x(0, 1, 1), x(0, 0, 2)},
                      {o, x(1, 1, 0), x(0, 1, 0), q},
                      {o, x(0, 1, 0), x(0, 0, 1), q},
                      {o, x(0, 0, 1), x(1, 0, 1), q},
                      {o, x(1, 0, 1), x(1, 1, 0), q}};
            }
          for (unsigned int k = 0; k < p; ++k)
            for (unsigned int j = 0; j < p; ++j)
              for (unsigned int i = 0; i < p; ++i)
                {
                  cells.emplace_back();
                  for (unsigned int v = 0; v < 8; ++v)
                    cells.back().push_back(
                      x(i + v % 2, j + v / 2 % 2, k + v / 4));
                }
          return cells;
        }
      for (unsigned int j = 0; j < p; ++j)
        for (unsigned int i = 0; i < p; ++i)
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

    /** Tensor component of a Mandel vector. */
    double
    component(const Mandel &t, const int i)
    {
      return is_shear(i) ? t[i] / sqrt2 : t[i];
    }

    /** Cell data at a point: the material, and variables of which means are
     *  written. */
    std::vector<
      std::pair<std::string, std::function<double(const unsigned int)>>>
    variables_of_cells(const MaterialPoints &points, const Materials &materials)
    {
      std::vector<
        std::pair<std::string, std::function<double(const unsigned int)>>>
                 list;
      const auto add = [&](const std::string &name, const auto &value) {
        list.emplace_back(name, value);
      };
      add("material", [&](const unsigned int p) { return points.material[p]; });
      for (int i = 0; i < n_mandel; ++i)
        add(std::string("stress_") + tensor_component[i],
            [&points, i](const unsigned int p) {
              return component(points.stress[p], i);
            });
      if constexpr (dim == 2)
        add(std::string("stress_") + tensor_component[n_mandel],
            [&](const unsigned int p) {
              return materials[points.material[p]].stress_zz(
                components_of(points.stress[p]), points.history_of(p));
            });
      add("plastic_strain_rate",
          [&](const unsigned int p) { return points.plastic_strain_rate[p]; });
      add("cumulative_plastic_strain", [&](const unsigned int p) {
        return points.cumulative_plastic_strain[p];
      });
      if (materials.traits().undrained)
        add("excess_pore_pressure",
            [&](const unsigned int p) { return points.excess_pressure(p); });
      return list;
    }

    /** Volume mean over the points of a cell. */
    double
    mean_over(const MaterialPoints                            &points,
              const unsigned int                               c,
              const std::function<double(const unsigned int)> &value)
    {
      double volume = 0., sum = 0.;
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        {
          volume += points.volume[p];
          sum += points.volume[p] * value(p);
        }
      return sum / volume;
    }

    /** Components of points or vectors, one after another. */
    template <typename Values>
    FieldTable::Fill
    components(const Values &values)
    {
      return [&values](std::vector<double> &to) {
        for (std::size_t i = 0; i < to.size(); ++i)
          to[i] = values[i / dim][i % dim];
      };
    }

    /** Table of cells as linear ones, with nodal vectors and means. All arguments
     *  must outlive it. */
    FieldTable
    table_of_cells(const BackgroundMesh                              &mesh,
                   const Space                                       &space,
                   const MaterialPoints                              &points,
                   const Materials                                   &materials,
                   const std::vector<std::pair<std::string, Vector>> &on_nodes)
    {
      std::vector<Point<dim>> nodes; // of all parts of a cell
      for (const auto &part : sub_cells(space.degree(), mesh.is_simplicial()))
        nodes.insert(nodes.end(), part.begin(), part.end());
      FieldTable table;
      using Kind      = FieldTable::Cell;
      table.cell      = mesh.is_simplicial()
                          ? dim == 2 ? Kind::triangle : Kind::tetrahedron
                        : dim == 2 ? Kind::quadrilateral
                                   : Kind::hexahedron;
      table.n_nodes   = points.n_cells() * nodes.size();
      table.positions = [&, nodes](std::vector<double> &to) {
        auto value = to.begin();
        for (const auto &cell : points.cells)
          for (const Point<dim> &unit : nodes)
            {
              const Point<dim> x =
                mesh.mapping().transform_unit_to_real_cell(cell, unit);
              for (unsigned int d = 0; d < dim; ++d)
                *value++ = x[d];
            }
      };
      for (const auto &[name, vector] : on_nodes)
        table.columns.push_back(
          {name, dim, [&, nodes, v = &vector](std::vector<double> &to) {
             const unsigned int  n = points.n_nodes;
             std::vector<double> N(n * nodes.size());
             auto                value = to.begin();
             for (unsigned int c = 0; c < points.n_cells(); ++c)
               {
                 if (c == 0 || space.is_spline())
                   for (unsigned int k = 0; k < nodes.size(); ++k)
                     space.evaluate(
                       points.cells[c], nodes[k], &N[n * k], nullptr);
                 for (unsigned int k = 0; k < nodes.size(); ++k)
                   for (unsigned int d = 0; d < dim; ++d)
                     {
                       double sum = 0.;
                       for (unsigned int i = 0; i < n; ++i)
                         sum +=
                           N[n * k + i] *
                           v->local_element(dim * points.nodes[n * c + i] + d);
                       *value++ = sum;
                     }
               }
           }});
      for (const auto &[name, value] : variables_of_cells(points, materials))
        table.columns.push_back(
          {name,
           1,
           [&, n = nodes.size(), is_first = name == "material", value = value](
             std::vector<double> &to) {
             for (unsigned int c = 0; c < points.n_cells(); ++c)
               std::fill_n(to.begin() + n * c,
                           n,
                           is_first ? value(points.first_point[c])
                                    : mean_over(points, c, value));
           }});
      return table;
    }

    /** Table of the points with their variables, which must outlive it. */
    FieldTable
    table_of_points(const BackgroundMesh &mesh,
                    const MaterialPoints &points,
                    const Materials      &materials,
                    const bool            moving)
    {
      FieldTable table;
      table.n_nodes   = points.n_points();
      table.positions = components(points.position);
      const auto add  = [&](const std::string &name, const auto &value) {
        table.columns.push_back(
          {name, 1, [value = value](std::vector<double> &to) mutable {
             for (std::size_t p = 0; p < to.size(); ++p)
               to[p] = value(p);
           }});
      };
      if (moving)
        {
          table.columns.push_back(
            {"velocity", dim, components(points.velocity)});
          table.columns.push_back(
            {"displacement", dim, components(points.displacement)});
        }
      add("material", [&](const std::size_t p) { return points.material[p]; });
      add("volume", [&](const std::size_t p) { return points.volume[p]; });
      // Section of a point in the plane.
      if (mesh.is_axisymmetric())
        add("area", [&](const std::size_t p) {
          return points.volume[p] / mesh.measure(points.position[p]);
        });
      const auto add_tensor = [&](const std::string         &name,
                                  const std::vector<Mandel> &values) {
        for (int i = 0; i < n_mandel; ++i)
          add(name + "_" + tensor_component[i],
              [&values, i](const std::size_t p) {
                return component(values[p], i);
              });
      };
      add_tensor("stress", points.stress);
      for (const std::string &name : materials.shown_names())
        {
          std::vector<ShownValue> of_law;
          for (unsigned int m = 0; m < materials.size(); ++m)
            of_law.emplace_back(materials.law(m), name);
          add(name, [&points, of_law](const std::size_t p) mutable {
            return of_law[points.material[p]](components_of(points.stress[p]),
                                              points.history_of(p));
          });
        }
      if (materials.traits().undrained)
        add("excess_pore_pressure",
            [&](const std::size_t p) { return points.excess_pressure(p); });
      add_tensor("plastic_strain", points.plastic_strain);
      add("plastic_strain_rate",
          [&](const std::size_t p) { return points.plastic_strain_rate[p]; });
      add("cumulative_plastic_strain", [&](const std::size_t p) {
        return points.cumulative_plastic_strain[p];
      });
      if (moving) // their order changes
        add("id", [&](const std::size_t p) { return points.id[p]; });
      return table;
    }
  } // namespace

  void
  Fields::write(const std::string    &folder,
                const double          time,
                const BackgroundMesh &mesh,
                const Space          &space,
                const MaterialPoints &points,
                const Materials      &materials,
                const Kinematics     &kinematics)
  {
    const MPI_Comm comm = mesh.triangulation().get_communicator();
    // Also on a rank without points, so that all ranks write the same data.
    const bool moving =
      Utilities::MPI::logical_or(!points.values.empty(), comm);
    std::vector<std::pair<std::string, Vector>> on_nodes;
    if (!moving)
      on_nodes.emplace_back("displacement", kinematics.displacement);
    on_nodes.emplace_back("velocity", kinematics.velocity);
    for (auto &field : on_nodes)
      field.second.update_ghost_values();
    cells.write(table_of_cells(mesh, space, points, materials, on_nodes),
                folder,
                time,
                comm);
    point_clouds.write(
      table_of_points(mesh, points, materials, moving), folder, time, comm);
  }

  FieldTable
  table_of_obstacles(const Obstacles                &obstacles,
                     const std::vector<RigidMotion> &moved,
                     const BoundingBox<dim>         &box,
                     const MPI_Comm                  comm)
  {
    const auto [low, high] = box.get_boundary_points();
    // The first rank writes all of them.
    std::vector<double> places, numbers, displacements;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      for (unsigned int o = 0; o < obstacles.list.size(); ++o)
        for (const ObstacleShape::Triangle &triangle :
             obstacles.list[o]->triangles(
               moved[o], low + (high - low) / 2., low.distance(high)))
          for (const Point<dim> &x : triangle)
            {
              const Tensor<1, dim> arm =
                x - obstacles.list[o]->centre() - moved[o].centre;
              const Tensor<1, dim> displacement =
                moved[o].centre + arm - moved[o].turned(arm, true);
              for (unsigned int d = 0; d < dim; ++d)
                {
                  places.push_back(x[d]);
                  displacements.push_back(displacement[d]);
                }
              numbers.push_back(o);
            }
    FieldTable table;
    table.cell      = FieldTable::Cell::triangle;
    table.n_nodes   = numbers.size();
    table.positions = [places](std::vector<double> &values) {
      values = places;
    };
    table.columns = {
      {"obstacle",
       1,
       [numbers](std::vector<double> &values) { values = numbers; }},
      {"displacement", dim, [displacements](std::vector<double> &values) {
         values = displacements;
       }}};
    return table;
  }

  void
  Fields::write_obstacles(const std::string              &folder,
                          const double                    time,
                          const BackgroundMesh           &mesh,
                          const Obstacles                &obstacles,
                          const std::vector<RigidMotion> &moved)
  {
    const MPI_Comm comm = mesh.triangulation().get_communicator();
    if (!obstacles.list.empty())
      solids.write(
        table_of_obstacles(obstacles, moved, mesh.bounding_box(), comm),
        folder,
        time,
        comm);
  }
} // namespace geocone::GEOCONE_DIM
