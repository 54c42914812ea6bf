// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/discretisation/space.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace geocone
{
  using namespace dealii;

  Space::Space()
    : ParameterAcceptor("/Discretisation")
  {
    add_parameter("Element",
                  name,
                  "P1, P2, P3 on triangles; Q1, Q2, Q3 on quadrilaterals; "
                  "automatic: the cubic one.");
  }

  void
  Space::prepare(const BackgroundMesh &mesh)
  {
    if (name == "automatic")
      name = mesh.is_simplicial() ? "P3" : "Q3";
    const std::string cells =
      mesh.is_simplicial() ? "triangles" : "quadrilaterals";
    const std::string allowed =
      mesh.is_simplicial() ? "automatic | P1 | P2 | P3 on triangles"
                           : "automatic | Q1 | Q2 | Q3 on quadrilaterals";
    if (name.size() != 2 || name[0] != (mesh.is_simplicial() ? 'P' : 'Q') ||
        name[1] < '1' || name[1] > '3')
      throw InputError("Discretisation/Element",
                       name,
                       allowed,
                       "choose one of them, or change the cells of the mesh");
    const unsigned int p = name[1] - '0';
    if (!mesh.is_simplicial())
      fe = std::make_unique<FE_Q<dim>>(p);
    else if (p < 3)
      fe = std::make_unique<FE_SimplexP<dim>>(p);
    else
      fe = make_cubic_simplex();

    dofs = std::make_unique<DoFHandler<dim>>(mesh.triangulation());
    dofs->distribute_dofs(*fe);

    // dim dofs per node: the owned nodes are a contiguous range.
    const auto expand = [&](const IndexSet &nodes) {
      IndexSet set(dim * dofs->n_dofs());
      for (auto interval = nodes.begin_intervals();
           interval != nodes.end_intervals();
           ++interval)
        set.add_range(dim * *interval->begin(), dim * (interval->last() + 1));
      set.compress();
      return set;
    };

    // Only the nodes of own cells are needed, not those of all ghost cells.
    IndexSet                             active(dofs->n_dofs());
    std::vector<types::global_dof_index> nodes;
    for (const Cell &cell : dofs->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell_nodes(cell, nodes);
          active.add_indices(nodes.begin(), nodes.end());
        }
    active.compress();
    layout = std::make_shared<Utilities::MPI::Partitioner>(
      expand(dofs->locally_owned_dofs()),
      expand(active),
      mesh.triangulation().get_communicator());

    positions.resize(n_local_nodes());
    for (const Cell &cell : dofs->active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell_nodes(cell, nodes);
          for (unsigned int i = 0; i < nodes.size(); ++i)
            if (layout->in_local_range(dim * nodes[i]) ||
                layout->is_ghost_entry(dim * nodes[i]))
              positions[local_node(nodes[i])] =
                mesh.mapping().transform_unit_to_real_cell(
                  cell, fe->unit_support_point(i));
        }
  }

  void
  Space::cell_nodes(const Cell                           &cell,
                    std::vector<types::global_dof_index> &nodes) const
  {
    nodes.resize(fe->n_dofs_per_cell());
    if (fe->n_dofs_per_line() < 2 || cell->n_vertices() == 4)
      {
        cell->get_dof_indices(nodes);
        return;
      }
    // The cubic triangle: as the edges store them, turned where the edge runs
    // against the cell.
    unsigned int i = 0;
    for (const unsigned int v : cell->vertex_indices())
      nodes[i++] = cell->vertex_dof_index(v, 0);
    for (unsigned int l = 0; l < 3; ++l)
      {
        const auto line = cell->line(l);
        const bool same_direction =
          line->vertex_index(0) == cell->vertex_index(l);
        nodes[i++] = line->dof_index(same_direction ? 0 : 1);
        nodes[i++] = line->dof_index(same_direction ? 1 : 0);
      }
    nodes[i] = cell->dof_index(0);
  }

  std::vector<unsigned int>
  Space::nodes_on_sides(const std::set<types::boundary_id> &ids) const
  {
    // The ghost cells are looked at as well: of a node that this rank has, the
    // boundary face may belong to a cell of another rank.
    const auto on_face = [&](const Point<dim> &x, const unsigned int f) {
      const double distances_triangle[] = {x[1], 1. - x[0] - x[1], x[0]};
      const double distances_square[]   = {x[0], 1. - x[0], x[1], 1. - x[1]};
      return std::abs(fe->reference_cell() == ReferenceCells::Triangle
                        ? distances_triangle[f]
                        : distances_square[f]) < 1e-10;
    };
    std::set<unsigned int>               found;
    std::vector<types::global_dof_index> nodes;
    for (const Cell &cell : dofs->active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              ids.count(cell->face(f)->boundary_id()) > 0)
            {
              cell_nodes(cell, nodes);
              for (unsigned int i = 0; i < nodes.size(); ++i)
                if (on_face(fe->unit_support_point(i), f) &&
                    (layout->in_local_range(dim * nodes[i]) ||
                     layout->is_ghost_entry(dim * nodes[i])))
                  found.insert(local_node(nodes[i]));
            }
    return {found.begin(), found.end()};
  }
} // namespace geocone
