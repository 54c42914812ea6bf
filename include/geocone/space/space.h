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
   * Nodal vector field (velocity or force) with dim components per node. The
   * local index of a component is dim node + component; owned nodes precede
   * ghost nodes.
   */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** Returns the value of a vector field at the node with the local number @p
   *  node. */
  inline dealii::Tensor<1, dim>
  value_at(const Vector &field, const unsigned int node)
  {
    dealii::Tensor<1, dim> value;
    for (unsigned int d = 0; d < dim; ++d)
      value[d] = field.local_element(dim * node + d);
    return value;
  }

  /**
   * Finite element or spline space of the velocity, with the same scalar shape
   * functions for all components. The interface is "cell -> nodes" and "cell,
   * unit point -> N, grad N". Components are interleaved: dof = dim node +
   * component.
   *
   * Elements: P1, P2, P3 on triangles; Q1, Q2, Q3 on quadrilaterals; B-spline 2
   * and B-spline 3 (C1 and C2, with clamped knots) on tensor-product grids. On
   * grid lines with double knots the continuity is C0 and C1. The
   * basis of P2, P3, Q2 and Q3 is the Lagrange basis (at Gauss-Lobatto nodes on
   * quadrilaterals) or the Bernstein basis, which is non-negative. The "node"
   * of a non-nodal basis function is its Greville abscissa: with the nodal
   * values of a linear field as coefficients, the field is reproduced.
   *
   * The nodes of a cell are ordered as the shape functions of the reference
   * cell. The two nodes on a P3 edge are ordered along the edge, whose
   * direction can be reversed in the cell; this class sorts the nodes per cell,
   * so that shape functions need not be swapped (deal.II 9.4 provides no cubic
   * simplex).
   *
   * On tied (periodic) sides, nodes that coincide after the translation from
   * one side to the other are a single node, positioned on the first side. The
   * numbers of the merged nodes belong to no cell.
   */
  class Space : public dealii::ParameterAcceptor
  {
  public:
    Space();

    /** Sets up shape functions and nodes on a mesh. Collective.
     *  @param strongly_non_associated see automatic_element() */
    void
    prepare(const BackgroundMesh &mesh,
            const Method         &method,
            const bool            strongly_non_associated = false);

    /** Selects the element type and checks that it is available, without
     *  setting up nodes.
     *  @throws InputError */
    void
    choose_element(const bool    simplicial,
                   const bool    has_grid,
                   const Method &method,
                   const bool    strongly_non_associated = false);

    /**
     * Returns the element type for the parameter value 'automatic'.
     * @param strongly_non_associated see LawTraits: if true, triangles of the
     * finite element method are quadratic, because cubic triangles yield a
     * localised solution that is too soft (doc/small_dilatancy.md)
     */
    static std::string
    automatic_element(const bool    simplicial,
                      const bool    has_grid,
                      const Method &method,
                      const bool    strongly_non_associated);

    /** Returns warnings about constitutive laws for which the element type is
     *  unsuitable. */
    std::vector<std::string>
    warnings(const LawTraits &law, const Method &method) const;

    /** Updates shape functions and node positions after the grid lines have
     *  been moved (BackgroundMesh::move_grid()). */
    void
    follow_grid();

    /** Renumbers the nodes after the cells have been redistributed over the
     *  ranks (BackgroundMesh::repartition()). Collective. */
    void
    follow_ranks();

    using Cell = BackgroundMesh::Cell;

    /** Returns the name of the element type: P1, P2, P3, Q1, Q2, Q3, B-spline 2
     *  or B-spline 3. */
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

    /** Returns the smallest width (m) of a shear band that cells of size @p
     *  cell_size resolve. */
    double
    band_width(const double cell_size) const
    {
      return is_spline() ? cell_size : cell_size / p;
    }

    /** Returns true if all shape functions are non-negative. */
    bool
    is_non_negative() const
    {
      return p == 1 || is_spline() || basis == Basis::bernstein;
    }

    /** Returns the polynomial degree of the B-bar projection of volumetric
     *  strains in a cell. The degree is 0 for splines and k - 1 for Qk, a
     *  stable pair without locking or pressure oscillations (cf. Q2/P-1 for
     *  Stokes flow). */
    unsigned int
    volumetric_degree() const
    {
      return is_spline() ? 0 : p - 1;
    }

    /** Returns true if volumetric strains are projected in each cell (B-bar
     *  method). */
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

    /** Finds the global numbers of the nodes of a cell, in the order of the
     *  shape functions. */
    void
    cell_nodes(const Cell                                   &cell,
               std::vector<dealii::types::global_dof_index> &nodes) const;

    /**
     * Evaluates the shape functions of a cell at a point given in unit
     * coordinates. The order is that of cell_nodes().
     * @param[out] N values of the shape functions
     * @param[out] gradient gradients with respect to unit coordinates; can be
     * null
     */
    void
    evaluate(const Cell               &cell,
             const dealii::Point<dim> &unit,
             double                   *N,
             dealii::Tensor<1, dim>   *gradient) const;

    /** Returns true if any boundary sides are tied (periodic). */
    bool
    has_ties() const
    {
      return !tied_sides.empty();
    }

    /** Returns the number of nodes on all ranks. */
    dealii::types::global_dof_index
    n_nodes() const
    {
      return layout->size() / dim;
    }

    /** Returns the parallel layout of a Vector: owned and ghost degrees of
     *  freedom of this rank. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    partitioner() const
    {
      return layout;
    }

    /** Returns the local number of the node with a given global number. The
     *  node must be owned or a ghost node on this rank. */
    unsigned int
    local_node(const dealii::types::global_dof_index node) const
    {
      return layout->global_to_local(dim * node) / dim;
    }

    /** Returns the number of nodes owned by this rank. The function
     *  n_local_nodes() includes ghost nodes. */
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

    /** Returns the positions of the owned and ghost nodes of this rank (m). */
    const std::vector<dealii::Point<dim>> &
    node_positions() const
    {
      return positions;
    }

    /** Returns the univariate B-splines along a direction. */
    const SplineBasis &
    splines_along(const unsigned int direction) const
    {
      return splines[direction];
    }

    /** Returns the integral of each spline basis function over the domain (m^2;
     *  m^3 in three dimensions). The order is that of the owned and ghost
     *  nodes. */
    std::vector<double>
    spline_integrals() const;

    /**
     * Returns the local nodes whose shape functions are non-zero on the
     * boundary sides @p ids, sorted. Includes ghost nodes, so that all ranks
     * agree on shared nodes.
     */
    std::vector<unsigned int>
    nodes_on_sides(const std::set<dealii::types::boundary_id> &ids) const;

    /** Returns the local nodes whose shape functions are non-zero on selected
     *  faces, sorted. The predicate @p holds selects the faces among those of
     *  owned and ghost cells. */
    std::vector<unsigned int>
    nodes_on_faces(
      const std::function<bool(const Cell &, const unsigned int)> &holds) const;

  private:
    /** Sets up a deal.II finite element and its nodes. @return the nodes owned
     *  by this rank */
    dealii::IndexSet
    prepare_finite_element(const BackgroundMesh &mesh);

    /** Computes the positions of the nodes. */
    void
    place_nodes();

    /** Returns the position (m) of a node of a cell. */
    dealii::Point<dim>
    position_of_node(const Cell &cell, const unsigned int i) const;

    /** Finds the nodes of a cell before the nodes of tied (periodic) sides are
     *  merged. The order is that of cell_nodes(). */
    void
    untied_nodes(const Cell                                   &cell,
                 std::vector<dealii::types::global_dof_index> &nodes) const;

    /** Returns true if the shape function of node @p i of a cell is non-zero on
     *  a face. */
    bool
    is_on_face(const unsigned int i, const unsigned int face) const;

    /** Merges the matching nodes of tied (periodic) sides.
     *  @throws InputError for sides whose nodes do not match */
    void
    tie();

    /** Returns the nodes of a tied (periodic) side with their positions (m).
     *  Nodes merged so far are replaced. */
    std::vector<std::pair<dealii::types::global_dof_index, dealii::Point<dim>>>
    nodes_of_tied_side(const std::string &side) const;

    /** Sets up B-splines on the tensor-product grid. @return the nodes owned by
     *  this rank */
    dealii::IndexSet
    prepare_splines(const BackgroundMesh &mesh);

    /** Types of finite elements and splines. Triangles come first, splines
     *  last. */
    enum class Element
    {
      automatic, ///< replaced by choose_element()
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
      automatic, ///< replaced by choose_element()
      lagrange,
      bernstein
    };
    Choice<Basis> basis = {{{"automatic", Basis::automatic},
                            {"Lagrange", Basis::lagrange},
                            {"Bernstein", Basis::bernstein}}};

    bool b_bar = false;

    /** Pairs of tied (periodic) boundary sides, by name. */
    std::map<std::string, std::string> tied_sides;

    /** Global number of the node into which each node of tied (periodic) sides
     *  is merged. Empty without tied sides. */
    std::vector<dealii::types::global_dof_index> tied;

    const BackgroundMesh *mesh             = nullptr;
    unsigned int          p                = 0;
    unsigned int          n_nodes_per_cell = 0;

    std::unique_ptr<dealii::FiniteElement<dim>> fe;
    std::unique_ptr<dealii::DoFHandler<dim>>    dofs;

    /** Univariate B-splines in each direction. The array spline_number contains
     *  the global numbers of their tensor products, layer by layer. */
    std::vector<SplineBasis>                     splines;
    std::vector<dealii::types::global_dof_index> spline_number;

    /** Integer lattice coordinates of the nodes in a cell, relative to the
     *  first vertex. */
    std::vector<std::array<unsigned int, dim>> lattice;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<dealii::Point<dim>>                            positions;

    /** Coordinates of the grid lines with double knots, by direction (m). */
    std::array<std::vector<double>, dim> double_knots;

    /** Returns grid lines with those of double knots twice.
     *  @throws InputError if there is no grid line at a double knot */
    std::vector<double>
    with_double_knots(const std::vector<double> &lines,
                      const unsigned int         direction) const;
  };

  /** Creates the cubic triangular element P3, with 1 degree of freedom per
   *  vertex, 2 per edge and 1 in the interior. */
  std::unique_ptr<dealii::FiniteElement<dim>>
  make_cubic_simplex();
} // namespace geocone::GEOCONE_DIM

#endif
