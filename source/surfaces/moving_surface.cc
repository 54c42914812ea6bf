// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/over_ranks.h>
#include <geocone/surfaces/moving_surface.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** Vector out of the body, of a facet's own length. */
    Tensor<1, dim>
    outward(const SidePart &facet)
    {
      const Tensor<1, dim> area = area_of(facet);
      const double         size = area.norm();
      return std::pow(size, 1. / (dim - 1)) / size * area;
    }

    /** Place behind a facet, at the depth of the first particles. */
    Point<dim>
    place_behind(const SidePart &facet)
    {
      return facet.middle() - 0.1 * outward(facet);
    }
  } // namespace

  MovingSurface::MovingSurface(const std::vector<SidePart> &panels,
                               const double                 longest)
  {
    for (const SidePart &panel : panels)
      {
        std::array<unsigned int, 2> n = {
          {1, 0}}; // of parts; a line has one row
        for (unsigned int k = 0; k + 1 < dim; ++k)
          n[k] = std::max(static_cast<unsigned int>(
                            std::ceil(panel.edge(k).norm() / longest - 1e-9)),
                          1U);
        const unsigned int first = places.size(), row = n[0] + 1;
        for (unsigned int j = 0; j <= n[1]; ++j)
          for (unsigned int i = 0; i <= n[0]; ++i)
            {
              Point<dim - 1> s;
              s[0] = double(i) / n[0];
              if (dim == 3)
                s[dim - 2] = double(j) / n[1];
              places.push_back(panel.at(s));
            }
        const double area = area_of(panel).norm();
        const auto   add  = [&](const std::array<unsigned int, 3> &corners) {
          Part &part = parts.emplace_back();
          std::copy_n(corners.begin(), dim, part.corners.begin());
          part.size = dim == 2 ? area / n[0] : area / (2. * n[0] * n[1]);
        };
        for (unsigned int j = 0; j < (dim == 2 ? 1 : n[1]); ++j)
          for (unsigned int i = 0; i < n[0]; ++i)
            {
              const unsigned int p = first + j * row + i, q = p + row;
              add({{p, p + 1, q + 1}});
              if (dim == 3)
                add({{p, q + 1, q}});
            }
      }
    ends.assign(parts.size(), always);
    fading.assign(parts.size(), 0.);
  }

  std::vector<SidePart>
  MovingSurface::facets() const
  {
    std::vector<SidePart> all(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (const unsigned int corner : parts[i].corners)
        all[i].corners.push_back(places[corner]);
    return all;
  }

  std::vector<SidePart>
  MovingSurface::facets_with_soil() const
  {
    std::vector<SidePart> all = facets(), with_soil;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (has_soil(i))
        with_soil.push_back(std::move(all[i]));
    return with_soil;
  }

  void
  MovingSurface::remove(const std::function<bool(const Point<dim> &)> &goes,
                        const double                                   begin,
                        const double                                   duration)
  {
    const std::vector<SidePart> all = facets();
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (ends[i] == always && goes(place_behind(all[i])))
        {
          ends[i]   = duration > 0. ? begin + duration : never;
          fading[i] = duration;
        }
  }

  void
  MovingSurface::add(const std::function<bool(const Point<dim> &)> &comes)
  {
    const std::vector<SidePart> all = facets();
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (!has_soil(i) && comes(place_behind(all[i])))
        ends[i] = always;
  }

  double
  MovingSurface::part_left(const std::size_t facet, const double t) const
  {
    const double end = ends[facet];
    return end == always ? 1.
           : t < end     ? std::min((end - t) / fading[facet], 1.)
                         : 0.;
  }

  void
  MovingSurface::move(const BackgroundMesh &mesh,
                      const Space          &space,
                      const NodesWithMass  &has_mass,
                      const Vector         &v,
                      const double          h)
  {
    // A position inside the body near each corner, towards the midpoints of its
    // facets.
    std::vector<Tensor<1, dim>> inward(places.size());
    std::vector<bool>           moves(places.size(), false);
    const std::vector<SidePart> present = facets();
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (has_soil(i))
        for (const unsigned int corner : parts[i].corners)
          {
            moves[corner] = true;
            inward[corner] += 1e-6 * (present[i].middle() - places[corner]) -
                              1e-9 * outward(present[i]);
          }
    // Sum of velocities there, and number of cells of all ranks that
    // contribute.
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
            if (!moves[k] || !box.point_inside(x, 1e-6))
              continue;
            const auto unit = mesh.unit_point(cell, x);
            if (!unit)
              continue;
            space.cell_nodes(cell, nodes);
            space.evaluate(cell, *unit, N.data(), nullptr);
            if (has_mass && !keep_nodes_with_mass(space, has_mass, nodes, N))
              continue;
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
} // namespace geocone::GEOCONE_DIM
