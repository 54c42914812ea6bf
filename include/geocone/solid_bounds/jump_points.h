// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_jump_points_h
#define geocone_solid_bounds_jump_points_h

#include <geocone/solid_bounds/solid_points.h>

#include <memory>

namespace geocone::GEOCONE_DIM
{
  /** Strength of a face with a tensile strength below the apex of its cone. */
  using CutFaceCone =
    StrengthLaw<ProductCone<SecondOrderCone<3>, SecondOrderCone<1>>, 3, 0>;

  /** @param tension tensile strength over the cohesion */
  CutFaceCone
  cut_face_cone(const double mu, const double tension);

  /** Points of the jumps of velocity at facets, and of the tractions on obstacles. Each
   *  has six dofs, those of both sides. */
  class JumpPoints
  {
  public:
    using Dofs = std::array<unsigned int, 6>;
    using Axes = std::array<dealii::Tensor<1, dim>, dim>;

    /** @param margin reduction of the tensile strength of interfaces */
    explicit JumpPoints(const SolidScene &bound, const double margin = 0.);

    /** Adds a jump within soil. @param k cohesion of the facet */
    void
    add_in_soil(const unsigned int material,
                const Axes        &axes,
                const Dofs        &dofs,
                const double       weight,
                const double       k);

    /** Adds an opening at a smooth plane. @param tension tensile strength */
    void
    add_opening(const dealii::Tensor<1, dim> &normal,
                const Dofs                   &dofs,
                const double                  weight,
                const double                  tension);

    /** Adds a smooth plane that soil cannot leave. */
    void
    add_closed(const dealii::Tensor<1, dim> &normal,
               const Dofs                   &dofs,
               const double                  weight);

    /** Adds a jump at an obstacle.
     *  @param axes_of_first axes to which the dofs of the first side refer */
    void
    add_at_obstacle(const unsigned int obstacle,
                    const Axes        &axes,
                    const Dofs        &dofs,
                    const double       weight,
                    const Axes        &axes_of_first);

    /** Moves the groups that have points to a problem. */
    void
    move_to(ConicProblem &problem);

  private:
    using Faces     = PointGroupOf<FaceCone, 6>;
    using CutLayers = PointGroupOf<CutMohrCoulombCones, 6>;
    using CutFaces  = PointGroupOf<CutFaceCone, 6>;
    using Planes    = PointGroupOf<OpeningCone, 6>;

    const std::vector<SpatialStrength>   &strengths;
    const std::vector<InterfaceStrength> &interfaces;
    std::vector<unsigned int> number; ///< of the law of a material in its group
    std::vector<unsigned int> number_at; ///< likewise of an obstacle
    std::unique_ptr<Faces>    faces;
    std::unique_ptr<CutLayers> cut_layers;
    std::unique_ptr<CutFaces>  cut_faces;
    std::unique_ptr<Planes>    planes;
  };

  /** Dofs of a jump. @param first,second x dofs of both sides */
  JumpPoints::Dofs
  dofs_of_both(const unsigned int first, const unsigned int second);

  /** The axes x, y and z. */
  JumpPoints::Axes
  global_axes();
} // namespace geocone::GEOCONE_DIM

#endif
