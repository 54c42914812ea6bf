// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_mesh_parameters_h
#define geocone_mesh_mesh_parameters_h

#include <geocone/base/choice.h>
#include <geocone/mesh/method.h>
#include <geocone/scene/geometry.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
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
    /** @throws InputError where cells cannot be sized by strict bounds */
    void
    check_mesh_from_bounds(const Geometry &geometry,
                           const Method   &method) const;

    /** Chooses the shape of cells that is left open. @throws InputError */
    void
    choose_cells(const Geometry &geometry, const Method &method);

    /** @throws InputError for sizes and other numbers out of their range */
    void
    check_numbers() const;

    /** @throws InputError if grading points lack, or are not in the domain */
    void
    check_grading_points(const Geometry &geometry) const;

    void
    choose_outline(const Geometry &geometry, const Method &method);

    /** @throws InputError for sizes that numbers or memory cannot hold */
    void
    check_sizes() const;

    std::vector<dealii::Point<dim>> box;
  };
} // namespace geocone::GEOCONE_DIM

#endif
