// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_interface_strength_h
#define geocone_solid_bounds_interface_strength_h

#include <geocone/boundary/interface_law.h>
#include <geocone/bounds/spatial_strength.h>
#include <geocone/conic/bound_verdict.h>
#include <geocone/mesh/tetrahedra.h>
#include <geocone/scene/scene.h>

#include <optional>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Strength of the faces on which a body touches an obstacle, |r_t| <= c - mu r_n and
   *  r_n <= t for the traction r on the body, with associated flow. */
  class InterfaceStrength
  {
  public:
    /** @param unit of stress (Pa) */
    InterfaceStrength(const InterfaceLaw &law, const double unit);

    /** Returns true without friction and adhesion. */
    bool
    is_smooth() const
    {
      return friction == 0. && adhesion == 0.;
    }

    /** Returns true if normal tractions are not limited, so that the body cannot
     *  separate. */
    bool
    is_closed() const;

    /** Returns true if the tensile strength cuts off the apex of the cone. */
    bool
    is_cut() const;

    /** Strength |s_t| <= cohesion - friction s_n of a crack in the soil beside. */
    struct Soil
    {
      double cohesion, friction;
    };

    /** Returns whether soil is nowhere weaker than the interface. */
    bool
    is_weaker_than(const Soil &soil) const;

    /** Returns the flow of a jump of the velocity, in the interface and in a crack in the
     *  soil beside: the dissipation is the largest power of the tractions that both carry.
     *  @param u_n,u_t parts along the normal out of the body and along the face */
    SpatialStrength::Flow
    flow(const double               u_n,
         const double               u_t,
         const std::optional<Soil> &soil) const;

    /** Compares a traction on the body with the strength.
     *  @param normal out of the body @param norm of the stress of the body */
    void
    check(const dealii::Tensor<1, dim> &traction,
          const dealii::Tensor<1, dim> &normal,
          const double                  norm,
          StressCheck                  &check) const;

    double friction, adhesion;
    double tension; ///< infinite: the interface never separates
  };

  /** Returns the number of the obstacle that each facet touches, or -1.
   *  @throws InputError if an obstacle touches no facet or only a part of one, penetrates
   *  the body, turns or is free */
  std::vector<int>
  obstacles_of_facets(const Scene &scene, const Tetrahedra &tetrahedra);
} // namespace geocone::GEOCONE_DIM

#endif
