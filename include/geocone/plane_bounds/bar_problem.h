// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_bar_problem_h
#define geocone_plane_bounds_bar_problem_h

#include <geocone/plane_bounds/bar_rows.h>
#include <geocone/plane_bounds/interface_cells.h>

#include <vector>

/** Cells of structures in the problems of both bounds. */
namespace geocone::GEOCONE_DIM
{
  /** First dof of structures. */
  unsigned int
  first_dof_of_bars(const BoundScene &bound, const BoundSide side);

  /** Number of conditions on the degree of axial forces in the lower bound. */
  inline unsigned int
  n_cubic_dofs(const BarChain &chain)
  {
    return chain.structure->interacts() ? chain.edges.size() : 0;
  }

  /** Coulomb's cone of an interface at an end of an edge: tan(phi) and c of the soil
   *  beside it, times the strength of the interface. */
  PointCone
  interface_cone(const BoundScene  &bound,
                 const BoundSide    side,
                 const BarEdge     &edge,
                 const unsigned int cell,
                 const unsigned int vertex);

  inline constexpr Interface::Face coulomb = {0., 0., true, true};

  /** Rate of the length of an anchor or strut. @param lower dofs of vertices are along
   *  their frames */
  template <typename Dof>
  Functional
  rate_of_tie(const PlasticBars::Tie &tie, const Dof &add_velocity)
  {
    Functional rate;
    for (unsigned int end = 0; end < 2; ++end)
      if (tie.vertices[end] >= 0)
        add_velocity(
          tie.vertices[end], (end == 0 ? -1. : 1.) * tie.along, rate);
    return rate;
  }

  /** Appends cells of structures to a problem. */
  class BarCells
  {
  public:
    BarCells(BoundProblem &problem)
      : problem(problem)
      , is_used(problem.n_dofs(), false)
    {}

    /** Adds a force that works with a rate, times a volume. */
    void
    add(const Interval &interval, const Functional &rate, const double volume)
    {
      if (interval.is_zero || rate.entries.empty())
        return skip();
      // Rates of order one, as those of the soil times its volume.
      double norm = 0.;
      for (const auto &entry : rate.entries)
        norm += entry.second * entry.second;
      const double              V = volume * std::sqrt(norm);
      StrainMatrix              B = StrainMatrix::Zero(3, rate.entries.size());
      std::vector<unsigned int> dofs;
      for (const auto &[dof, factor] : rate.entries)
        {
          B(interval.component, dofs.size()) =
            interval.sign * factor * volume / V;
          problem.dead[dof] -= volume * interval.shift * factor;
          dofs.push_back(dof);
        }
      add(interval.cone, B, dofs, V);
    }

    /** Adds cells of an axial force and a moment that interact.
     *  @param owner triangle */
    void
    add(const std::vector<StrengthPart> &parts,
        const Functional                &axial,
        const Functional                &moment,
        const double                     volume,
        const unsigned int               owner)
    {
      for (const StrengthPart &part : parts)
        {
          Functional rate;
          rate.add(axial, part.axial / part.size());
          rate.add(moment, part.moment / part.size());
          add(part.interval(), rate, volume);
          if (n_points % 3 == 0)
            end_cell(owner);
        }
    }

    /** Adds a point, unless its rate is zero whatever the velocities are. */
    void
    add(const PointCone                 &cone,
        const StrainMatrix              &B,
        const std::vector<unsigned int> &dofs,
        const double                     volume)
    {
      bool            is_free = false;
      Eigen::Vector3d given   = Eigen::Vector3d::Zero();
      for (unsigned int j = 0; j < dofs.size(); ++j)
        {
          is_free = is_free || !problem.is_prescribed[dofs[j]];
          given += B.col(j) * problem.prescribed[dofs[j]];
        }
      if (!is_free && given.norm() < 1e-12)
        return skip();
      for (const unsigned int dof : dofs)
        is_used[dof] = true;
      problem.volume.push_back(volume);
      problem.cone.push_back(cone);
      problem.B.add(B, dofs);
      ++n_points;
    }

    /** Adds a point without force. */
    void
    skip()
    {
      problem.volume.push_back(1.);
      problem.cone.push_back(inactive_cone);
      problem.B.add(StrainMatrix(3, 0), {});
      ++n_points;
    }

    /** Excludes dofs in which no force works. */
    void
    exclude_unused(const unsigned int first, const unsigned int end)
    {
      for (unsigned int dof = first; dof < end; ++dof)
        if (!is_used[dof] && !problem.is_prescribed[dof])
          problem.is_prescribed[dof] = problem.has_no_force[dof] = true;
    }

    /** Ends a cell. @param owner triangle */
    void
    end_cell(const unsigned int owner)
    {
      while (n_points % 3 > 0)
        skip();
      problem.owner.push_back(owner);
      ++problem.n_bar_cells;
    }

  private:
    BoundProblem     &problem;
    std::vector<bool> is_used;
    unsigned int      n_points = 0;
  };

  /** Adds the interfaces and the cells of all structures to the upper problem. The soil's
   *  tensile strength is not applied at interfaces, which makes the dissipation larger. */
  void
  add_upper_bars(const BoundScene   &bound,
                 const BoundProblem &problem,
                 BarCells           &cells);

  /** Adds the interfaces and the cells of all structures to the lower problem. */
  void
  add_lower_bars(const BoundScene   &bound,
                 const BoundProblem &problem,
                 BarCells           &cells);
} // namespace geocone::GEOCONE_DIM

#endif
