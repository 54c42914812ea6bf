// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_space_space_h
#define geocone_space_space_h

#include <geocone/base/choice.h>
#include <geocone/base/types.h>
#include <geocone/materials/law_traits.h>
#include <geocone/mesh/background_mesh.h>
#include <geocone/space/spline_basis.h>

#include <deal.II/base/partitioner.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * A velocity field: dim values per node, at dim node + component of the local
   * numbering (owned nodes first, then ghosts). Forces are stored in the same
   * way.
   */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** The dim values at a local node. */
  inline dealii::Tensor<1, dim>
  value_at(const Vector &field, const unsigned int node)
  {
    dealii::Tensor<1, dim> value;
    for (unsigned int d = 0; d < dim; ++d)
      value[d] = field.local_element(dim * node + d);
    return value;
  }

  /**
   * Space of velocities: scalar shape functions, the same for all components.
   * Its interface is "cell -> nodes" and "cell, unit point -> N, grad N";
   * components are interleaved, so that dof = dim node + component.
   *
   * Elements: P1, P2, P3 on triangles; Q1, Q2, Q3 on quadrilaterals; B-spline 2
   * and B-spline 3 (of continuity 1 and 2, with clamped knots) on tensor grids.
   * The basis of P2, P3, Q2 and Q3 is Lagrange's (at Gauss-Lobatto nodes on
   * quadrilaterals) or Bernstein's, which is non-negative. A "node" of a
   * non-nodal basis is the Greville abscissa of its function: with coefficients
   * placed there, linear fields are reproduced.
   *
   * The nodes of a cell have the order of the shape functions on the reference
   * cell. The two nodes of a P3 edge are ordered along the edge, which can be
   * reversed in the cell; this class sorts them per cell, so that shape
   * functions need not be swapped (deal.II 9.4 has no cubic simplex and leaves
   * this to its user).
   *
   * Nodes of tied (periodic) sides that differ by the translation between them
   * are one node, at the place of the first side; the numbers of the others
   * belong to no cell.
   */
  class Space : public dealii::ParameterAcceptor
  {
  public:
    Space();

    /** @param hard_flow see automatic_element() */
    void
    prepare(const BackgroundMesh &mesh,
            const Method         &method,
            const bool            hard_flow = false);

    /** Chooses and checks the element only. @throws InputError */
    void
    choose_element(const bool    simplicial,
                   const bool    has_grid,
                   const Method &method,
                   const bool    hard_flow = false);

    /**
     * The element for 'automatic'.
     * @param hard_flow LawTraits::has_hard_flow: triangles of the finite
     * element method are then quadratic. Of the localised solutions of the
     * exact law, cubic ones yield one that is too soft (doc/small_dilatancy.md)
     */
    static std::string
    automatic_element(const bool    simplicial,
                      const bool    has_grid,
                      const Method &method,
                      const bool    hard_flow);

    /** Warnings about laws that the element represents poorly. */
    std::vector<std::string>
    warnings(const LawTraits &law, const Method &method) const;

    /** Moves functions and nodes after BackgroundMesh::move_grid(). */
    void
    follow_grid();

    /** Renumbers the nodes after BackgroundMesh::repartition(). Collective. */
    void
    follow_ranks();

    using Cell = BackgroundMesh::Cell;

    /** Name of the element: P1 ... Q3, B-spline 2, B-spline 3. */
    std::string
    element() const
    {
      return kind.word();
    }

    unsigned int
    degree() const
    {
      return p;
    }

    bool
    is_spline() const
    {
      return kind >= Element::spline_2;
    }

    /** Smallest width of a strain band in a cell of this size (m). */
    double
    band_width(const double cell_size) const
    {
      return is_spline() ? cell_size : cell_size / p;
    }

    /** Whether all shape functions are non-negative. */
    bool
    is_non_negative() const
    {
      return p == 1 || is_spline() || basis == Basis::bernstein;
    }

    /** Polynomial degree of the B-bar projection of volumetric strains in a
     *  cell: 0 for splines and k - 1 for Qk, a pair that neither locks nor
     *  oscillates (Q2/P-1 of Stokes flow). */
    unsigned int
    volumetric_degree() const
    {
      return is_spline() ? 0 : p - 1;
    }

    /** Whether volumetric strains are projected in each cell (B-bar). */
    bool
    has_b_bar() const
    {
      return b_bar;
    }

    unsigned int
    nodes_per_cell() const
    {
      return n_nodes_per_cell;
    }

    /** Global numbers of the nodes of a cell, in the order of the shape
     *  functions. */
    void
    cell_nodes(const Cell                                   &cell,
               std::vector<dealii::types::global_dof_index> &nodes) const;

    /**
     * Evaluates the shape functions of a cell at a unit point, in the order of
     * cell_nodes().
     * @param[out] N values
     * @param[out] gradient with respect to unit coordinates; can be null
     */
    void
    evaluate(const Cell               &cell,
             const dealii::Point<dim> &unit,
             double                   *N,
             dealii::Tensor<1, dim>   *gradient) const;

    /** Whether sides are tied. */
    bool
    has_ties() const
    {
      return !tied_sides.empty();
    }

    /** Number of nodes on all ranks. */
    dealii::types::global_dof_index
    n_nodes() const
    {
      return layout->size() / dim;
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

    /** Integrals of the functions of the locally known nodes (m^2), for
     *  splines. */
    std::vector<double>
    spline_integrals() const;

    /**
     * Local nodes whose functions are not zero on the boundary sides @p ids,
     * sorted. Includes ghosts, so that all ranks agree on shared nodes.
     */
    std::vector<unsigned int>
    nodes_on_sides(const std::set<dealii::types::boundary_id> &ids) const;

    /** The same for faces of owned and ghost cells selected by @p holds. */
    std::vector<unsigned int>
    nodes_on_faces(
      const std::function<bool(const Cell &, const unsigned int)> &holds) const;

  private:
    /** Sets up a finite element of deal.II. @return the nodes owned by this
     *  rank */
    dealii::IndexSet
    prepare_finite_element(const BackgroundMesh &mesh);

    /** Computes the positions of the nodes. */
    void
    place_nodes();

    /** Position of a node of a cell. */
    dealii::Point<dim>
    index_of_node(const Cell &cell, const unsigned int i) const;

    /** cell_nodes() without ties. */
    void
    untied_nodes(const Cell                                   &cell,
                 std::vector<dealii::types::global_dof_index> &nodes) const;

    /** Whether the function of a node of a cell is not zero on a face. */
    bool
    is_on_face(const unsigned int i, const unsigned int face) const;

    /** Finds the nodes that are one.
     *  @throws InputError for sides whose nodes do not match */
    void
    tie();

    /** Nodes of a side with their positions, as tied so far. */
    std::vector<std::pair<dealii::types::global_dof_index, dealii::Point<dim>>>
    nodes_of_tied_side(const std::string &side) const;

    /** Sets up splines on the tensor grid. @return the nodes owned by this
     *  rank */
    dealii::IndexSet
    prepare_splines(const BackgroundMesh &mesh);

    /** Triangular elements first, splines last. */
    enum class Element
    {
      automatic, ///< not after choose_element()
      p1,
      p2,
      p3,
      q1,
      q2,
      q3,
      spline_2,
      spline_3
    };
    Choice<Element> kind = {{{"automatic", Element::automatic},
                             {"P1", Element::p1},
                             {"P2", Element::p2},
                             {"P3", Element::p3},
                             {"Q1", Element::q1},
                             {"Q2", Element::q2},
                             {"Q3", Element::q3},
                             {"B-spline 2", Element::spline_2},
                             {"B-spline 3", Element::spline_3}}};

    enum class Basis
    {
      automatic, ///< not after choose_element()
      lagrange,
      bernstein
    };
    Choice<Basis> basis = {{{"automatic", Basis::automatic},
                            {"Lagrange", Basis::lagrange},
                            {"Bernstein", Basis::bernstein}}};

    bool b_bar = false;

    /** Pairs of sides by their names. */
    std::map<std::string, std::string> tied_sides;

    /** Node that each node is; empty without tied sides. */
    std::vector<dealii::types::global_dof_index> tied;

    const BackgroundMesh *mesh             = nullptr;
    unsigned int          p                = 0;
    unsigned int          n_nodes_per_cell = 0;

    std::unique_ptr<dealii::FiniteElement<dim>> fe;
    std::unique_ptr<dealii::DoFHandler<dim>>    dofs;

    /** Splines in each direction, and the numbers of their products, layer by
     *  layer. */
    std::vector<SplineBasis>                     splines;
    std::vector<dealii::types::global_dof_index> spline_number;

    /** Row and column index of the nodes of a cell, from its first vertex. */
    std::vector<std::array<unsigned int, dim>> lattice;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<dealii::Point<dim>>                            positions;
  };

  /** The cubic triangle: 1 dof per vertex, 2 per edge, 1 inside. */
  std::unique_ptr<dealii::FiniteElement<dim>>
  make_cubic_simplex();
} // namespace geocone::GEOCONE_DIM

#endif
