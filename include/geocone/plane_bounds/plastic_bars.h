// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_plastic_bars_h
#define geocone_plane_bounds_plastic_bars_h

#include <geocone/mesh/triangles.h>
#include <geocone/plane_bounds/interfaces.h>
#include <geocone/scene/scene.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Rigid-plastic structures on the edges of a triangulation. The soil on both sides of
   * such an edge is separated from it by interfaces: in the upper bound both sides
   * have velocities of their own, and so does the structure; in the lower bound the
   * tractions on both sides differ by the load on the structure
   * (doc/theory/bounds_structures.md).
   */
  class PlasticBars
  {
  public:
    /** Plate or geogrid along edges of the mesh. */
    struct Chain
    {
      const Structure          *structure = nullptr;
      std::vector<unsigned int> vertices; ///< in order; first again if closed
      std::vector<unsigned int> edges;    ///< between them
      bool ends_are_held = false; ///< velocities at both ends are prescribed

      bool
      is_closed() const
      {
        return vertices.front() == vertices.back();
      }
    };

    /** Anchor or strut between two vertices of chains, or a vertex and a fixed
     *  point. */
    struct Tie
    {
      const Structure       *structure = nullptr;
      std::array<int, 2>     vertices; ///< -1: the fixed point
      dealii::Tensor<1, dim> along;    ///< unit vector from the first point
    };

    /** Edge of chains, with the triangles on both sides of it. */
    struct BarEdge
    {
      unsigned int       edge  = 0;
      std::array<int, 2> cells = {{-1, -1}};

      /** Strength of the interfaces relative to the soil's; the smallest one of
       *  the chains. */
      double interface_strength = 1.;

      /** Whether the velocity of the whole edge is prescribed. */
      bool is_held = false;

      /** Number of the axial jump of the velocity at each end of the edge of the mesh,
       *  or -1. */
      std::array<int, 2> jumps = {{-1, -1}};
    };

    PlasticBars() = default;

    /** Finds the edges of all structures.
     *  @param interfaces with obstacles and oblique sides
     *  @param is_frictional whether the strength of a material depends on the normal
     *  stress, for each material
     *  @throws InputError if a structure is not along edges of the mesh or an anchor
     *  ends in the soil */
    PlasticBars(const Scene                  &scene,
                const Triangles              &triangles,
                const std::vector<Interface> &interfaces,
                const std::vector<bool>      &is_frictional);

    bool
    empty() const
    {
      return chains.empty();
    }

    /** Returns the position in `edges` of an edge of the mesh, or -1. */
    int
    number_of_edge(const unsigned int edge) const
    {
      return empty() ? -1 : edge_number[edge];
    }

    /** Returns the position in `vertices` of a vertex of the mesh, or -1. */
    int
    number_of_vertex(const unsigned int vertex) const
    {
      return empty() ? -1 : vertex_number[vertex];
    }

    /** Returns true if the tractions of a side of an edge have an interface in the
     *  lower bound, because it is weaker than the soil. */
    bool
    has_weak_interface(const unsigned int number) const
    {
      return edges[number].interface_strength < 1.;
    }

    /** @name Nodes of quadratic velocities
     *  Vertices, edges, copies of them on other sides of structures, vertices of chains
     *  and edges of chains, in this order. */
    /** @{ */
    /** Returns the node of a triangle: of a vertex, or of the edge opposite to vertex
     *  i - 3. */
    unsigned int
    node_of_cell(const Triangles   &triangles,
                 const unsigned int cell,
                 const unsigned int i) const
    {
      if (!empty())
        return cell_nodes[cell][i];
      return i < 3 ? triangles.cells[cell][i]
                   : triangles.vertices.size() +
                       triangles.edges_of_cell[cell][i - 3];
    }

    unsigned int
    node_of_vertex(const unsigned int number) const
    {
      return first_bar_node + number;
    }

    /** Node of an edge of chains, the middle coefficient of its velocity in
     *  Bernstein's basis. */
    unsigned int
    node_of_edge(const unsigned int number) const
    {
      return first_bar_node + vertices.size() + number;
    }

    /** Number of nodes beyond the vertices and edges of the mesh. */
    unsigned int
    n_more_nodes() const
    {
      return n_copies + vertices.size() + edges.size();
    }

    /** Number of dofs of the upper bound beyond those of the mesh and obstacles: of
     *  these nodes, and axial jumps of the velocity (BarEdge::jumps). */
    unsigned int
    n_more_upper_dofs() const
    {
      return dim * n_more_nodes() + n_jumps;
    }
    /** @} */

    /** Number of dofs of the lower bound beyond those of triangles, edges and
     *  obstacles: of sides with weak interfaces, vertices of chains, and rotations. */
    unsigned int
    n_more_lower_dofs() const
    {
      return first_rotation + n_rotations;
    }

    /** @name Dofs of the lower bound, from the first one beyond those of obstacles */
    /** @{ */
    /** The x dof of the soil beside an edge of chains with a weak interface.
     *  @param side position in BarEdge::cells @param end of the edge of the mesh */
    unsigned int
    dof_of_side(const unsigned int number,
                const unsigned int side,
                const unsigned int end) const
    {
      return dim * (4 * number + 2 * side + end);
    }

    /** The first of both dofs of a vertex, along frame(vertex) and normal to it. */
    unsigned int
    dof_of_vertex(const unsigned int number) const
    {
      return dim * (4 * edges.size() + number);
    }

    /** Rotation of a vertex of a plate. @param i position in Chain::vertices */
    unsigned int
    dof_of_rotation(const unsigned int chain, const unsigned int i) const
    {
      const bool is_last =
        chains[chain].is_closed() && i + 1 == chains[chain].vertices.size();
      return first_rotation + rotation_of_chain[chain] + (is_last ? 0 : i);
    }
    /** @} */

    /** Returns the side of an edge of chains on which a triangle is. */
    unsigned int
    side_of(const unsigned int number, const unsigned int cell) const
    {
      return edges[number].cells[0] == int(cell) ? 0 : 1;
    }

    /** Returns a number of the sector of triangles around a vertex, between
     *  structures, to which a triangle belongs. */
    unsigned int
    sector(const Triangles   &triangles,
           const unsigned int cell,
           const unsigned int i) const
    {
      return empty() ? triangles.cells[cell][i] : sectors[cell][i];
    }

    /** Number of values of sector(). */
    unsigned int
    n_sectors(const Triangles &triangles) const
    {
      return triangles.vertices.size() + n_more_sectors;
    }

    std::vector<Chain>        chains;
    std::vector<Tie>          ties;
    std::vector<BarEdge>      edges;    ///< of all chains
    std::vector<unsigned int> vertices; ///< of all chains

  private:
    void
    find_chain(const Structure &structure, const Triangles &triangles);
    void
    find_tie(const Structure &structure, const Triangles &triangles);
    /** Lists the vertices and edges of all chains, and the sides of the edges. */
    void
    number(const Triangles &triangles);
    /** Numbers the axial jumps of the velocity, by which a bar yields at a point: at
     *  vertices in which its force may differ from zero.
     *  @param is_bonded whether soil moves with each vertex of the chains */
    void
    number_jumps(const Triangles         &triangles,
                 const std::vector<bool> &is_bonded,
                 const std::vector<bool> &is_held);

    /** Divides the triangles around each vertex of the chains into sectors, and
     *  creates the nodes of both sides.
     *  @param is_held vertices with prescribed velocities or interfaces */
    void
    divide(const Triangles         &triangles,
           const std::vector<bool> &is_frictional,
           const std::vector<bool> &is_held);

    std::vector<int>                         edge_number, vertex_number;
    std::vector<std::array<unsigned int, 6>> cell_nodes;
    std::vector<std::array<unsigned int, 3>> sectors;
    std::vector<unsigned int>                rotation_of_chain;
    unsigned int first_bar_node = 0, n_copies = 0, n_more_sectors = 0;
    unsigned int first_rotation = 0, n_rotations = 0, n_jumps = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
