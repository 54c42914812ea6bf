// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_coarse_mesh_h
#define geocone_discretisation_coarse_mesh_h

#include <geocone/discretisation/method.h>
#include <geocone/scene/geometry.h>

#include <deal.II/base/parameter_acceptor.h>

#include <deal.II/grid/tria_description.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace geocone
{
  /** Vertices, cells with material ids, and boundary edges with side ids. */
  struct CoarseMesh
  {
    std::vector<dealii::Point<dim>>                   points;
    std::vector<dealii::CellData<dim>>                cells;
    dealii::SubCellData                               boundary;
    std::map<std::string, dealii::types::boundary_id> sides;

    /** Coordinates of the grid lines, if it is a tensor grid; or empty. */
    std::array<std::vector<double>, dim> grid;

    bool
    has_triangles() const;

    /** Mean of the vertices of a cell. */
    dealii::Point<dim>
    centre(const dealii::CellData<dim> &cell) const;

    /** The edges that belong to one cell only, as pairs of vertices. */
    std::vector<std::array<unsigned int, 2>>
    outer_edges() const;
  };

  /**
   * How the domain is cut into cells:
   *  - uniform: squares of about the cell size, or triangles cut from them;
   *  - graded: a tensor grid whose cells grow from the grading points' rows and
   *    columns, or triangles cut from it;
   *  - unstructured: by gmsh, with the size
   *      h(x) = max(smallest, min(largest, ratio x distance to the nearest
   *      grading point)),
   *    and with the grading points and the borders of the materials in it.
   * The mesh of the finite element method fits the body. The background mesh of
   * the material point method is a box around it, whose sides are bottom, right,
   * top, left.
   */
  class MeshParameters : public dealii::ParameterAcceptor
  {
  public:
    MeshParameters();

    void
    prepare(const Geometry &geometry, const Method &method);

    /** The domain to be meshed: the body, or the box around it. */
    Polygon outline;

    std::string                     type      = "uniform";
    std::string                     cells     = "automatic";
    std::string                     diagonals = "alternating";
    double                          cell_size = 0.1;
    std::vector<dealii::Point<dim>> grading_points;
    double                          smallest   = 0.001;
    double                          largest    = 0.3;
    double                          growth     = 1.3;
    double                          size_ratio = 0.18;
    int                             algorithm  = 5;

  private:
    void
    choose_outline(const Geometry &geometry, const Method &method);

    std::vector<dealii::Point<dim>> box;
  };

  /** Coordinates of the lines of a uniform or graded mesh of a box (m). */
  std::array<std::vector<double>, dim>
  grid_lines(const MeshParameters &parameters);

  /** Uniform and graded meshes of a box. */
  CoarseMesh
  structured_mesh(const MeshParameters &parameters);

  /** Unstructured mesh of a box or polygon, by gmsh. */
  CoarseMesh
  unstructured_mesh(const MeshParameters &parameters, const Regions &regions);

  /**
   * The mesh of a .msh file.
   * @throws InputError if it holds no cells of first order, inverted cells, or
   * hanging nodes
   */
  CoarseMesh
  read_msh(const std::string &file_name, const Regions &regions);
} // namespace geocone

#endif
