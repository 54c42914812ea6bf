// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_coarse_mesh_h
#define geocone_discretisation_coarse_mesh_h

#include <geocone/base/choice.h>
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
  /** Vertices, cells with material ids, and boundary faces with side ids. */
  struct CoarseMesh
  {
    /** The vertices of a face: of an edge in the plane, where they rise; of a triangle,
     *  after which comes no_vertex, or a quadrilateral, in the order of its cell. */
    using Face = std::array<unsigned int, dim == 2 ? 2 : 4>;
    static constexpr unsigned int no_vertex = -1;

    std::vector<dealii::Point<dim>>                   points;
    std::vector<dealii::CellData<dim>>                cells;
    dealii::SubCellData                               boundary;
    std::map<std::string, dealii::types::boundary_id> sides;

    /** Coordinates of the grid lines, if it is a tensor grid; or empty. */
    std::array<std::vector<double>, dim> grid;

    /** Whether there are triangles or tetrahedra. */
    bool
    has_simplices() const;

    /** Mean of the vertices of a cell. */
    dealii::Point<dim>
    centre(const dealii::CellData<dim> &cell) const;

    /** The faces that belong to one cell only. */
    std::vector<Face>
    outer_faces() const;

    /** Mean of the vertices of a face. */
    dealii::Point<dim>
    centre(const Face &face) const;

    /** Gives a boundary face the number of a side. */
    void
    add_boundary(const Face &face, const dealii::types::boundary_id side);
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

    /** Whether it is the body. */
    bool fits_body = true;

    /** A polygon in the box on which unstructured meshes have edges, or empty. */
    Polygon body;

    enum class Type
    {
      uniform,
      graded,
      unstructured,
      from_bounds ///< unstructured, with sizes that a limit analysis finds
    };
    Choice<Type> type = {{{"uniform", Type::uniform},
                          {"graded", Type::graded},
                          {"unstructured", Type::unstructured},
                          {"from the bounds", Type::from_bounds}}};

    /** Whether gmsh makes the mesh. */
    bool
    is_unstructured() const
    {
      return type == Type::unstructured || type == Type::from_bounds;
    }

    enum class Cells
    {
      automatic, ///< not after prepare()
      triangles,
      quadrilaterals
    };
    Choice<Cells> cells = {
      {{"automatic", Cells::automatic},
       {dim == 2 ? "triangles" : "tetrahedra", Cells::triangles},
       {dim == 2 ? "quadrilaterals" : "hexahedra", Cells::quadrilaterals}}};

    enum class Diagonals
    {
      alternating,
      parallel,
      crossed
    };
    Choice<Diagonals> diagonals = {{{"alternating", Diagonals::alternating},
                                    {"parallel", Diagonals::parallel},
                                    {"crossed", Diagonals::crossed}}};

    double                          cell_size = 0.1;
    std::vector<dealii::Point<dim>> grading_points;
    double                          smallest   = 0.001;
    double                          largest    = 0.3;
    double                          growth     = 1.3;
    double                          size_ratio = 0.18;
    int                             algorithm  = 5;
    unsigned int                    number     = 1500; ///< from the bounds

  private:
    void
    choose_outline(const Geometry &geometry, const Method &method);

    /** @throws InputError for sizes that numbers or memory cannot hold */
    void
    check_sizes() const;

    std::vector<dealii::Point<dim>> box;
  };

  /** The most cells of a mesh: their unknowns are counted in 32 bits. */
  constexpr double most_cells = 1e8;

  /**
   * The numbers of intervals of a uniform or graded mesh of a box along x and y,
   * without building it. Uniform: length / size, rounded, at least 1. Graded:
   * over a length L from a fine end, sizes s, s g, s g^2, ... of which k =
   * ceil(ln(l/s) / ln g) are smaller than the largest size l, sum up to
   *   S_n = s (g^n - 1)/(g - 1) for n <= k, and S_k + (n - k) l beyond;
   * the number is the smallest n with S_n >= L. Rounding can make it differ from
   * grid_lines() by one between two grading points.
   */
  std::array<double, dim>
  grid_size(const MeshParameters &parameters);

  /**
   * The number of cells to be expected of an unstructured mesh with the size
   * field h: triangles are nearly equilateral, so that there are
   *   4/sqrt(3) times the integral of 1/h^2 over the domain
   * of them; each pair of triangles becomes four quadrilaterals. Within a factor
   * of 2 of what gmsh makes, unless edges of materials force small cells.
   */
  double
  unstructured_size(const MeshParameters &parameters);

  /** Coordinates of the lines of a uniform or graded mesh of a box (m). */
  std::array<std::vector<double>, dim>
  grid_lines(const MeshParameters &parameters);

  /** Uniform and graded meshes of a box. */
  CoarseMesh
  structured_mesh(const MeshParameters &parameters);

  /** Straight lines on which a mesh is to have edges, where they cross it. */
  using MeshLines = std::vector<std::array<dealii::Point<dim>, 2>>;

  /** Unstructured mesh of a box or polygon, by gmsh. Collective. */
  CoarseMesh
  unstructured_mesh(const MeshParameters &parameters,
                    const Regions        &regions,
                    const MeshLines      &lines,
                    const MPI_Comm        comm);

  /**
   * The mesh of a .msh file (see msh_file.h), or of a geo script if the geometry
   * says that it may be run. Collective: the first rank reads or runs it.
   * @throws InputError if it is neither, or no mesh of ours
   */
  CoarseMesh
  mesh_of_file(const Geometry &geometry,
               const Regions  &regions,
               const MPI_Comm  comm);
} // namespace geocone

#endif
