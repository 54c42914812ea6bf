// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_held_bodies_h
#define geocone_bounds_held_bodies_h

#include <geocone/bounds/facet_condition.h>
#include <geocone/conic/conic_solver.h>

#include <array>
#include <map>

namespace geocone::GEOCONE_DIM
{
  /** Dofs of the rigid bodies that hold parts of the boundary: the distinct velocities of
   *  fixed facets and of planes. */
  class HeldBodies
  {
  public:
    explicit HeldBodies(const unsigned int first_dof)
      : first_dof(first_dof)
    {}

    /** Adds the body that holds a facet, if one does. */
    void
    add(const FacetCondition &held)
    {
      if (held.kind != FacetCondition::Kind::free)
        number.emplace(key(held), number.size());
    }

    /** Number of all dofs up to those of the last body. */
    unsigned int
    n_dofs() const
    {
      return first_dof + dim * number.size();
    }

    unsigned int
    dof_of(const FacetCondition &held) const
    {
      return first_dof + dim * number.at(key(held));
    }

    /** Prescribes the velocities of all bodies. */
    void
    prescribe(ConicProblem &problem) const
    {
      for (const auto &[velocity, own] : number)
        for (unsigned int d = 0; d < dim; ++d)
          {
            problem.is_prescribed[first_dof + dim * own + d] = true;
            problem.prescribed[first_dof + dim * own + d]    = velocity[d];
          }
    }

  private:
    using Key = std::array<double, dim>;

    static Key
    key(const FacetCondition &held)
    {
      Key velocity;
      for (unsigned int d = 0; d < dim; ++d)
        velocity[d] = held.velocity[d];
      return velocity;
    }

    unsigned int                first_dof;
    std::map<Key, unsigned int> number;
  };
} // namespace geocone::GEOCONE_DIM

#endif
