// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_boundary_conditions_h
#define geocone_scene_boundary_conditions_h

#include <geocone/base/named_list.h>
#include <geocone/functions/expression.h>
#include <geocone/scene/imposition.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * A condition on a part of the boundary: some of its sides, and of them, if
   * a box or a formula is given, what lies inside that box, or where the formula is
   * positive. Base of the prescribed velocities and the tractions.
   */
  class BoundaryCondition : public dealii::ParameterAcceptor
  {
  public:
    /**
     * @param name name of this condition
     * @param list section of the list, e.g. "Boundary conditions"
     * @param quantity "Velocity", "Traction" or "Incoming velocity"
     * @param unit for the documentation
     * @param folder what names of records are relative to
     */
    BoundaryCondition(const std::string &name,
                      const std::string &list,
                      const std::string &quantity,
                      const std::string &unit,
                      const std::string &unset,
                      const std::string &folder);

    void
    prepare();

    /** Whether a side of this name, or all sides, are in the list. */
    bool
    is_on_side(const std::string &side) const;

    /** Whether a formula tells the part. */
    bool
    has_formula() const
    {
      return where.has_value();
    }

    /** Whether a point of one of the sides belongs to the part. */
    bool
    holds_at(const dealii::Point<dim> &x) const;

    /** Whether the formula of 'Where' selects a place. */
    bool
    formula_holds(const dealii::Point<dim> &x) const;

    /** The corners of the box around what of some faces belongs to the part; nothing if
     *  none of it does. @param faces the vertices of each */
    std::optional<std::array<dealii::Point<dim>, 2>>
    reach(const std::vector<std::vector<dealii::Point<dim>>> &faces) const;

    /** The corners of the Box, a rounding larger; nothing where all is held. */
    std::optional<std::array<dealii::Point<dim>, 2>>
    wide_box() const;

    /** Lower left and upper right corner of the box, if there is one.
     *  @throws InputError if a formula tells the part */
    std::optional<std::array<dealii::Point<dim>, 2>>
    box_corners() const;

    /** @throws InputError for a side that is not among these
     *  @param what they are, e.g. "sides of the body" */
    void
    check_sides(const std::map<std::string, dealii::types::boundary_id> &known,
                const std::string &what) const;

    /** @throws InputError if no node is held. @param n_nodes of all ranks */
    void
    check_selection(const unsigned int n_nodes) const;

    /** The formula of a component, the normal (dim) or the tangential one, for
     *  messages. */
    const std::string &
    formula(const unsigned int component) const
    {
      return texts[component];
    }

    /** The full name of one of its parameters, for messages. */
    std::string
    parameter(const std::string &entry) const;

    /** The part of the boundary as text, for messages. */
    std::string
    part() const;

    const std::string name;

    /** Names of the sides. */
    std::vector<std::string> sides;

    /** How a prescribed velocity is imposed. */
    Choice<const Imposition *> imposition = imposition_choice();

    /** Number of parts for `segments`. */
    unsigned int n_segments = 2;

    /** The side is taken this many cell sizes shorter for `segments`. */
    double shortening = 0.;

    /** What of the body or the mesh a prescribed velocity holds. */
    Imposition::On
    holds() const
    {
      return imposition.get()->on;
    }

    /** Whether it prescribes a traction. */
    bool
    is_traction() const
    {
      return quantity == "Traction";
    }

    /** Whether it holds particles or a side of the body, and not nodes. */
    bool
    moves() const
    {
      return holds() != Imposition::On::nodes;
    }

    /** Per component: the value as a function of place and time, or nothing. */
    std::array<std::optional<Expression>, dim> components;

    /** The same along the outward normal n of the side and, for tractions, along
     *  its tangent (-n_y, n_x), which has the body to its left. */
    std::optional<Expression> normal, tangential;

    /** The value of a component, or of the normal one (dim), at a place and a time.
     *  @pre it is given */
    double
    value(const unsigned int        component,
          const dealii::Point<dim> &x,
          const double              t) const
    {
      return (component < dim ? components[component] : normal)->value(x, t);
    }

    /** The vector of the normal and the tangential one at time t, where the
     *  outward normal is n. */
    dealii::Tensor<1, dim>
    vector_on_side(const dealii::Point<dim>     &x,
                   const dealii::Tensor<1, dim> &n,
                   const double                  t) const;

    /** @throws InputError if there is a normal velocity, with what holds where
     *  none can be: @p allowed, @p remedy */
    void
    refuse_normal(const std::string &allowed, const std::string &remedy) const;

  private:
    const std::string                quantity;
    const std::string                unset;
    const std::string                folder;
    std::array<std::string, dim + 2> texts;
    std::vector<dealii::Point<dim>>  box;
    std::string                      where_text;
    std::optional<Expression>        where;
  };

  /**
   * The conditions of one kind, named in the list "SECTION/Names": prescribed
   * velocities ("Boundary conditions", m/s), tractions ("Tractions", Pa) or velocities
   * of waves that come in ("Absorbing boundaries", m/s).
   */
  class BoundaryConditions : public NamedList<BoundaryCondition>
  {
  public:
    BoundaryConditions(const ParameterFile &file,
                       const std::string   &section,
                       const std::string   &quantity,
                       const std::string   &unit,
                       const std::string   &unset,
                       const std::string   &documentation);
  };
} // namespace geocone::GEOCONE_DIM

#endif
