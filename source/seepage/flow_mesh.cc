// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/seepage/flow_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace geocone::GEOCONE_DIM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Templates, as triangles have no facets and tetrahedra another list of edges.

    template <typename Mesh>
    void
    take_facets(const Mesh &mesh, FlowMesh &flow)
    {
      if constexpr (dim == 2)
        {
          for (const auto &edge : mesh.edges)
            flow.facet_vertices.push_back(edge.vertices);
          flow.facets_by_cell      = mesh.edges_of_cell;
          flow.connections         = flow.facet_vertices;
          flow.connections_of_cell = mesh.edges_of_cell;
        }
      else
        {
          for (const auto &facet : mesh.facets)
            flow.facet_vertices.push_back(facet.vertices);
          flow.facets_by_cell = mesh.facets_of_cell;
          std::map<std::array<unsigned int, 2>, unsigned int> number;
          for (const auto &cell : mesh.cells)
            {
              flow.connections_of_cell.emplace_back();
              const auto pairs = FlowMesh::corners_of_connections();
              for (unsigned int i = 0; i < pairs.size(); ++i)
                {
                  const auto [low, high] =
                    std::minmax(cell[pairs[i][0]], cell[pairs[i][1]]);
                  const auto [entry, is_new] =
                    number.emplace(std::array<unsigned int, 2>{{low, high}},
                                   flow.connections.size());
                  if (is_new)
                    flow.connections.push_back({{low, high}});
                  flow.connections_of_cell.back()[i] = entry->second;
                }
            }
        }
    }

    template <typename Mesh>
    std::vector<unsigned int>
    held_facets_of(const Mesh &mesh, const BoundaryPart &condition)
    {
      if constexpr (dim == 2)
        {
          std::vector<unsigned int> all;
          for (const auto &held : mesh.held_edges(condition))
            all.push_back(held.edge);
          return all;
        }
      else
        return mesh.held_facets(condition);
    }

    template <typename Mesh>
    double
    size_of_cell(const Mesh &mesh, const unsigned int cell)
    {
      if constexpr (dim == 2)
        return mesh.area(cell);
      else
        return mesh.volume(cell);
    }

    /** Normal of a facet times its size: an edge turned by 90 degrees, or half of
     *  the cross product of two edges. */
    Tensor<1, dim>
    normal_by_size(const FlowMesh &mesh, const unsigned int facet)
    {
      const auto &v = mesh.facet_vertices[facet];
      const auto at = [&](const unsigned int i) { return mesh.vertices[v[i]]; };
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        {
          const Tensor<1, dim> along = at(1) - at(0);
          normal[0]                  = -along[1];
          normal[1]                  = along[0];
        }
      else
        normal = cross_product_3d(at(1) - at(0), at(2) - at(0)) / 2.;
      return normal;
    }
  } // namespace

  FlowMesh::FlowMesh(const CoarseMesh &mesh)
    : Simplices(mesh)
  {
    take_facets<Simplices>(*this, *this);
  }

  std::vector<unsigned int>
  FlowMesh::outer_facets(const BoundaryPart &condition) const
  {
    return held_facets_of<Simplices>(*this, condition);
  }

  double
  FlowMesh::cell_size(const unsigned int cell) const
  {
    return size_of_cell<Simplices>(*this, cell);
  }

  double
  FlowMesh::facet_size(const unsigned int facet) const
  {
    return normal_by_size(*this, facet).norm();
  }

  double
  FlowMesh::projected_size(const unsigned int facet) const
  {
    return std::abs(normal_by_size(*this, facet)[1]);
  }

  Point<dim>
  FlowMesh::facet_centre(const unsigned int facet) const
  {
    // From the first vertex, as rounding is least there.
    const auto    &v = facet_vertices[facet];
    Tensor<1, dim> arm;
    for (unsigned int i = 1; i < dim; ++i)
      arm += (vertices[v[i]] - vertices[v[0]]) / double(dim);
    return vertices[v[0]] + arm;
  }
} // namespace geocone::GEOCONE_DIM
