// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/quoted_names.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/boundary/boundary_conditions.h>
#include <geocone/functions/formula.h>
#include <geocone/geometry/side_names.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_boundary_conditions[] = {
      {"Boundary conditions/*",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Boundary conditions/*/*",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Tractions/*", "Discretisation/Method", {"FEM", "MPM", "explicit MPM"}},
      {"Tractions/*/*",
       "Discretisation/Method",
       {"FEM", "MPM", "explicit MPM"}},
      {"Boundary conditions/*/Segments",
       "Boundary conditions/*/Imposed on",
       {"segments"}},
      {"Boundary conditions/*/Segment shortening",
       "Boundary conditions/*/Imposed on",
       {"segments"}}};
  } // namespace

  BoundaryPart::BoundaryPart(const std::string &name, const std::string &list)
    : dealii::ParameterAcceptor("/" + list + "/" + name)
    , name(name)
  {
    add_parameter("Sides",
                  sides,
                  "Names of sides of the domain, comma-separated, or all. "
                  "Names that contain a comma are put in double quotes.");
    add_parameter("Box",
                  box,
                  "Restricts the condition to the part of the sides inside the "
                  "box with these two corners [m]: lowest coordinates; highest "
                  "coordinates. Empty: entire sides.");
    add_parameter(
      "Where",
      where_text,
      std::string("Formula in ") + coordinates +
        " (m) that restricts the condition to where it is > 0, e.g. 0.25 - x^2 "
        "for |x| < 0.5 m. Empty: everywhere. Nodes and faces should not lie on "
        "its zero line, where rounding decides.");
  }

  BoundaryCondition::BoundaryCondition(const std::string &name,
                                       const std::string &list,
                                       const std::string &quantity,
                                       const std::string &unit,
                                       const std::string &unset,
                                       const std::string &folder)
    : BoundaryPart(name, list)
    , quantity(quantity)
    , unset(unset)
    , folder(folder)
  {
    texts.fill(unset);
    const std::string documentation =
      unit + " as a formula in " + coordinates +
      " (m) and t (s), or 'record FILE.csv' with the columns t (s) and v, or t "
      "and a, which is integrated; '" +
      unset + "': none.";
    for (unsigned int c = 0; c < dim; ++c)
      add_parameter(quantity + " " + coordinate[c], texts[c], documentation);
    if (quantity == "Velocity" || quantity == "Traction")
      add_parameter(
        quantity + " normal",
        texts[dim],
        quantity == "Velocity"
          ? "FEM: velocity [m/s] along the outward normal of the sides, "
            "instead of along coordinates; tangential motion is free."
          : "Traction [Pa] along the outward normal of the sides, -p for a "
            "pressure p; with 'Traction tangential' instead of x and y. MPM: "
            "it follows the rotation and stretch of the side. Or pore "
            "pressure: that of the water in the soil, for sides that are "
            "closed and dry outside, whose total traction is zero.");
    if (quantity == "Traction" && dim == 2)
      add_parameter(
        quantity + " tangential",
        texts[dim + 1],
        "Traction [Pa] along the sides, positive with the body to the left.");
    if (quantity == "Velocity")
      {
        stages.declare(
          *this,
          ". In the others its components are free, and its reaction is "
          "released at once at the beginning of the stage.");
        imposition.declare(
          *this,
          "Imposed on",
          ". Where velocities are imposed. FEM: nodes. MPM: nodes on sides of "
          "the background mesh (bottom, right, top, left); all others on the "
          "first row of particles of sides of the body. Points: each particle, "
          "by the grid velocity there. Particles (FLIP): each particle, by its "
          "FLIP velocity. Cell averages. Mean of points: average over all. "
          "Segments: averages over segments of the side, which moves as "
          "prescribed.");
        add_parameter(
          "Segments",
          n_segments,
          "Number of equal segments of the side, in three dimensions along "
          "each of its edges. 2 prescribe translation and rotation and "
          "converge to the limit load of a uniform pressure.");
        add_parameter(
          "Segment shortening",
          shortening,
          "Reduction of the length of the side for 'segments', in cell sizes "
          "[-]. An empirical calibration: 0.3 makes cubic splines accurate to "
          "2 % for footings of four cells.");
      }
  }

  void
  BoundaryPart::check_sides(
    const std::map<std::string, dealii::types::boundary_id> &known,
    const std::string                                       &what) const
  {
    std::string names = "all";
    for (const auto &side : known)
      names += ", " + side.first;
    for (const std::string &name : sides)
      if (name != "all" && known.count(name) == 0)
        throw InputError(parameter("Sides"),
                         name,
                         names + " (" + what + ")",
                         "choose some of them");
  }

  void
  BoundaryPart::check_selection(const unsigned int n_nodes) const
  {
    if (n_nodes == 0)
      throw InputError(parameter("Box"),
                       part(),
                       "a part of the boundary with at least one node",
                       "this condition selects no node: check its sides "
                       "(those of the mesh, not of a smaller body), its box, "
                       "and the size of the cells there");
  }

  void
  BoundaryPart::replace_groups(
    const std::map<std::string, std::vector<std::string>> &groups)
  {
    std::vector<std::string> all;
    for (const std::string &name : sides)
      if (const auto group = groups.find(name); group != groups.end())
        all.insert(all.end(), group->second.begin(), group->second.end());
      else
        {
          if (!groups.empty() && name.rfind(prefix_of_holes, 0) == 0)
            {
              std::string known;
              for (const auto &entry : groups)
                known += (known.empty() ? "" : ", ") + entry.first;
              throw InputError(parameter("Sides"),
                               name,
                               known + ", or names of other sides",
                               "choose some of them");
            }
          all.push_back(name);
        }
    sides = all;
  }

  std::string
  BoundaryPart::parameter(const std::string &entry) const
  {
    return get_section_name().substr(1) + "/" + entry;
  }

  void
  BoundaryPart::prepare()
  {
    if (sides.empty())
      throw InputError(parameter("Sides"),
                       "",
                       "one or more sides of the domain, or all",
                       "of a box: bottom, right, top, left; of a polygon: its "
                       "'Side names', or 0, 1, ...; of a file: its physical "
                       "curves");
    sides       = unquoted(sides, parameter("Sides"));
    sides_given = sides;
    bool is_box = box.empty() || box.size() == 2;
    for (unsigned int c = 0; c < dim && box.size() == 2; ++c)
      is_box = is_box && box[0][c] <= box[1][c];
    if (!where_text.empty())
      {
        check_formula(where_text, parameter("Where"), FormulaVariables::place);
        where.emplace().prepare(where_text, parameter("Where"));
      }
    if (!is_box)
      throw InputError(parameter("Box"),
                       dealii::Patterns::Tools::to_string(box),
                       "empty, or lower left; upper right corner",
                       "e.g. -0.1, -1; 0.1, 1");
  }

  void
  BoundaryCondition::prepare()
  {
    BoundaryPart::prepare();
    if (n_segments == 0)
      throw InputError(parameter("Segments"), n_segments, ">= 1", "2 is usual");
    if (!(shortening >= 0.))
      throw InputError(
        parameter("Segment shortening"), shortening, ">= 0", "0 is usual");
    for (unsigned int c = 0; c < dim; ++c)
      if (texts[c] != unset)
        {
          components[c].emplace();
          components[c]->prepare(
            texts[c], parameter(quantity + " " + coordinate[c]), &folder);
        }
    if (is_pore_pressure())
      normal.emplace();
    else if (texts[dim] != unset)
      normal.emplace().prepare(texts[dim], parameter(quantity + " normal"));
    if (texts[dim + 1] != unset)
      tangential.emplace().prepare(texts[dim + 1],
                                   parameter(quantity + " tangential"));
    const bool has_components =
      std::any_of(components.begin(), components.end(), [](const auto &c) {
        return c.has_value();
      });
    if ((normal || tangential) && has_components)
      throw InputError(
        parameter(quantity + (normal ? " normal" : " tangential")),
        texts[normal ? dim : dim + 1],
        "'" + unset + "' beside " + quantity + " x or y",
        "give one of the two pairs of components, or two "
        "conditions");
    const bool may_be_zero = unset == "0";
    if (!may_be_zero && !has_components && !normal && !tangential)
      throw InputError(parameter(quantity + " x"),
                       unset,
                       "a formula for at least one component",
                       "give " + quantity + " x or " + quantity +
                         " y, or take the condition out of the list");
  }

  dealii::Tensor<1, dim>
  BoundaryCondition::vector_on_side(const dealii::Point<dim>     &x,
                                    const dealii::Tensor<1, dim> &n,
                                    const double                  t) const
  {
    dealii::Tensor<1, dim> result;
    if (normal)
      result += normal->value(x, t) * n;
    if (tangential) // of the plane
      {
        const double along = tangential->value(x, t);
        result[0] -= along * n[1];
        result[1] += along * n[0];
      }
    return result;
  }

  dealii::Tensor<1, dim>
  BoundaryCondition::vector_at(const dealii::Point<dim>     &x,
                               const dealii::Tensor<1, dim> &n,
                               const double                  t) const
  {
    dealii::Tensor<1, dim> result = vector_on_side(x, n, t);
    for (unsigned int d = 0; d < dim; ++d)
      if (components[d])
        result[d] += components[d]->value(x, t);
    return result;
  }

  void
  BoundaryCondition::refuse_normal(const std::string &allowed,
                                   const std::string &remedy) const
  {
    if (normal)
      throw InputError(
        parameter(quantity + " normal"), texts[dim], allowed, remedy);
  }

  std::string
  BoundaryPart::part() const
  {
    return "Sides = " + dealii::Patterns::Tools::to_string(sides_given) +
           ", Box = " +
           (box.empty() ? "" : dealii::Patterns::Tools::to_string(box)) +
           (where_text.empty() ? "" : ", Where = " + where_text);
  }

  bool
  BoundaryPart::is_on_side(const std::string &side) const
  {
    return std::any_of(sides.begin(), sides.end(), [&](const auto &listed) {
      return listed == side || listed == "all";
    });
  }

  bool
  BoundaryPart::holds_at(const dealii::Point<dim> &x) const
  {
    // The formula need be defined in the box only.
    if (const auto corners = wide_box())
      for (unsigned int c = 0; c < dim; ++c)
        if (x[c] < (*corners)[0][c] || x[c] > (*corners)[1][c])
          return false;
    return formula_holds(x);
  }

  bool
  BoundaryPart::formula_holds(const dealii::Point<dim> &x) const
  {
    return !where || where->value(x, 0.) > 0.;
  }

  std::optional<std::array<dealii::Point<dim>, 2>>
  BoundaryPart::bounding_box(
    const std::vector<std::vector<dealii::Point<dim>>> &faces) const
  {
    using dealii::Point;
    std::optional<std::array<Point<dim>, 2>> all;
    const auto                               wide = wide_box();
    const auto add = [&](Point<dim> low, Point<dim> high) {
      for (unsigned int d = 0; d < dim && wide; ++d)
        {
          if (high[d] < (*wide)[0][d] || low[d] > (*wide)[1][d])
            return;
          low[d]  = std::min(std::max(low[d], box[0][d]), box[1][d]);
          high[d] = std::min(std::max(high[d], box[0][d]), box[1][d]);
        }
      if (!all)
        all = {{low, high}};
      for (unsigned int d = 0; d < dim; ++d)
        {
          (*all)[0][d] = std::min((*all)[0][d], low[d]);
          (*all)[1][d] = std::max((*all)[1][d], high[d]);
        }
    };
    for (const auto &face : faces)
      if (!where)
        {
          Point<dim> low = face[0], high = face[0];
          for (const Point<dim> &x : face)
            for (unsigned int d = 0; d < dim; ++d)
              {
                low[d]  = std::min(low[d], x[d]);
                high[d] = std::max(high[d], x[d]);
              }
          add(low, high);
        }
      else // on the lines between vertices: the sign change, by bisection
        for (unsigned int i = 0; i < face.size(); ++i)
          for (unsigned int j = 0; j < i; ++j)
            {
              constexpr unsigned int n_parts = 16;
              const auto             at      = [&](const double s) {
                return Point<dim>(face[i] + s * (face[j] - face[i]));
              };
              for (unsigned int k = 0; k <= n_parts; ++k)
                {
                  const double s = double(k) / n_parts;
                  if (!formula_holds(at(s)))
                    continue;
                  add(at(s), at(s));
                  for (const double step : {-1. / n_parts, 1. / n_parts})
                    if (s + step >= 0. && s + step <= 1. &&
                        !formula_holds(at(s + step)))
                      {
                        double inside = s, outside = s + step;
                        for (unsigned int n = 0; n < 40; ++n)
                          {
                            const double middle = (inside + outside) / 2.;
                            (formula_holds(at(middle)) ? inside : outside) =
                              middle;
                          }
                        add(at(inside), at(inside));
                      }
                }
            }
    return all;
  }

  std::optional<std::array<dealii::Point<dim>, 2>>
  BoundaryPart::wide_box() const
  {
    if (box.empty())
      return std::nullopt;
    const double tolerance =
      1e-9 * (1. + box[0].norm() + (box[1] - box[0]).norm());
    std::array<dealii::Point<dim>, 2> corners = {{box[0], box[1]}};
    for (unsigned int c = 0; c < dim; ++c)
      {
        corners[0][c] -= tolerance;
        corners[1][c] += tolerance;
      }
    return corners;
  }

  std::optional<std::array<dealii::Point<dim>, 2>>
  BoundaryPart::box_corners() const
  {
    if (where)
      throw InputError(parameter("Where"),
                       where_text,
                       "empty, but for FEM and nodes of the background mesh",
                       "give a Box, whose corners are known");
    if (box.empty())
      return std::nullopt;
    return {{{box[0], box[1]}}};
  }

  BoundaryConditions::BoundaryConditions(const ParameterFile &file,
                                         const std::string   &section,
                                         const std::string   &quantity,
                                         const std::string   &unit,
                                         const std::string   &unset,
                                         const std::string   &documentation)
    : NamedList(file, section, documentation)
  {
    make(section, quantity, unit, unset, file.folder());
  }

  void
  BoundaryConditions::check_stages(const std::vector<std::string> &all) const
  {
    for (const auto &condition : list)
      condition->stages.check(condition->parameter(ActingStages::entry), all);
  }

  void
  BoundaryConditions::refuse_stages(const std::string &what,
                                    const std::string &remedy) const
  {
    for (const auto &condition : list)
      if (!condition->stages.are_all())
        throw InputError(condition->parameter(ActingStages::entry),
                         condition->stages.names().front(),
                         "empty with " + what,
                         remedy);
  }

  std::vector<bool>
  BoundaryConditions::acting_in(const std::string &stage) const
  {
    std::vector<bool> act;
    for (const auto &condition : list)
      act.push_back(condition->stages.include(stage));
    return act;
  }
} // namespace geocone::GEOCONE_DIM
