// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/lexicographic.h>
#include <geocone/terms/ghost_stiffness.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  GhostStiffness::GhostStiffness(std::vector<GhostStencil> stencils,
                                 const Unknowns           &unknowns)
    : all(std::move(stencils))
    , unknowns(unknowns)
  {}

  double
  GhostStiffness::bend(const GhostStencil &stencil,
                       const Vector       &v,
                       const unsigned int  d)
  {
    double g = 0.;
    for (unsigned int j = 0; j < 3; ++j)
      g += stencil.coefficient[j] * v.local_element(dim * stencil.node[j] + d);
    return g;
  }

  void
  GhostStiffness::residual(Vector &part, const Vector &v, const LocalLaw &)
  {
    part = 0.;
    add_forces(part, v);
    part.compress(VectorOperation::add);
  }

  void
  GhostStiffness::add_forces(Vector &part, const Vector &v) const
  {
    for (const GhostStencil &stencil : all)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double f = stencil.stiffness * h * bend(stencil, v, d);
          for (unsigned int j = 0; j < 3; ++j)
            part.local_element(dim * stencil.node[j] + d) +=
              stencil.coefficient[j] * f;
        }
  }

  std::vector<std::vector<unsigned int>>
  GhostStiffness::node_groups() const
  {
    std::vector<std::vector<unsigned int>> groups;
    for (const GhostStencil &stencil : all)
      groups.emplace_back(stencil.node.begin(), stencil.node.end());
    return groups;
  }

  void
  GhostStiffness::linearise(const JacobianPattern &pattern,
                            const double,
                            SparseMatrix &matrix) const
  {
    for (const GhostStencil &stencil : all)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              const int row = unknowns.free_row[dim * stencil.node[i] + d],
                        col = unknowns.free_row[dim * stencil.node[j] + d];
              if (row >= 0 && col >= 0)
                pattern.add_entry(row,
                                  col,
                                  stencil.stiffness * h *
                                    stencil.coefficient[i] *
                                    stencil.coefficient[j],
                                  matrix);
            }
  }

  void
  GhostStiffness::apply_tangent(Vector &dst, const Vector &dv) const
  {
    Vector part;
    part.reinit(dst);
    add_forces(part, dv);
    part.compress(VectorOperation::add);
    dst += part;
  }

  void
  GhostStiffness::add_elastic_diagonal(Vector &dst) const
  {
    Vector part;
    part.reinit(dst);
    for (const GhostStencil &stencil : all)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int d = 0; d < dim; ++d)
          part.local_element(dim * stencil.node[j] + d) +=
            stencil.stiffness * h * stencil.coefficient[j] *
            stencil.coefficient[j];
    part.compress(VectorOperation::add);
    dst += part;
  }

  double
  GhostStiffness::work(const Vector &v) const
  {
    double sum = 0.;
    for (const GhostStencil &stencil : all)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double g = bend(stencil, v, d);
          sum += h * h * stencil.stiffness * g * g;
        }
    return Utilities::MPI::sum(sum, v.get_mpi_communicator());
  }

  namespace
  {
    /** Minimum fill of the third function: at a flat surface a function is half
     *  full. */
    constexpr double half_full = 0.4;
  } // namespace

  GhostPlaces::GhostPlaces(const BackgroundMesh &mesh, const Space &space)
    : integral(space.spline_integrals())
    , n_owned(space.n_owned_nodes())
  {
    const unsigned int                   p       = space.degree();
    const GridIndex                      n_along = equal_sizes(p + 1);
    std::vector<types::global_dof_index> nodes;
    for (const auto &cell : mesh.own_cells())
      {
        space.cell_nodes(cell, nodes);
        const auto place = mesh.place_in_grid(cell);
        for (unsigned int along = 0; along < dim; ++along)
          {
            const auto n_leaving = [&](const unsigned int d) {
              return space.splines_along(d).n_leaving(place[d]);
            };
            const unsigned int n_entering =
              space.splines_along(along).n_entering(place[along]);
            // Lines of functions along a direction, by their first ones; those
            // shared with the next cell are left to it.
            for (unsigned int line = 0; line < nodes.size(); ++line)
              {
                const GridIndex first   = index_in_grid(line, n_along);
                bool            is_mine = first[along] == 0;
                for (unsigned int d = 0; d < dim; ++d)
                  is_mine = is_mine && (d == along || first[d] < n_leaving(d));
                if (!is_mine)
                  continue;
                const auto number = [&](const unsigned int i) {
                  GridIndex function = first;
                  function[along]    = i;
                  return space.local_node(
                    nodes[number_in_grid(function, n_along)]);
                };
                for (unsigned int i = 0; i <= p; ++i)
                  for (const bool up : {true, false})
                    {
                      // The outermost of the cells in the support of all three.
                      if (up ? i < 2 || i + n_entering <= p
                             : i + 2 > p || i >= n_leaving(along))
                        continue;
                      Triple triple;
                      for (unsigned int k = 0; k < 3; ++k)
                        triple.node[k] = number(up ? i - 2 + k : i + 2 - k);
                      const auto &x = space.node_positions();
                      triple.a =
                        (x[triple.node[2]] - x[triple.node[1]]).norm() /
                        (x[triple.node[1]] - x[triple.node[0]]).norm();
                      triples.push_back(triple);
                    }
              }
          }
      }
  }

  std::vector<GhostStencil>
  GhostPlaces::stencils(const Vector            &volume,
                        const Unknowns          &unknowns,
                        const std::vector<bool> &is_wanted,
                        const double             gamma) const
  {
    std::vector<GhostStencil> list;
    for (const Triple &triple : triples)
      {
        const auto [n0, n1, n2] = triple.node;
        const double light      = fill(volume, n2);
        if (!(light < least_fill) || !unknowns.has_mass(dim * n2) ||
            !(is_wanted.empty() || is_wanted[n2]))
          continue;
        // Towards the material, not along its surface.
        if (!(fill(volume, n1) > light) || !(fill(volume, n0) > half_full) ||
            !unknowns.has_mass(dim * n1))
          continue;
        const double E =
          volume.local_element(dim * n2 + 1) / volume.local_element(dim * n2);
        list.push_back({triple.node,
                        {{triple.a, -1. - triple.a, 1.}},
                        gamma * E * (1. - light / least_fill)});
      }
    return list;
  }

  unsigned int
  GhostPlaces::n_light(const Vector &volume, const Unknowns &unknowns) const
  {
    unsigned int n = 0;
    for (unsigned int node = 0; node < n_owned; ++node)
      n += unknowns.has_mass(dim * node) && fill(volume, node) < least_fill;
    return Utilities::MPI::sum(n, volume.get_mpi_communicator());
  }
} // namespace geocone::GEOCONE_DIM
