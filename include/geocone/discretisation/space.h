// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_space_h
#define geocone_discretisation_space_h

#include <geocone/base/types.h>
#include <geocone/discretisation/background_mesh.h>

#include <deal.II/base/partitioner.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * A velocity field: dim values per node, at 2 node + component of the local
   * numbering (owned nodes first, then ghosts). Forces are stored alike.
   */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * The space of velocities: a scalar finite element, the same for all
   * components. Its face to everything below is "cell -> nodes" and "unit points
   * -> N, grad N"; components are interleaved, so that dof = dim node +
   * component.
   *
   * Elements: P1, P2, P3 on triangles, Q1, Q2, Q3 (Gauss-Lobatto nodes) on
   * quadrilaterals. The nodes of a cell come in the order of the element's shape
   * functions on the reference cell. For P3 the two nodes of an edge are ordered
   * by the edge, which the cell may see reversed; this class sorts them per
   * cell, so that shape functions need no swapping (deal.II 9.4 has no cubic
   * simplex and leaves this to its user).
   */
  class Space : public dealii::ParameterAcceptor
  {
  public:
    Space();

    void
    prepare(const BackgroundMesh &mesh);

    using Cell = dealii::DoFHandler<dim>::active_cell_iterator;

    /** Name of the element: P1 ... Q3. */
    const std::string &
    element() const
    {
      return name;
    }

    unsigned int
    degree() const
    {
      return fe->degree;
    }

    unsigned int
    nodes_per_cell() const
    {
      return fe->n_dofs_per_cell();
    }

    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return *dofs;
    }

    const dealii::FiniteElement<dim> &
    finite_element() const
    {
      return *fe;
    }

    /** Global numbers of the nodes of a cell, in the order of N. */
    void
    cell_nodes(const Cell                                   &cell,
               std::vector<dealii::types::global_dof_index> &nodes) const;

    /** Number of nodes of all ranks. */
    dealii::types::global_dof_index
    n_nodes() const
    {
      return dofs->n_dofs();
    }

    /** Layout of a Vector: owned and ghost dofs. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    partitioner() const
    {
      return layout;
    }

    /** Local number of a node that this rank owns or has as a ghost. */
    unsigned int
    local_node(const dealii::types::global_dof_index node) const
    {
      return layout->global_to_local(dim * node) / dim;
    }

    /** Number of owned and of all locally known nodes. */
    unsigned int
    n_owned_nodes() const
    {
      return layout->locally_owned_size() / dim;
    }
    unsigned int
    n_local_nodes() const
    {
      return n_owned_nodes() + layout->n_ghost_indices() / dim;
    }

    /** Positions of the locally known nodes. */
    const std::vector<dealii::Point<dim>> &
    node_positions() const
    {
      return positions;
    }

    /**
     * The local nodes on the boundary sides @p ids, sorted. Includes ghosts, so
     * that every rank agrees on the nodes it shares.
     */
    std::vector<unsigned int>
    nodes_on_sides(const std::set<dealii::types::boundary_id> &ids) const;

  private:
    std::string                                 name = "automatic";
    std::unique_ptr<dealii::FiniteElement<dim>> fe;
    std::unique_ptr<dealii::DoFHandler<dim>>    dofs;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<dealii::Point<dim>>                            positions;
  };

  /** The cubic triangle: 1 dof per vertex, 2 per edge, 1 inside. */
  std::unique_ptr<dealii::FiniteElement<dim>>
  make_cubic_simplex();
} // namespace geocone

#endif
