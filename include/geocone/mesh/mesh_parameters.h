// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_mesh_parameters_h
#define geocone_mesh_mesh_parameters_h

#include <geocone/base/choice.h>
#include <geocone/geometry/geometry.h>
#include <geocone/mesh/method.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Parameters of the mesh: mesh type, cell sizes and cell shapes. The mesh
   * types are
   *
   *  - uniform: squares of about the cell size, or triangles obtained by
   *    dividing them;
   *  - graded: a tensor grid whose cells grow from the rows and columns of the
   *    grading points, or triangles obtained by dividing them;
   *  - unstructured: by gmsh, with the grading points and the boundaries of the
   *    materials in the mesh, and with the size h(x) = max(smallest,
   *    min(largest, ratio x distance to the nearest grading point)).
   *
   * The mesh of the finite element method fits the body. The background mesh of
   * the material point method is a box around it with the sides bottom, right,
   * top, left.
   */
  class MeshParameters : public dealii::ParameterAcceptor
  {
  public:
    MeshParameters();

    void
    prepare(const Geometry &geometry, const Method &method);

    /** Outline of the domain to be meshed: the body, or a box around the
     *  body. */
    Polygon outline;

    /** True if the mesh fits the body instead of a box around the body. */
    bool fits_body = true;

    /** Holes of the domain to be meshed. */
    std::vector<Polygon> holes;

    /** Polygons inside the domain that become edges of unstructured meshes.
     *  They are the boundaries of a body of particles. */
    std::vector<Polygon> inner;

    enum class Type
    {
      uniform,
      graded,
      unstructured,
      from_bounds ///< unstructured, with sizes from a limit analysis
    };
    Choice<Type> type = {{{"uniform", Type::uniform},
                          {"graded", Type::graded},
                          {"unstructured", Type::unstructured},
                          {"from the bounds", Type::from_bounds}}};

    /** Returns true if the mesh is generated with gmsh. */
    bool
    is_unstructured() const
    {
      return type == Type::unstructured || type == Type::from_bounds;
    }

    enum class Cells
    {
      automatic, ///< replaced in prepare()
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
    unsigned int                    number     = 1500; ///< target cell count

  private:
    /** Checks that the mesh type "from the bounds" is applicable.
     *  @throws InputError if cell sizes cannot be computed from strict
     *  bounds */
    void
    check_mesh_from_bounds(const Geometry &geometry,
                           const Method   &method) const;

    /** Selects the cell shape if the parameter value is "automatic".
     *  @throws InputError */
    void
    choose_cells(const Geometry &geometry, const Method &method);

    /** Checks numeric parameters. @throws InputError if one is out of range */
    void
    check_numbers() const;

    /** Checks grading points. @throws InputError if they are missing or outside
     *  of the domain */
    void
    check_grading_points(const Geometry &geometry) const;

    void
    choose_outline(const Geometry &geometry, const Method &method);

    /** Checks that the number of cells exceeds neither the range of indices nor
     *  the available memory.
     *  @throws InputError if it exceeds the range of indices or the memory */
    void
    check_sizes() const;

    std::vector<dealii::Point<dim>> box;
  };
} // namespace geocone::GEOCONE_DIM

#endif
