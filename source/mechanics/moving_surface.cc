// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/mechanics/moving_surface.h>

#include <algorithm>
#include <cmath>

namespace geocone
{
  using namespace dealii;

  MovingSurface::MovingSurface(const BoundaryCondition &condition,
                               const Geometry          &geometry,
                               const double             longest)
  {
    for (const Panel &panel : panels_of_body(condition, geometry))
      {
        std::array<unsigned int, dim - 1> n;
        for (unsigned int k = 0; k + 1 < dim; ++k)
          n[k] = std::max(static_cast<unsigned int>(
                            std::ceil(panel.edges[k].norm() / longest - 1e-9)),
                          1U);
        const unsigned int n_a = n[0], n_b = n[dim - 2], first = places.size();
        const double       area = panel.area().norm() / (2. * n_a * n_b);
        for (unsigned int j = 0; j <= n_b; ++j)
          for (unsigned int i = 0; i <= n_a; ++i)
            {
              Point<dim - 1> s;
              s[0]       = double(i) / n_a;
              s[dim - 2] = double(j) / n_b;
              places.push_back(panel.at(s));
            }
        for (unsigned int j = 0; j < n_b; ++j)
          for (unsigned int i = 0; i < n_a; ++i)
            {
              const unsigned int p = first + j * (n_a + 1) + i, q = p + n_a + 1;
              triangles.push_back({{{p, p + 1, q + 1}}, area});
              triangles.push_back({{{p, q + 1, q}}, area});
            }
      }
  }

  Tensor<1, dim>
  MovingSurface::area_of(const Triangle &triangle) const
  {
    const Point<dim> &a = places[triangle.corners[0]];
    return cross_product_3d(places[triangle.corners[1]] - a,
                            places[triangle.corners[2]] - a) /
           2.;
  }

  std::vector<Point<dim>>
  MovingSurface::middles() const
  {
    std::vector<Point<dim>> all;
    for (const Triangle &triangle : triangles)
      {
        Point<dim> middle;
        for (const unsigned int corner : triangle.corners)
          middle += places[corner] / 3.;
        all.push_back(middle);
      }
    return all;
  }

  std::vector<double>
  MovingSurface::for_each_point(
    const BackgroundMesh                                               &mesh,
    const Space                                                        &space,
    const std::function<void(const Triangle &, const BoundaryPoint &)> &f) const
  {
    std::vector<SpaceTriangle> now;
    for (const Triangle &triangle : triangles)
      {
        SpaceTriangle &corners = now.emplace_back();
        for (unsigned int k = 0; k < 3; ++k)
          corners[k] = places[triangle.corners[k]];
      }
    return for_each_point_of_triangles(
      mesh, space, now, [&](const std::size_t t, const BoundaryPoint &point) {
        f(triangles[t], point);
      });
  }

  void
  MovingSurface::move(const BackgroundMesh &mesh,
                      const Space          &space,
                      const Vector         &v,
                      const double          h)
  {
    // A place in the body by each corner, towards the middles of its triangles.
    std::vector<Tensor<1, dim>>   inward(places.size());
    const std::vector<Point<dim>> middle = middles();
    for (std::size_t t = 0; t < triangles.size(); ++t)
      {
        const Tensor<1, dim> area = area_of(triangles[t]);
        for (const unsigned int corner : triangles[t].corners)
          inward[corner] += 1e-6 * (middle[t] - places[corner]) -
                            1e-9 / std::sqrt(area.norm()) * area;
      }
    // The velocity there, and how many cells of all ranks know it.
    constexpr unsigned int               n_sums = dim + 1;
    std::vector<double>                  sums(n_sums * places.size(), 0.);
    std::vector<types::global_dof_index> nodes;
    std::vector<double>                  N(space.nodes_per_cell());
    for (const auto &cell : mesh.own_cells())
      {
        const auto box = cell->bounding_box();
        for (std::size_t k = 0; k < places.size(); ++k)
          {
            const Point<dim> x = places[k] + inward[k];
            if (!box.point_inside(x, 1e-6))
              continue;
            const auto unit = mesh.unit_point(cell, x);
            if (!unit)
              continue;
            space.cell_nodes(cell, nodes);
            space.evaluate(cell, *unit, N.data(), nullptr);
            double *const own = &sums[n_sums * k];
            own[dim] += 1.;
            for (unsigned int i = 0; i < nodes.size(); ++i)
              for (unsigned int d = 0; d < dim; ++d)
                own[d] +=
                  N[i] * v.local_element(dim * space.local_node(nodes[i]) + d);
          }
      }
    sum_over_ranks(sums, v.get_mpi_communicator());
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        const double *own = &sums[n_sums * k];
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (own[dim] > 0.)
              places[k][d] += h * own[d] / own[dim];
            if (!mesh.grid()[d].empty())
              places[k][d] = std::clamp(
                places[k][d], mesh.grid()[d].front(), mesh.grid()[d].back());
          }
      }
  }
} // namespace geocone
