// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_solid_scene_h
#define geocone_solid_bounds_solid_scene_h

#include <geocone/bounds/facet_condition.h>
#include <geocone/bounds/load_choice.h>
#include <geocone/bounds/spatial_strength.h>
#include <geocone/mesh/tetrahedra.h>
#include <geocone/scene/scene.h>
#include <geocone/solid_bounds/interface_strength.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Input of a three-dimensional limit analysis on a mesh: scene, tetrahedra, loads and
   *  strengths. */
  class SolidScene
  {
  public:
    const Scene               *scene      = nullptr;
    const Tetrahedra          *tetrahedra = nullptr;
    LoadFactor                 factor     = LoadFactor::automatic;
    BoundUnits                 units;
    std::vector<SpatialStrength> strengths; ///< strength of each material
    std::vector<InterfaceStrength> interfaces; ///< strength of each obstacle's
    std::vector<FacetCondition>
      facet_conditions; ///< prescribed velocity of each facet

    /** Body force of a cell or traction at a vertex of a facet, in scaled units. The dead
     *  part is constant; the live part is multiplied by the load factor. */
    struct Load
    {
      dealii::Tensor<1, dim> dead, live;
    };
    Load
    body_force(const unsigned int cell) const;

    /** Negative gradient of the pore pressure (N/m^3), which is linear between
     *  its values at the vertices of a cell unless it is hydrostatic. */
    dealii::Tensor<1, dim>
    seepage_force(const unsigned int cell) const;
    std::array<Load, 3>
    tractions(const unsigned int facet) const
    {
      return traction_of_facet[facet];
    }

    /** Returns whether a facet is a free surface without any traction at a vertex. */
    bool
    is_without_traction(const unsigned int facet,
                        const unsigned int vertex) const;

    /** Returns the strength k at the vertices of a cell. */
    std::array<double, 4>
    strength_at_vertices(const unsigned int cell) const;

    std::vector<std::array<Load, 3>> traction_of_facet;
  };

  /** Load bounded by a three-dimensional limit analysis, with the strengths and the
   *  scaled units. */
  class SolidLoad : public LoadChoice
  {
  public:
    /**
     * Selects the loads multiplied by the load factor, and the scaled units of the
     * analysis.
     * @param scene prepared scene
     * @param tetrahedra of the first mesh
     * @throws InputError if strict bounds cannot be computed
     */
    void
    prepare(const Scene &scene, const Tetrahedra &tetrahedra);

    /** Prepares strength reduction, in which the load factor multiplies all loads.
     *  @throws InputError also for circular cones with friction */
    void
    prepare_reduction(const Scene &scene, const Tetrahedra &tetrahedra);

    /** Returns a mesh without cells that have two free facets, or a free one and one on
     *  a smooth plane that is not normal to it. Stresses of the lower bound would have
     *  only one component along the edge between these facets. */
    CoarseMesh
    divided_at_edges(const Scene &scene, const Tetrahedra &tetrahedra) const;

    /** Input of the upper-bound and lower-bound problems on a mesh. */
    SolidScene
    on(const Scene &scene, const Tetrahedra &tetrahedra) const;

    /** Input of the upper-bound and lower-bound problems on a mesh, for the
     *  reduced strength c/F and tan(phi)/F. */
    SolidScene
    reduced(const Scene      &scene,
            const Tetrahedra &tetrahedra,
            const double      F) const;

  private:
    void
    take_strengths(const Scene &scene);
    void
    check_loads(const Scene                       &scene,
                const Tetrahedra                  &tetrahedra,
                const std::vector<FacetCondition> &held);
    std::vector<FacetCondition>
    facet_conditions(const Scene &scene, const Tetrahedra &tetrahedra) const;
    void
    choose_units(const Scene &scene, const Tetrahedra &tetrahedra);

    std::vector<SpatialStrength> strengths; ///< strength of each material (Pa)
  };
} // namespace geocone::GEOCONE_DIM

#endif
