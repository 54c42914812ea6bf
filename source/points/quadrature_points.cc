// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/mesh/empty_regions.h>
#include <geocone/points/history_start.h>
#include <geocone/points/quadrature_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <map>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  Quadrature<dim>
  stress_quadrature(const Space &space, const BackgroundMesh &mesh)
  {
    const unsigned int p = space.degree();
    if (!mesh.is_simplicial())
      return QGauss<dim>(p + 1);
    if (p < 3) // 1 point of degree 1; degree 3, 4 points in the plane
      return QGaussSimplex<dim>(p);
    return QWitherdenVincentSimplex<dim>(3); // 7 points, degree 5
  }

  struct CellValues::Geometry
  {
    Geometry(const BackgroundMesh &mesh, const Quadrature<dim> &quadrature)
      : nothing(mesh.triangulation().get_reference_cells().front())
      , fe_values(mesh.mapping(),
                  nothing,
                  quadrature,
                  update_inverse_jacobians | update_JxW_values |
                    update_quadrature_points)
    {}
    FE_Nothing<dim> nothing;
    FEValues<dim>   fe_values;
  };

  CellValues::CellValues(const Space           &space,
                         const BackgroundMesh  &mesh,
                         const Quadrature<dim> &quadrature)
    : quadrature(quadrature)
    , position(quadrature.size())
    , weight(quadrature.size())
    , mesh(mesh)
    , space(space)
    , n_nodes(space.nodes_per_cell())
    , reference_value(quadrature.size() * n_nodes)
    , reference_gradient(quadrature.size() * n_nodes)
    , geometry(std::make_unique<Geometry>(mesh, quadrature))
  {}

  CellValues::~CellValues() = default;

  void
  CellValues::reinit(const Space::Cell &cell)
  {
    // Splines differ between cells, elements do not.
    const bool evaluate = space.is_spline() || !is_evaluated;
    is_evaluated        = true;
    geometry->fe_values.reinit(Triangulation<dim>::cell_iterator(cell));
    for (unsigned int q = 0; q < position.size(); ++q)
      {
        if (evaluate)
          space.evaluate(cell,
                         quadrature.point(q),
                         &reference_value[q * n_nodes],
                         &reference_gradient[q * n_nodes]);
        position[q] = geometry->fe_values.quadrature_point(q);
        weight[q]   = geometry->fe_values.JxW(q) * mesh.measure(position[q]);
      }
  }

  Tensor<1, dim>
  CellValues::gradient(const unsigned int i, const unsigned int q) const
  {
    return reference_gradient[q * n_nodes + i] *
           Tensor<2, dim>(geometry->fe_values.inverse_jacobian(q));
  }

  namespace
  {
    /** Copies the states of cells in both sets. */
    void
    copy_states(const MaterialPoints &from, MaterialPoints &to)
    {
      std::vector<double>                  row(to.n_numbers());
      std::map<unsigned int, unsigned int> cell_of;
      for (unsigned int c = 0; c < from.n_cells(); ++c)
        cell_of[from.cells[c]->active_cell_index()] = c;
      for (unsigned int c = 0; c < to.n_cells(); ++c)
        if (const auto found = cell_of.find(to.cells[c]->active_cell_index());
            found != cell_of.end())
          for (unsigned int k = 0;
               k < to.first_point[c + 1] - to.first_point[c];
               ++k)
            {
              from.get(from.first_point[found->second] + k, row.data());
              to.set(to.first_point[c] + k, row.data());
            }
    }
  } // namespace

  MaterialPoints
  quadrature_points_of(
    const Scene                                             &scene,
    const BackgroundMesh                                    &mesh,
    const Space                                             &space,
    const MaterialPoints                                    &known,
    const std::function<bool(const BackgroundMesh::Cell &)> &is_there)
  {
    MaterialPoints points;
    points.n_nodes = space.nodes_per_cell();
    points.use(false, scene.materials.n_history());
    for (const auto &cell : mesh.own_cells())
      if (is_there(cell))
        points.cells.push_back(cell);
    CellValues values(space, mesh, stress_quadrature(space, mesh));
    const std::size_t n_points = points.cells.size() * values.quadrature.size();
    points.set_capacity(n_points);
    points.gradients.reserve(n_points * dim * points.n_nodes);
    std::vector<types::global_dof_index> nodes;
    HistoryStart                         start;
    for (const auto &cell : points.cells)
      {
        values.reinit(cell);
        space.cell_nodes(cell, nodes);
        for (const types::global_dof_index node : nodes)
          points.nodes.push_back(space.local_node(node));
        for (unsigned int q = 0; q < values.quadrature.size(); ++q)
          {
            const unsigned int p        = points.n_points();
            const Point<dim>  &x        = values.position[q];
            const unsigned int material = cell->material_id();
            points.set_size(p + 1);
            points.volume[p]   = values.weight[q];
            points.position[p] = x;
            points.material[p] = material;
            points.stress[p]   = scene.initial_stress.at(
              x, material, scene.materials, scene.regions);
            start.set(scene.materials.law(material),
                      stress_of(extended(points.stress[p],
                                         scene.initial_stress.zz_at(
                                           x, material, points.stress[p]))),
                      space.band_width(BackgroundMesh::size_of(cell)),
                      x,
                      points.history_of(p));
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int i = 0; i < points.n_nodes; ++i)
                points.gradients.push_back(values.gradient(i, q)[c]);
            if (mesh.is_axisymmetric())
              for (unsigned int i = 0; i < points.n_nodes; ++i)
                points.hoop.push_back(values.value(i, q) / x[0]);
          }
        points.first_point.push_back(points.n_points());
      }
    start.check<InputError>(mesh.triangulation().get_communicator());
    points.weight.assign(points.volume.begin(), points.volume.end());
    if (space.has_b_bar())
      project_gradients(space.volumetric_degree(), points);
    if (known.n_cells() > 0)
      copy_states(known, points);
    return points;
  }

  MaterialPoints
  make_quadrature_points(const Scene          &scene,
                         const BackgroundMesh &mesh,
                         const Space          &space)
  {
    MaterialPoints points = quadrature_points_of(
      scene, mesh, space, {}, [](const BackgroundMesh::Cell &) {
        return true;
      });
    std::vector<unsigned int> n(scene.materials.size(), 0);
    for (const unsigned int material : points.material)
      ++n[material];
    Utilities::MPI::sum(n, mesh.triangulation().get_communicator(), n);
    refuse_empty_regions(scene, n);
    return points;
  }

  void
  refuse_empty_regions(const Scene &scene, const std::vector<unsigned int> &n)
  {
    // The first material has the remaining region, which can be empty, as can
    // the regions of materials that others become.
    for (unsigned int i = 0; i < n.size(); ++i)
      if (n[i] == 0 && !scene.regions.may_be_empty(i))
        throw InputError("no cell lies in the region of the material '" +
                         scene.materials.name(i) +
                         "'\n  allowed: one cell or more\n"
                         "  remedy:  take smaller cells, or check 'Region "
                         "polygon' and 'Region number'");
  }
} // namespace geocone::GEOCONE_DIM
