// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_bar_rows_h
#define geocone_plane_bounds_bar_rows_h

#include <geocone/plane_bounds/bar_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  using BarChain = PlasticBars::Chain;
  using BarEdge  = PlasticBars::BarEdge;

  /** Integrals over an edge of Bernstein's functions of degree two times those of
   *  degree one, over its length. */
  inline constexpr double share_of_end[3][2] = {
    {1. / 4., 1. / 12.}, {1. / 6., 1. / 6.}, {1. / 12., 1. / 4.}};

  /** Interval of admissible forces of a point as a cone of one component. */
  struct Interval
  {
    PointCone cone;
    int       component = 0;  ///< of the stress of the point
    double    sign      = 1.; ///< force = sign times component + shift
    double    shift     = 0.;
    bool      is_zero   = false; ///< no force other than zero

    Interval(const double least, const double most)
    {
      const bool below = std::isfinite(least), above = std::isfinite(most);
      if (below && above)
        {
          cone      = {0., (most - least) / 2.};
          component = 1;
          shift     = (most + least) / 2.;
          is_zero   = !(most > least);
        }
      else if (below || above)
        {
          cone = {1., below ? -least : most};
          sign = below ? 1. : -1.;
        }
      else
        cone = {0., 1.};
    }

    /** Whether one strength is finite and the other one is not. */
    bool
    is_one_sided() const
    {
      return cone.a != 0.;
    }

    double
    force(const Eigen::Vector3d &s) const
    {
      return sign * s[component] + shift;
    }
  };

  /** Axial forces within the strength. @param ends_are_held whether velocities at both
   *  ends are prescribed: forces of a bar of which one strength is unlimited may then
   *  grow beyond all bounds in equilibrium with themselves */
  Interval
  axial_interval(const Structure  &structure,
                 const BoundUnits &units,
                 const BoundSide   side,
                 const bool        ends_are_held = false);

  /** Moments within the strength. */
  Interval
  moment_interval(const Structure  &structure,
                  const BoundUnits &units,
                  const BoundSide   side);

  /** Part of the strength of a plate whose axial force and moment interact: the forces
   *  N = axial s and M = moment s with |s| <= 1, in scaled units. */
  struct StrengthPart
  {
    double axial, moment;

    /** Interval of the larger one of both. */
    Interval
    interval() const
    {
      return {-size(), size()};
    }

    double
    size() const
    {
      return std::max(std::abs(axial), std::abs(moment));
    }
  };

  /** Number of parts of a strength, a multiple of the points of a cell. Even and odd, so
   *  that a moment without axial force has its strength Mp in both bounds. */
  constexpr unsigned int
  n_strength_parts(const BoundSide side)
  {
    return side == BoundSide::lower ? 18 : 21;
  }

  /** Parts of the strength |M|/Mp + (N/Np)^2 <= 1. The sums of one force of each part are a
   *  polygon with twice as many corners, symmetric to the origin: inscribed in the lower
   *  bound and circumscribed in the upper one, within 0.4 % of Mp. Empty if the forces of
   *  a structure do not interact or, in the upper bound, one strength counts as
   *  unlimited. */
  std::vector<StrengthPart>
  strength_parts(const Structure  &structure,
                 const BoundUnits &units,
                 const BoundSide   side);

  /** Rate as a linear function of dofs. */
  class Functional
  {
  public:
    void
    add(const unsigned int dof, const double factor)
    {
      for (auto &[known, value] : entries)
        if (known == dof)
          {
            value += factor;
            return;
          }
      entries.emplace_back(dof, factor);
    }

    /** Adds the component of a velocity. @param dof its first one */
    void
    add(const unsigned int dof, const dealii::Tensor<1, dim> &factor)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (factor[d] != 0.)
          add(dof + d, factor[d]);
    }

    void
    add(const Functional &other, const double factor)
    {
      for (const auto &[dof, value] : other.entries)
        if (factor != 0.)
          add(dof, factor * value);
    }

    double
    of(const Eigen::VectorXd &q) const
    {
      double sum = 0.;
      for (const auto &[dof, factor] : entries)
        sum += factor * q[dof];
      return sum;
    }

    std::vector<std::pair<unsigned int, double>> entries;
  };

  /** Edge of a chain, in its direction. */
  struct Step
  {
    unsigned int                number;   ///< of the edge in PlasticBars
    std::array<unsigned int, 2> vertices; ///< of the mesh
    std::array<unsigned int, 2> ends;     ///< of the edge of the mesh
    double                      length;   ///< scaled
    dealii::Tensor<1, dim>      t, n;     ///< along and to the left

    Step(const BoundScene &bound, const BarChain &chain, const unsigned int i);
  };

  /** @name Triangle to which the cells of an edge, or of an anchor or strut, belong */
  /** @{ */
  unsigned int
  owner_of(const BoundScene &bound, const Step &step);

  unsigned int
  owner_of(const BoundScene &bound, const PlasticBars::Tie &tie);
  /** @} */

  /** Dof of the axial jump at an end of an edge of chains, if there is one: the velocity
   *  of the edge there less that of the vertex, along along_mesh(). */
  std::optional<unsigned int>
  dof_of_jump(const BoundScene  &bound,
              const unsigned int number,
              const unsigned int end);

  /** Unit vector along an edge of the mesh. */
  dealii::Tensor<1, dim>
  along_mesh(const Triangles &triangles, const unsigned int edge);

  /** Position of a vertex or an edge among those of a triangle. */
  unsigned int
  position_in(const std::array<unsigned int, 3> &of_cell,
              const unsigned int                 one);

  /** Unit normal of an edge into a triangle beside it. */
  dealii::Tensor<1, dim>
  normal_into(const Triangles   &triangles,
              const unsigned int cell,
              const unsigned int edge);

  /** Rate of axial strain at an end of an edge. */
  Functional
  axial_rate(const BoundScene &bound, const Step &step, const unsigned int end);

  /** Rate of the curvature of an edge of a plate. */
  Functional
  curvature_rate(const BoundScene &bound, const Step &step);

  /** Rate by which a bar lengthens at the vertex at an end of an edge. */
  Functional
  jump_rate(const BoundScene &bound, const Step &step, const unsigned int end);

  /** Jump of the rotation rate at a vertex of a plate. Empty at free ends. */
  Functional
  hinge_rate(const BoundScene  &bound,
             const BarChain    &chain,
             const unsigned int i);

  /** Edges beside a vertex of a chain: before it and after it, if there are any. The first
   *  vertex of a closed chain has both, its last one, the same again, has none. */
  std::array<std::optional<Step>, 2>
  steps_at(const BoundScene  &bound,
           const BarChain    &chain,
           const unsigned int i);

  /** Rate of the length of an anchor or strut in the upper bound. */
  Functional
  upper_rate_of_tie(const BoundScene &bound, const PlasticBars::Tie &tie);
} // namespace geocone::GEOCONE_DIM

#endif
