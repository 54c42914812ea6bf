// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/surfaces/sides_of_body.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  namespace
  {
    /** @throws InputError if a condition's box contains no part of its boundary
     *  segments */
    void
    refuse_no_part(const BoundaryCondition &condition,
                   const std::size_t        n_parts)
    {
      if (n_parts == 0)
        throw InputError(condition.parameter("Box"),
                         condition.part(),
                         "a box that holds a part of the sides of the body",
                         "check the sides and the box");
    }

    /** Segments of a plane body, lines. */
    std::vector<SidePart>
    panels_of_outline(const BoundaryCondition &condition,
                      const Geometry          &geometry)
    {
      if (geometry.outline.empty())
        throw InputError(
          condition.parameter("Sides"),
          Patterns::Tools::to_string(condition.sides),
          "sides of a body that is a box or a polygon",
          "describe the body as one of them; velocities may also be "
          "imposed on nodes of the background mesh");
      condition.check_sides(geometry.sides, "sides of the body");
      std::vector<SidePart> panels;
      for (const auto &[name, id] : geometry.sides)
        if (condition.is_on_side(name))
          {
            const auto [a, b] = geometry.side_ends(id);
            std::vector<std::pair<double, double>> in_box;
            if (const auto box = condition.box_corners())
              for (unsigned int c = 0; c < dim; ++c)
                {
                  const double tolerance = 1e-9 * a.distance(b);
                  in_box.push_back(
                    {a[c] - (*box)[0][c] + tolerance, b[c] - a[c]});
                  in_box.push_back(
                    {(*box)[1][c] - a[c] + tolerance, a[c] - b[c]});
                }
            const auto [from, to]      = part_of_line(in_box);
            const Tensor<1, dim> along = b - a;
            if (to > from)
              panels.push_back({{a + from * along, a + to * along}});
          }
      refuse_no_part(condition, panels.size());
      return panels;
    }

    /** Segments of a box in space, rectangles. */
    std::vector<SidePart>
    panels_of_box(const BoundaryCondition &condition, const Geometry &geometry)
    {
      geometry.refuse_where("conditions on sides of particles",
                            "they are on sides of a whole box");
      if (geometry.outline.empty())
        throw InputError(condition.parameter("Sides"),
                         Patterns::Tools::to_string(condition.sides),
                         "sides of a body that is a box",
                         "describe the body as one, or set "
                         "Discretisation/Method = FEM; a velocity may also be "
                         "that of an obstacle");
      condition.check_sides(geometry.sides, "sides of the body");
      const auto [lower, upper] = geometry.bounding_box();
      const auto            box = condition.box_corners();
      std::vector<SidePart> panels;
      for (unsigned int d = 0; d < dim; ++d)
        for (const bool is_upper : {false, true})
          {
            if (!condition.is_on_side(side_of_box[d][is_upper]))
              continue;
            // A rectangle normal to d, or its part in the box.
            Point<dim> low = lower, high = upper;
            low[d] = high[d] = (is_upper ? upper : lower)[d];
            bool is_there    = true;
            for (unsigned int c = 0; c < dim && box; ++c)
              {
                const double tolerance = 1e-9 * lower.distance(upper);
                if (c == d)
                  is_there = is_there && low[c] >= (*box)[0][c] - tolerance &&
                             low[c] <= (*box)[1][c] + tolerance;
                else
                  {
                    low[c]   = std::max(low[c], (*box)[0][c]);
                    high[c]  = std::min(high[c], (*box)[1][c]);
                    is_there = is_there && high[c] > low[c];
                  }
              }
            if (is_there)
              panels.push_back(side_across(d, is_upper, low, high));
          }
      refuse_no_part(condition, panels.size());
      return panels;
    }
  } // namespace

  std::vector<SidePart>
  segments_of_body(const BoundaryCondition &condition, const Geometry &geometry)
  {
    return dim == 3 ? panels_of_box(condition, geometry)
                    : panels_of_outline(condition, geometry);
  }

  SidePart
  side_across(const unsigned int axis,
              const bool         is_upper,
              const Point<dim>  &low,
              const Point<dim>  &high)
  {
    if constexpr (dim == 2)
      return (axis == 0) == is_upper ? SidePart{{low, high}}
                                     : SidePart{{high, low}};
    else
      {
        // These two and the axis are right-handed.
        std::array<unsigned int, 2> across = {
          {(axis + 1) % dim, (axis + 2) % dim}};
        if (!is_upper)
          std::swap(across[0], across[1]);
        std::array<Point<dim>, dim> ends;
        ends.fill(low);
        for (unsigned int k = 0; k < 2; ++k)
          ends[k + 1][across[k]] = high[across[k]];
        return spanned_by(ends);
      }
  }

  double
  cell_size_along(const BackgroundMesh &mesh,
                  const SidePart       &panel,
                  const unsigned int    edge)
  {
    // Inside the body, not on a boundary of cells.
    const Tensor<1, dim> along = panel.edge(edge), area = area_of(panel);
    Point<dim> a = panel.corners[0] - 1e-9 * along.norm() / area.norm() * area;
    for (unsigned int k = 0; k + 1 < dim; ++k)
      if (k != edge)
        a += panel.edge(k) / 2.;
    return longest_part_in_cell(mesh, a, a + along);
  }
} // namespace geocone::GEOCONE_DIM
