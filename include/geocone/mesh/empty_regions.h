// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_empty_regions_h
#define geocone_mesh_empty_regions_h

#include <geocone/base/exceptions.h>
#include <geocone/base/text_of_place.h>
#include <geocone/scene/scene.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Checks that no material region is empty. @throws InputError if a material
   *  that must occupy a region has no cell
   *  @param n_cells number of cells by material, over all ranks */
  void
  refuse_empty_regions(const Scene                     &scene,
                       const std::vector<unsigned int> &n_cells);

  /** Checks that the regions of materials end at sides of the cells of a mesh, by places
   *  in the cells. Cells of named groups are not checked. @throws InputError
   *  @param mesh of triangles or tetrahedra */
  template <typename Simplices>
  void
  refuse_cut_cells(const Scene &scene, const Simplices &mesh)
  {
    constexpr double inner = 0.99; // towards vertices and middles of edges
    if (scene.materials.size() < 2 || scene.regions.have_groups())
      return;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const auto                     &cell = mesh.cells[c];
        std::vector<dealii::Point<dim>> places;
        dealii::Point<dim>              centre;
        for (const unsigned int v : cell)
          centre += mesh.vertices[v] / double(cell.size());
        for (unsigned int i = 0; i < cell.size(); ++i)
          for (unsigned int j = 0; j <= i; ++j)
            places.push_back(dealii::Point<dim>(
              centre + inner * ((mesh.vertices[cell[i]] - centre) / 2. +
                                (mesh.vertices[cell[j]] - centre) / 2.)));
        for (const dealii::Point<dim> &x : places)
          if (const unsigned int there = scene.regions.material_at(x);
              there != mesh.material[c])
            throw InputError(
              "Materials/Names",
              scene.materials.name(there),
              "regions that end at sides of the cells where loads are bounded; "
              "the cell at (" +
                text_of_place(centre) + ") is of '" +
                scene.materials.name(mesh.material[c]) + "', but contains (" +
                text_of_place(x) + ")",
              dim == 2 ? "set Mesh/Type = unstructured, whose edges are along "
                         "regions"
                       : "give the planes where regions end to 'Mesh/Grading "
                         "points', or choose cells that end there");
      }
  }
} // namespace geocone::GEOCONE_DIM

#endif
