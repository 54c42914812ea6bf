// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_boundary_conditions_h
#define geocone_scene_boundary_conditions_h

#include <geocone/base/named_list.h>
#include <geocone/functions/expression.h>
#include <geocone/scene/acting_stages.h>
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
  /** A part of the boundary: some of its sides, restricted to a box or to the region with
   *  a positive formula, if given. Base of all conditions on the boundary. */
  class BoundaryPart : public dealii::ParameterAcceptor
  {
  public:
    /** @param name name of the condition
     *  @param list section of the list, e.g. "Boundary conditions" */
    BoundaryPart(const std::string &name, const std::string &list);

    void
    prepare();

    /** Replaces names of groups by the names of their sides.
     *  @throws InputError for a name that begins like a group and is none */
    void
    replace_groups(
      const std::map<std::string, std::vector<std::string>> &groups);

    /** Whether a side of this name, or all sides, are in the list. */
    bool
    is_on_side(const std::string &side) const;

    /** Whether a box or a formula restricts the part. */
    bool
    is_restricted() const
    {
      return !box.empty() || !where_text.empty();
    }

    /** Whether a formula selects the part. */
    bool
    has_formula() const
    {
      return where.has_value();
    }

    /** Whether a point of one of the sides belongs to the part. */
    bool
    holds_at(const dealii::Point<dim> &x) const;

    /** Whether the formula of 'Where' selects a point. */
    bool
    formula_holds(const dealii::Point<dim> &x) const;

    /** Corners of the box around the selected part of some faces; no value if
     *  it is empty.
     *  @param faces the vertices of each */
    std::optional<std::array<dealii::Point<dim>, 2>>
    reach(const std::vector<std::vector<dealii::Point<dim>>> &faces) const;

    /** Corners of the Box, enlarged by rounding; no value without a Box. */
    std::optional<std::array<dealii::Point<dim>, 2>>
    wide_box() const;

    /** Lower left and upper right corner of the box, if there is one.
     *  @throws InputError if a formula selects the part */
    std::optional<std::array<dealii::Point<dim>, 2>>
    box_corners() const;

    /** @throws InputError for a side that is not in the list
     *  @param what the list is, e.g. "sides of the body" */
    void
    check_sides(const std::map<std::string, dealii::types::boundary_id> &known,
                const std::string &what) const;

    /** @throws InputError if no node is selected. @param n_nodes of all
     *  ranks */
    void
    check_selection(const unsigned int n_nodes) const;

    /** Full name of one of its parameters, for messages. */
    std::string
    parameter(const std::string &entry) const;

    /** Selected part of the boundary as text, for messages. */
    std::string
    part() const;

    const std::string name;

    /** Names of the sides. */
    std::vector<std::string> sides;

  private:
    std::vector<std::string>        sides_given; ///< before groups are replaced
    std::vector<dealii::Point<dim>> box;
    std::string                     where_text;
    std::optional<Expression>       where;
  };

  /** A condition on a part of the boundary, with components. Base of prescribed
   *  velocities and tractions. */
  class BoundaryCondition : public BoundaryPart
  {
  public:
    /**
     * @param name name of this condition
     * @param list section of the list, e.g. "Boundary conditions"
     * @param quantity "Velocity", "Traction" or "Incoming velocity"
     * @param unit for the documentation
     * @param folder to which names of records are relative
     */
    BoundaryCondition(const std::string &name,
                      const std::string &list,
                      const std::string &quantity,
                      const std::string &unit,
                      const std::string &unset,
                      const std::string &folder);

    void
    prepare();

    /** Formula of a Cartesian, the normal (dim) or the tangential component,
     *  for messages. */
    const std::string &
    formula(const unsigned int component) const
    {
      return texts[component];
    }

    /** Stages in which a prescribed velocity acts. */
    ActingStages stages;

    /** Imposition method of a prescribed velocity. */
    Choice<const Imposition *> imposition = imposition_choice();

    /** Number of parts for `segments`. */
    unsigned int n_segments = 2;

    /** Shortening of the side for `segments`, in cell sizes. */
    double shortening = 0.;

    /** Parts of the body or the mesh whose velocity is prescribed. */
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

    /** Whether it controls particles or a side of the body instead of nodes. */
    bool
    moves() const
    {
      return holds() != Imposition::On::nodes;
    }

    /** Value of each component as a function of position and time, if given. */
    std::array<std::optional<Expression>, dim> components;

    /** The same along the outward normal n of the side and, for tractions,
     *  along its tangent (-n_y, n_x), with the body to its left. */
    std::optional<Expression> normal, tangential;

    /** Value of a component, or of the normal one (dim), at a position and a
     *  time. @pre the component is given */
    double
    value(const unsigned int        component,
          const dealii::Point<dim> &x,
          const double              t) const
    {
      return (component < dim ? components[component] : normal)->value(x, t);
    }

    /** Vector of the normal and the tangential component at time t, for the
     *  outward normal n. */
    dealii::Tensor<1, dim>
    vector_on_side(const dealii::Point<dim>     &x,
                   const dealii::Tensor<1, dim> &n,
                   const double                  t) const;

    /** @throws InputError for a normal velocity, where none is possible.
     *  @param allowed,remedy texts of the error */
    void
    refuse_normal(const std::string &allowed, const std::string &remedy) const;

  private:
    const std::string                quantity;
    const std::string                unset;
    const std::string                folder;
    std::array<std::string, dim + 2> texts;
  };

  /**
   * Conditions of one kind, named in the list "SECTION/Names": prescribed
   * velocities ("Boundary conditions", m/s), tractions ("Tractions", Pa) or
   * velocities of incoming waves ("Absorbing boundaries", m/s).
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

    /** @param all names of the stages
     *  @throws InputError if a condition acts in another one */
    void
    check_stages(const std::vector<std::string> &all) const;

    /** @throws InputError for a condition that does not act in all stages */
    void
    refuse_stages(const std::string &what, const std::string &remedy) const;

    /** Which of the conditions act in a stage. */
    std::vector<bool>
    acting_in(const std::string &stage) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
