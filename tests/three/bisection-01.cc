// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// If this failed, bounds in three dimensions would be those of another body, or of cells as
// thin as needles. A box of two materials is bisected ten times near a point: the mesh must
// conform, keep the volumes of its materials and the areas of its sides, equalise the
// contributions to an error, and keep the shape of its cells. Divided at the table of ground
// water, or between the free faces of a cell, the body must be the same again.

#include <geocone/mesh/bisection.h>

#include "../test.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

namespace three_bisection_01
{
  using namespace geocone;
  using namespace geocone::dim3;
  using dealii::Point;

  /** A grid of cells of different widths; the sides are 0 to 5. */
  CoarseMesh
  box()
  {
    CoarseMesh mesh;
    mesh.grid = {{{0., 0.5, 1.2, 2.}, {0., 1., 1.7}, {0., 0.4, 1.}}};
    std::array<unsigned int, 3> n;
    for (unsigned int d = 0; d < 3; ++d)
      n[d] = mesh.grid[d].size();
    const auto number = [&](unsigned int i, unsigned int j, unsigned int k) {
      return i + n[0] * (j + n[1] * k);
    };
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          mesh.points.emplace_back(
            mesh.grid[0][i], mesh.grid[1][j], mesh.grid[2][k]);
    for (unsigned int k = 0; k + 1 < n[2]; ++k)
      for (unsigned int j = 0; j + 1 < n[1]; ++j)
        for (unsigned int i = 0; i + 1 < n[0]; ++i)
          {
            mesh.cells.emplace_back();
            for (unsigned int corner = 0; corner < 8; ++corner)
              mesh.cells.back().vertices[corner] =
                number(i + corner % 2, j + corner / 2 % 2, k + corner / 4);
            mesh.cells.back().material_id = i > 0;
          }
    for (const auto &face : mesh.outer_faces())
      for (unsigned int d = 0; d < 3; ++d)
        for (const double end : {mesh.grid[d].front(), mesh.grid[d].back()})
          if (std::abs(mesh.centre(face)[d] - end) < 1e-12)
            {
              // In the order of a loop, not of the vertices.
              auto loop = face;
              std::swap(loop[2], loop[3]);
              mesh.add_boundary(loop, 2 * d + (end > 0.));
            }
    return mesh;
  }

  struct Shape
  {
    std::map<int, double> volume, area; ///< of materials and sides
    double                worst     = 1.;
    bool                  is_closed = true;
  };

  Shape
  shape_of(const Tetrahedra &mesh)
  {
    Shape shape;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const double V = mesh.volume(c);
        shape.volume[mesh.material[c]] += V;
        double longest = 0.;
        for (const unsigned int i : mesh.cells[c])
          for (const unsigned int j : mesh.cells[c])
            longest =
              std::max(longest, mesh.vertices[i].distance(mesh.vertices[j]));
        // One for a regular tetrahedron.
        shape.worst =
          std::min(shape.worst, 6. * std::sqrt(2.) * V / std::pow(longest, 3));
      }
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      if (const auto &facet = mesh.facets[f];
          facet.cells[1] == Tetrahedra::none)
        {
          shape.area[facet.side] += mesh.area(f);
          shape.is_closed = shape.is_closed && facet.side >= 0;
        }
      else
        shape.is_closed = shape.is_closed && facet.side < 0;
    return shape;
  }

  /** Largest difference of the volumes and the areas of two meshes. */
  double
  difference_of(const Shape &first, const Shape &second)
  {
    double difference = 0.;
    for (const auto &[material, volume] : first.volume)
      difference =
        std::max(difference, std::abs(second.volume.at(material) - volume));
    for (const auto &[side, area] : first.area)
      difference = std::max(difference, std::abs(second.area.at(side) - area));
    return difference;
  }

  /** True for facets of the sides 1, 2 and 4, which meet at a corner. */
  bool
  is_free(const Tetrahedra &mesh, const unsigned int f)
  {
    const int side = mesh.facets[f].side;
    return side == 1 || side == 2 || side == 4;
  }

  /** Number of cells with several of those facets. */
  unsigned int
  n_at_edges(const Tetrahedra &mesh)
  {
    unsigned int n = 0;
    for (const auto &facets : mesh.facets_of_cell)
      n += std::count_if(facets.begin(), facets.end(), [&](const auto f) {
             return is_free(mesh, f);
           }) > 1;
    return n;
  }

  /** Divides the cells of two meshes of the box at the edges of its free sides. In the
   *  fine one the bisection has parted their faces: the longest edge of a cell of the box
   *  is the one between the vertices opposite to both. */
  void
  test_free_faces(const Tetrahedra &first, const Tetrahedra &fine)
  {
    for (const Tetrahedra *mesh : {&first, &fine})
      {
        const Tetrahedra divided(
          divided_between(*mesh, [&](const auto f, const auto g) {
            return is_free(*mesh, f) && is_free(*mesh, g);
          }));
        const Shape shape = shape_of(divided);
        std::cout << "some cells have several free faces: "
                  << (n_at_edges(*mesh) > 0) << ", " << n_at_edges(divided)
                  << " after; the body is kept: "
                  << (difference_of(shape_of(*mesh), shape) < 1e-12 &&
                      shape.is_closed)
                  << "\n";
      }
  }

  void
  test()
  {
    Tetrahedra     mesh(box());
    const Tetrahedra coarse = mesh;
    const Shape    first = shape_of(mesh);
    const Point<3> point(1.2, 1.7, 0.4);
    const auto     error_of = [&](const unsigned int c) {
      return std::pow(mesh.volume(c), 4. / 3.) /
             std::pow(1e-3 + mesh.centre(c).distance(point), 2);
    };
    std::cout << "cells " << mesh.cells.size() << "\n";
    for (unsigned int level = 0; level < 10; ++level)
      {
        std::vector<double> error;
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          error.push_back(error_of(c));
        const std::size_t wanted = 1.7 * mesh.cells.size();
        mesh                     = Tetrahedra(bisected(mesh, error, wanted));
        if (mesh.cells.size() < wanted ||
            mesh.cells.size() > 1.05 * wanted + 50)
          std::cout << "level " << level << " has " << mesh.cells.size()
                    << " cells instead of " << wanted << "\n";
      }
    const Shape last       = shape_of(mesh);
    double      difference = difference_of(first, last), most = 0., sum = 0.;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        most = std::max(most, error_of(c));
        sum += error_of(c);
      }
    // Divided at a plane along z that cuts the cells, no cell is on both sides of it.
    const Point<3>   a(-1., 0.1, 0.), b(3., 1.3, 0.);
    const Tetrahedra divided(divided_at(mesh, {{{a, b}}}));
    const Shape      whole    = shape_of(divided);
    double           crossing = 0.;
    difference = std::max(difference, difference_of(first, whole));
    for (const auto &cell : divided.cells)
      {
        double above = 0., below = 0.;
        for (const unsigned int v : cell)
          {
            const double y = divided.vertices[v][1] - 0.1 -
                             0.3 * (divided.vertices[v][0] + 1.);
            above = std::max(above, y);
            below = std::max(below, -y);
          }
        crossing = std::max(crossing, std::min(above, below));
      }
    std::cout << "more cells, none of which crosses the plane: "
              << (divided.cells.size() > mesh.cells.size() && crossing < 1e-8)
              << "\nsides of the divided mesh: " << whole.area.size()
              << ", complete: " << whole.is_closed << "\n";
    std::cout << "volumes and areas are kept: " << (difference < 1e-12)
              << "\nsides: " << last.area.size()
              << ", all outer facets, and no others, have one: "
              << last.is_closed << "\nlargest error below ten times the mean: "
              << (most < 10. * sum / mesh.cells.size())
              << "\nworst shape at least a quarter of the first: "
              << (last.worst > 0.25 * first.worst) << "\n";
    test_free_faces(coarse, mesh);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace three_bisection_01
