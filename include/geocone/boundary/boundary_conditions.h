// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_boundary_boundary_conditions_h
#define geocone_boundary_boundary_conditions_h

#include <geocone/base/named_list.h>
#include <geocone/boundary/acting_stages.h>
#include <geocone/boundary/imposition.h>
#include <geocone/functions/expression.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Part of the boundary to which a boundary condition applies. The part
   *  consists of selected sides, optionally restricted to a box or to the
   *  region where a formula is positive. Base class of all boundary
   *  conditions. */
  class BoundaryPart : public dealii::ParameterAcceptor
  {
  public:
    /** Declares the parameters of a part of the boundary.
     *  @param name name of the condition
     *  @param list section of the list, e.g. "Boundary conditions" */
    BoundaryPart(const std::string &name, const std::string &list);

    void
    prepare();

    /** Replaces the name of each hole with the names of the sides of the hole.
     *  @throws InputError for a hole that does not exist
     *  @param groups names of the sides of each hole */
    void
    replace_groups(
      const std::map<std::string, std::vector<std::string>> &groups);

    /** Returns true if the condition applies to the side with the given name,
     *  or to all sides. */
    bool
    is_on_side(const std::string &side) const;

    /** Returns true if the selected sides are restricted to a box or by a
     *  formula. */
    bool
    is_restricted() const
    {
      return !box.empty() || !where_text.empty();
    }

    /** Returns true if the selected sides are restricted by a formula. */
    bool
    has_formula() const
    {
      return where.has_value();
    }

    /** Returns true if a point on a selected side satisfies the box and the
     *  formula that restrict the boundary part. */
    bool
    holds_at(const dealii::Point<dim> &x) const;

    /** Returns true if the formula of the parameter 'Where' is positive at a
     *  point. */
    bool
    formula_holds(const dealii::Point<dim> &x) const;

    /** Returns the lower and the upper corner of the bounding box of the
     *  selected part of the boundary. No value is returned for an empty
     *  selection.
     *  @param faces vertices of each boundary face */
    std::optional<std::array<dealii::Point<dim>, 2>>
    bounding_box(
      const std::vector<std::vector<dealii::Point<dim>>> &faces) const;

    /** Returns the lower and the upper corner of the parameter 'Box', enlarged
     *  by a rounding tolerance. No value is returned without a box. */
    std::optional<std::array<dealii::Point<dim>, 2>>
    wide_box() const;

    /** Returns the lower and the upper corner of the parameter 'Box'. No value
     *  is returned without a box.
     *  @throws InputError if a formula selects the part */
    std::optional<std::array<dealii::Point<dim>, 2>>
    box_corners() const;

    /** Checks that all selected sides exist.
     *  @throws InputError for an unknown side
     *  @param what description of @p known, e.g. "sides of the body" */
    void
    check_sides(const std::map<std::string, dealii::types::boundary_id> &known,
                const std::string &what) const;

    /** Checks that the selected part of the boundary contains nodes.
     *  @param n_nodes number of selected nodes over all ranks
     *  @throws InputError if no node is selected */
    void
    check_selection(const unsigned int n_nodes) const;

    /** Returns the full name of a parameter of the condition, for error
     *  messages. */
    std::string
    parameter(const std::string &entry) const;

    /** Returns a description of the selected part of the boundary, for error
     *  messages. */
    std::string
    part() const;

    const std::string name;

    /** Names of the selected sides. */
    std::vector<std::string> sides;

  private:
    std::vector<std::string>        sides_given; ///< before holes are replaced
    std::vector<dealii::Point<dim>> box;
    std::string                     where_text;
    std::optional<Expression>       where;
  };

  /** Boundary condition that prescribes a vector by Cartesian, normal or
   *  tangential components. The vector is a prescribed velocity, a traction or
   *  the velocity of an incoming wave. */
  class BoundaryCondition : public BoundaryPart
  {
  public:
    /**
     * Declares the parameters of the boundary condition.
     * @param name name of this condition
     * @param list section of the list, e.g. "Boundary conditions"
     * @param quantity "Velocity", "Traction" or "Incoming velocity"
     * @param unit unit of the quantity, for the documentation
     * @param unset value of the parameter for a component that is not
     * prescribed
     * @param folder to which file names of time histories are relative
     */
    BoundaryCondition(const std::string &name,
                      const std::string &list,
                      const std::string &quantity,
                      const std::string &unit,
                      const std::string &unset,
                      const std::string &folder);

    void
    prepare();

    /** Returns the formula of a component as text, for error messages.
     *  @param component Cartesian (< dim), normal (dim) or tangential (dim +
     *  1) */
    const std::string &
    formula(const unsigned int component) const
    {
      return texts[component];
    }

    /** Names of the stages in which a prescribed velocity is active. */
    ActingStages stages;

    /** Method by which a prescribed velocity is imposed. */
    Choice<const Imposition *> imposition = imposition_choice();

    /** Number of segments into which a side is divided, for the imposition
     *  method `segments`. */
    unsigned int n_segments = 2;

    /** Length by which a side is shortened, in cell sizes, for the imposition
     *  method `segments`. */
    double shortening = 0.;

    /** Returns the type of entity with a prescribed velocity: nodes of the
     *  mesh, particles or a side of the body. */
    Imposition::On
    imposed_on() const
    {
      return imposition.get()->on;
    }

    /** Returns true if the condition prescribes a traction. */
    bool
    is_traction() const
    {
      return quantity == "Traction";
    }

    /** Returns true if the condition prescribes the traction of the pore
     *  pressure along the normal, whose field is that of the scene's water. */
    bool
    is_pore_pressure() const
    {
      return is_traction() && texts[dim] == "pore pressure";
    }

    /** Returns true if the velocity is prescribed for particles or for a side
     *  of the body instead of nodes. */
    bool
    moves_with_body() const
    {
      return imposed_on() != Imposition::On::nodes;
    }

    /** Formulas of the Cartesian components of the prescribed vector, in terms
     *  of position and time. Components without a value are not prescribed. */
    std::array<std::optional<Expression>, dim> components;

    /** Formulas of the normal and tangential components of the prescribed
     *  vector. The normal n points outward from the body; the tangent (-n_y,
     *  n_x), for tractions only, has the body on its left. */
    std::optional<Expression> normal, tangential;

    /** Evaluates a component of the prescribed vector.
     *  @param component 0 ... dim - 1: Cartesian; dim: normal
     *  @pre the component is prescribed */
    double
    value(const unsigned int        component,
          const dealii::Point<dim> &x,
          const double              t) const
    {
      return (component < dim ? components[component] : normal)->value(x, t);
    }

    /** Returns the part of the prescribed vector that is given by normal and
     *  tangential components. @param n outward unit normal */
    dealii::Tensor<1, dim>
    vector_on_side(const dealii::Point<dim>     &x,
                   const dealii::Tensor<1, dim> &n,
                   const double                  t) const;

    /** Returns the prescribed vector, by Cartesian, normal and tangential
     *  components. @param n outward unit normal */
    dealii::Tensor<1, dim>
    vector_at(const dealii::Point<dim>     &x,
              const dealii::Tensor<1, dim> &n,
              const double                  t) const;

    /** Rejects a boundary condition that prescribes a normal velocity
     *  component. Called by methods that do not support it. @throws InputError
     *  @param allowed,remedy texts of the error message */
    void
    refuse_normal(const std::string &allowed, const std::string &remedy) const;

  private:
    const std::string                quantity;
    const std::string                unset;
    const std::string                folder;
    std::array<std::string, dim + 2> texts;
  };

  /**
   * List of all boundary conditions of one kind, from the parameter
   * "SECTION/Names". Kinds are prescribed velocities ("Boundary conditions",
   * m/s), tractions ("Tractions", Pa) and velocities of incoming waves
   * ("Absorbing boundaries", m/s).
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

    /** Checks that the stages selected for each condition exist.
     *  @param all names of all stages
     *  @throws InputError for an unknown stage */
    void
    check_stages(const std::vector<std::string> &all) const;

    /** Rejects boundary conditions that are active only in some stages. @throws
     *  InputError */
    void
    refuse_stages(const std::string &what, const std::string &remedy) const;

    /** Returns one flag per boundary condition: true if the condition is active
     *  in the given stage. */
    std::vector<bool>
    acting_in(const std::string &stage) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
