// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_boundary_conditions_h
#define geocone_scene_boundary_conditions_h

#include <geocone/base/parameter_file.h>
#include <geocone/scene/expression.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * A condition on a part of the boundary: some of its sides, and of them, if
   * a box is given, what lies inside that box. Base of the prescribed
   * velocities and the tractions.
   */
  class BoundaryCondition : public dealii::ParameterAcceptor
  {
  public:
    /**
     * @param list section of the list, e.g. "Boundary conditions"
     * @param name name of this condition
     * @param quantity "Velocity" or "Traction"
     * @param unit for the documentation
     */
    BoundaryCondition(const std::string &list,
                      const std::string &name,
                      const std::string &quantity,
                      const std::string &unit,
                      const std::string &unset);

    void
    prepare();

    /** Whether a point of one of the sides belongs to the part. */
    bool
    in_box(const dealii::Point<dim> &x) const;

    /** The full name of one of its parameters, for messages. */
    std::string
    parameter(const std::string &entry) const;

    /** The part of the boundary as text, for messages. */
    std::string
    part() const;

    const std::string name;

    /** Names of the sides. */
    std::vector<std::string> sides;

    /** Per component: the value as a function of (x, y, t), or nothing. */
    std::array<std::optional<Expression>, dim> components;

  private:
    const std::string               quantity;
    const std::string               unset;
    std::array<std::string, dim>    texts;
    std::vector<dealii::Point<dim>> box;
  };

  /**
   * The conditions of one kind, named in the list "SECTION/Names": prescribed
   * velocities ("Boundary conditions", m/s) or tractions ("Tractions", Pa).
   */
  class BoundaryConditions : public dealii::ParameterAcceptor
  {
  public:
    BoundaryConditions(const ParameterFile &file,
                       const std::string   &section,
                       const std::string   &quantity,
                       const std::string   &unit,
                       const std::string   &unset,
                       const std::string   &documentation);

    void
    prepare();

    std::vector<std::unique_ptr<BoundaryCondition>> list;

  private:
    std::vector<std::string>                        names;
    std::vector<std::unique_ptr<BoundaryCondition>> unused;
  };
} // namespace geocone

#endif
