// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_cell_points_h
#define geocone_bounds_cell_points_h

#include <geocone/bounds/spatial_strength.h>
#include <geocone/conic/conic_solver.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Points of the cells of a conic problem, in one group for each form of the strength
   * that occurs.
   * @tparam n_columns number of dofs of a point
   * @tparam Laws strength laws of the forms, in the order of SpatialStrength::Form
   */
  template <int n_columns, typename... Laws>
  class CellPoints
  {
  public:
    using Group =
      std::variant<std::unique_ptr<PointGroupOf<Laws, n_columns>>...>;
    using Strains =
      typename std::variant_alternative_t<0, Group>::element_type::Strains;
    using Dofs = std::array<unsigned int, n_columns>;

    /** Creates groups without points.
     *  @param law_of law of a strength of each form, for k = 1 */
    explicit CellPoints(
      const std::vector<SpatialStrength> &strengths,
      const std::function<Laws(const SpatialStrength &)> &...law_of)
      : number(strengths.size())
    {
      for (const SpatialStrength &one : strengths)
        {
          form.push_back(one.form());
          AssertThrow(form.back() < groups.size(), dealii::ExcInternalError());
        }
      unsigned int next = 0;
      (create(next++, strengths, law_of), ...);
    }

    void
    add(const unsigned int material,
        const Strains     &B,
        const Dofs        &dofs,
        const double       V,
        const double       k)
    {
      std::visit(
        [&](auto &group) { group->add(B, dofs, V, number[material], k); },
        groups[form[material]]);
    }

    /** Moves the groups that have points to a conic problem. */
    void
    move_to(ConicProblem &problem)
    {
      for (Group &one : groups)
        std::visit(
          [&](auto &group) {
            if (group->n_points() > 0)
              problem.groups.push_back(std::move(group));
          },
          one);
    }

  private:
    template <typename Law>
    void
    create(const unsigned int                                 own,
           const std::vector<SpatialStrength>                &strengths,
           const std::function<Law(const SpatialStrength &)> &law_of)
    {
      std::vector<Law> laws;
      for (unsigned int m = 0; m < strengths.size(); ++m)
        if (form[m] == own)
          {
            number[m] = laws.size();
            laws.push_back(law_of(strengths[m]));
          }
      groups[own] = std::make_unique<PointGroupOf<Law, n_columns>>(laws);
    }

    std::vector<unsigned int> form;   ///< of each material
    std::vector<unsigned int> number; ///< of the law of a material in its group
    std::array<Group, sizeof...(Laws)> groups;
  };

  /** Returns the stresses of all points of a solved problem whose cells come first, in
   *  the order of the cells.
   *  @param material of each cell @param n_points number of points of a cell
   *  @param vanishes true for stresses that vanish and have no point; empty if none
   *  @tparam Stress Mandel vector */
  template <typename Stress>
  std::vector<Stress>
  stresses_of_cells(const ConicProblem                 &problem,
                    const std::vector<SpatialStrength> &strengths,
                    const std::vector<unsigned int>    &material,
                    const unsigned int                  n_points,
                    const std::vector<bool>            &vanishes = {})
  {
    const auto has_point = [&](const unsigned int cell, const unsigned int i) {
      return vanishes.empty() || !vanishes[n_points * cell + i];
    };
    std::array<bool, SpatialStrength::n_forms> occurs = {};
    for (unsigned int c = 0; c < material.size(); ++c)
      for (unsigned int i = 0; i < n_points; ++i)
        if (has_point(c, i))
          occurs[strengths[material[c]].form()] = true;
    std::array<unsigned int, SpatialStrength::n_forms> next = {};
    std::vector<Stress>                                stress;
    for (unsigned int c = 0; c < material.size(); ++c)
      {
        // Forms without points have no group.
        const SpatialStrength::Form form = strengths[material[c]].form();
        const auto                  group =
          std::count(occurs.begin(), occurs.begin() + form, true);
        for (unsigned int i = 0; i < n_points; ++i)
          stress.push_back(
            has_point(c, i)
              ? Stress(problem.groups[group]->stress(next[form]++))
              : Stress(Stress::Zero()));
      }
    return stress;
  }
} // namespace geocone::GEOCONE_DIM

#endif
