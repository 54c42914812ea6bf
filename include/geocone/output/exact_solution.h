// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_output_exact_solution_h
#define geocone_output_exact_solution_h

#include <geocone/functions/expression.h>
#include <geocone/points/material_points.h>
#include <geocone/space/space.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Relative L2 errors of displacement and stress with respect to an exact
   *  solution. */
  struct FieldErrors
  {
    double displacement = 0.; ///< |u_h - u| / |u|
    double stress       = 0.; ///< |s_h - s| / |s|, at the material points
  };

  /**
   * Exact displacement and stress at the end of the run, as formulas in x, y and t.
   * They serve verification by manufactured or analytical solutions. For material
   * points, x and y are the positions at which displacements are zero, and errors are
   * volume-weighted sums over the points.
   */
  class ExactSolution : public dealii::ParameterAcceptor
  {
  public:
    ExactSolution();

    void
    prepare();

    bool
    is_given() const
    {
      return given;
    }

    /** Computes the relative L2 errors of displacement and stress.
     *  @param displacement nodal displacements (FEM), or empty (MPM)
     *  @param points_move whether points move with their displacement */
    FieldErrors
    errors(const BackgroundMesh &mesh,
           const Space          &space,
           const MaterialPoints &points,
           const Vector         &displacement,
           const bool            points_move,
           const double          t) const;

  private:
    std::array<std::string, dim + n_mandel> texts;
    std::array<Expression, dim + n_mandel>  fields;
    bool                                    given = false;
  };
} // namespace geocone::GEOCONE_DIM

#endif
