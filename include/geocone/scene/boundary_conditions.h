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
  /** A part of the boundary: selected sides, optionally restricted to a box or
   *  to the region where a formula is positive. Base of all boundary
   *  conditions. */
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

    /** Whether a point on a selected side belongs to the part. */
    bool
    holds_at(const dealii::Point<dim> &x) const;

    /** Whether the formula of the parameter 'Where' is positive at a point. */
    bool
    formula_holds(const dealii::Point<dim> &x) const;

    /** Corners of the bounding box of the selected part of @p faces; no value
     *  for an empty selection.
     *  @param faces vertices of each face */
    std::optional<std::array<dealii::Point<dim>, 2>>
    reach(const std::vector<std::vector<dealii::Point<dim>>> &faces) const;

    /** Corners of the parameter 'Box', enlarged by a rounding tolerance; no
     *  value without a box. */
    std::optional<std::array<dealii::Point<dim>, 2>>
    wide_box() const;

    /** Lower left and upper right corner of the parameter 'Box'; no value
     *  without a box.
     *  @throws InputError if a formula selects the part */
    std::optional<std::array<dealii::Point<dim>, 2>>
    box_corners() const;

    /** Checks the names of the sides.
     *  @throws InputError for an unknown side
     *  @param what description of @p known, e.g. "sides of the body" */
    void
    check_sides(const std::map<std::string, dealii::types::boundary_id> &known,
                const std::string &what) const;

    /** Checks that the part contains nodes.
     *  @param n_nodes number of selected nodes over all ranks
     *  @throws InputError if no node is selected */
    void
    check_selection(const unsigned int n_nodes) const;

    /** Full name of a parameter of the condition, for messages. */
    std::string
    parameter(const std::string &entry) const;

    /** Description of the selected part of the boundary, for messages. */
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

  /** A vector-valued boundary condition with Cartesian, normal and tangential
   *  components: a prescribed velocity, a traction or the velocity of an
   *  incoming wave. */
  class BoundaryCondition : public BoundaryPart
  {
  public:
    /**
     * @param name name of this condition
     * @param list section of the list, e.g. "Boundary conditions"
     * @param quantity "Velocity", "Traction" or "Incoming velocity"
     * @param unit unit of the quantity, for the documentation
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

    /** Formula of a component as text, for messages.
     *  @param component Cartesian (< dim), normal (dim) or tangential (dim +
     *  1) */
    const std::string &
    formula(const unsigned int component) const
    {
      return texts[component];
    }

    /** Stages in which a prescribed velocity acts. */
    ActingStages stages;

    /** Imposition method of a prescribed velocity. */
    Choice<const Imposition *> imposition = imposition_choice();

    /** Number of segments of the side, for the imposition method `segments`. */
    unsigned int n_segments = 2;

    /** Reduction of the length of the side for the imposition method
     *  `segments`, in cell sizes. */
    double shortening = 0.;

    /** Entities with a prescribed velocity: nodes of the mesh, particles or a
     *  side of the body. */
    Imposition::On
    holds() const
    {
      return imposition.get()->on;
    }

    /** Whether the condition prescribes a traction. */
    bool
    is_traction() const
    {
      return quantity == "Traction";
    }

    /** Whether the condition prescribes the velocity of particles or of a side
     *  of the body instead of nodes. */
    bool
    moves() const
    {
      return holds() != Imposition::On::nodes;
    }

    /** Cartesian components as functions of position and time; no value: not
     *  prescribed. */
    std::array<std::optional<Expression>, dim> components;

    /** Components along the outward normal n of the side and, for tractions,
     *  along the tangent (-n_y, n_x), which has the body on its left. */
    std::optional<Expression> normal, tangential;

    /** Value of a Cartesian component (< dim) or of the normal component (dim)
     *  at a position and a time. @pre the component is given */
    double
    value(const unsigned int        component,
          const dealii::Point<dim> &x,
          const double              t) const
    {
      return (component < dim ? components[component] : normal)->value(x, t);
    }

    /** Vector with the prescribed normal and tangential components at time t,
     *  for the outward normal n. */
    dealii::Tensor<1, dim>
    vector_on_side(const dealii::Point<dim>     &x,
                   const dealii::Tensor<1, dim> &n,
                   const double                  t) const;

    /** Rejects a prescribed normal velocity, for methods that do not support
     *  it. @throws InputError
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
   * Boundary conditions of one kind, named in the list "SECTION/Names":
   * prescribed velocities ("Boundary conditions", m/s), tractions ("Tractions",
   * Pa) or velocities of incoming waves ("Absorbing boundaries", m/s).
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

    /** Checks the stages in which conditions act.
     *  @param all names of all stages
     *  @throws InputError for an unknown stage */
    void
    check_stages(const std::vector<std::string> &all) const;

    /** Rejects conditions that act in some stages only. @throws InputError */
    void
    refuse_stages(const std::string &what, const std::string &remedy) const;

    /** For each condition, whether it acts in a stage. */
    std::vector<bool>
    acting_in(const std::string &stage) const;
  };
} // namespace geocone::GEOCONE_DIM

#endif
