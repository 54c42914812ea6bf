// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_bisection_h
#define geocone_mesh_bisection_h

#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/mesh/tetrahedra.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Bisects tetrahedra at their longest edges until all cells contribute about
   * equally to a given error measure (e.g. the gap between bounds). The new
   * mesh is nested in the given one and keeps its materials and sides.
   * Contributions scale with V^(4/3) of the volume. They are averaged with
   * those of the cells at the same vertices, as a coarse cell beside refined
   * ones would otherwise be refined one mesh later. No cell is divided into
   * more than 16 parts, except where its neighbours require it.
   * @param error contribution of each cell
   * @param n_wanted number of tetrahedra; a few more close the mesh
   */
  CoarseMesh
  bisected(const Tetrahedra          &tetrahedra,
           const std::vector<double> &error,
           const std::size_t          n_wanted);

  /**
   * Divides tetrahedra at planes along z, so that none of them crosses a plane.
   * The new mesh is nested in the given one and keeps its materials and sides.
   * @param lines traces of the planes in the plane of x and y. Upright ones
   * extend over the whole height; other ones end at an upright one, outside of
   * the mesh, or where another one continues them
   */
  CoarseMesh
  divided_at(const Tetrahedra &tetrahedra, const MeshLines &lines);

  /** Condition on two facets of a mesh. */
  using FacetPair = std::function<bool(unsigned int, unsigned int)>;

  /**
   * Divides tetrahedra between boundary facets that are to belong to different cells.
   * They are halved at the edge between the vertices opposite to the two facets, together
   * with all cells around that edge. The new mesh is nested in the given one and keeps its
   * materials and sides. Cells that are bisected later keep at most one of the facets.
   * @param are_apart true for two boundary facets that no cell may have both
   */
  CoarseMesh
  divided_between(const Tetrahedra &tetrahedra, const FacetPair &are_apart);
} // namespace geocone::GEOCONE_DIM

#endif
