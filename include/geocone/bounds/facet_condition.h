// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_facet_condition_h
#define geocone_bounds_facet_condition_h

#include <geocone/boundary/boundary_conditions.h>

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Velocity prescribed on a boundary facet in a limit analysis with velocities that
   *  jump at facets. */
  struct FacetCondition
  {
    enum class Kind
    {
      free,
      fixed,    ///< all velocity components prescribed
      plane,    ///< only the normal component prescribed
      interface ///< contact with an obstacle that has the velocity
    };
    Kind                   kind = Kind::free;
    dealii::Tensor<1, dim> velocity;
    unsigned int axis = 0; ///< of the normal, for Kind::plane; dim: oblique
    dealii::Tensor<1, dim> normal; ///< unit normal of an oblique plane
    unsigned int           obstacle = 0; ///< its number, for Kind::interface

    /** Returns true for a plane whose normal is not along an axis. */
    bool
    is_oblique() const
    {
      return kind == Kind::plane && axis == dim;
    }

    /** Returns true if a component of the velocity is prescribed. */
    bool
    holds(const unsigned int component) const
    {
      return kind == Kind::fixed || (kind == Kind::plane && axis == component);
    }

    /** Returns the part of a velocity that is prescribed, or of a traction that is the
     *  reaction. */
    dealii::Tensor<1, dim>
    held_part(const dealii::Tensor<1, dim> &v) const
    {
      dealii::Tensor<1, dim> part;
      if (is_oblique())
        part = (v * normal) * normal;
      for (unsigned int d = 0; d < dim; ++d)
        if (holds(d))
          part[d] = v[d];
      return part;
    }
  };

  /** Boundary facet of a mesh with its vertices and its outward normal. */
  struct FacetPlace
  {
    std::array<dealii::Point<dim>, dim> vertices;
    dealii::Tensor<1, dim>              normal;
  };

  /** Returns a velocity component that a boundary condition prescribes on a facet (m/s); that
   *  along the outward normal for @p component = dim.
   *  @throws InputError if it differs between the vertices and points between them */
  double
  prescribed_on_facet(const BoundaryCondition                   &condition,
                      const unsigned int                         component,
                      const std::array<dealii::Point<dim>, dim> &vertices);

  /** Returns the largest difference of a vector field from the linear one with its values at
   *  the vertices of a facet, over many places between them. */
  double
  departure_from_linear(
    const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>
                                              &field,
    const std::array<dealii::Point<dim>, dim> &vertices);

  /** Velocity components that boundary conditions prescribe on a facet, from which its
   *  FacetCondition follows. */
  class HeldComponents
  {
  public:
    /** Adds the components prescribed by a boundary condition (m/s).
     *  @throws InputError if the velocity varies on the facet or differs from another
     *  condition, or for a normal velocity that is not zero; around an axis also for one
     *  that is not along an axis */
    void
    add(const BoundaryCondition &condition, const FacetPlace &place);

    /** Returns the condition of the facet.
     *  @throws InputError if the prescribed components are neither all of them nor the
     *  normal one */
    FacetCondition
    condition(const FacetPlace &place) const;

  private:
    std::array<std::optional<double>, dim> value;
    std::optional<dealii::Tensor<1, dim>>  oblique; ///< normal of a plane
    const BoundaryCondition               *last = nullptr;
  };

  /** Returns the velocity (m/s) that is prescribed on facets and is not zero, or no
   *  value. @throws InputError for several different velocities */
  std::optional<dealii::Tensor<1, dim>>
  prescribed_velocity(const std::vector<FacetCondition> &held);

  /** Returns the tractions (Pa) of a load at the vertices of a facet.
   *  @param held condition of the facet
   *  @throws InputError for a traction that is not linear on the facet, or that acts on
   *  a component with a prescribed velocity */
  std::array<dealii::Tensor<1, dim>, dim>
  tractions_at_vertices(const BoundaryCondition &load,
                        const FacetPlace        &place,
                        const FacetCondition    &held);
} // namespace geocone::GEOCONE_DIM

#endif
