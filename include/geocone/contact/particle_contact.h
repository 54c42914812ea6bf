// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_particle_contact_h
#define geocone_contact_particle_contact_h

#include <geocone/conditions/unknowns.h>
#include <geocone/contact/contact.h>
#include <geocone/points/material_points.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Per obstacle the gap to it of the nearest particle that a node moves (m), by the
   * node's first dof, for ObstacleContact::begin(). A particle is a square of its
   * volume. Collective.
   * Where one obstacle ends and another one goes on, the particles before both count.
   * @param moved what the obstacles have moved since the start
   * @param margin see Neighbours
   */
  std::vector<Vector>
  gaps_of_particles(const MaterialPoints           &points,
                    const Scene                    &scene,
                    const std::vector<RigidMotion> &moved,
                    const Space                    &space,
                    const double                    margin);

  /** @throws InputError if a particle is in an obstacle at the start. Collective. */
  void
  check_particles_outside(const MaterialPoints &points,
                          const Obstacles      &obstacles,
                          const MPI_Comm        comm);

  /**
   * Where bodies of particles touch. Each has a layer of the background mesh, so that in
   * a place that both reach there is a node of each. The normal there is that of the plane
   * which parts the particles that move the two nodes with the greatest margin: along
   * the shortest way between their convex hulls. Unlike gradients of volume it does not
   * mind sides of the mesh, edges of a body and how densely it is filled. Where no
   * plane parts them, in a notch, it is that of the gradients,
   *   n = a_other - a_first,   a = sum_p V_p grad N_i = int N_i n dA  of a body.
   * Along n the gap is what is between the nearest particles of both, squares of their
   * volume; and the length that the node stands for is the smaller one of -n.a of the first
   * body and n.a of the other one.
   */
  class ParticleBodies
  {
  public:
    ParticleBodies(const Scene          &scene,
                   const BackgroundMesh &mesh,
                   const Space          &space);

    /**
     * The nodes of first bodies that may touch the other ones, of this rank and its
     * ghosts: in each place those of the pair that is nearest.
     * @param unknowns which nodes have mass
     * @throws StepFailure if three bodies touch in one place, or if a body whose points
     * stay in the mesh has moved too far for it. Collective.
     */
    std::vector<FacingNode>
    find(const MaterialPoints &points, const Unknowns &unknowns) const;

    /** @throws InputError if particles of two bodies are in the same place at the
     *  start. Collective. */
    void
    check_start(const MaterialPoints &points, const Unknowns &unknowns) const;

  private:
    /** Two bodies, by the contact between them. */
    struct Pair
    {
      unsigned int contact;
      unsigned int first, other; ///< layers
    };

    /** A particle that moves the node of a pair in a place. */
    struct Share
    {
      unsigned int       place;
      bool               is_first; ///< of the first body
      dealii::Point<dim> x;
      double             half; ///< of its square's side (m)
    };

    /** Of all particles that move nodes of a pair where both have mass. */
    std::vector<Share>
    shares_of(const Pair           &pair,
              const MaterialPoints &points,
              const Unknowns       &unknowns) const;

    /** The normals by place; zero where no plane parts the bodies. Each rank gets the
     *  corners of all hulls, of which there are few. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    normals(const Pair &pair, const std::vector<Share> &shares) const;

    /** The gaps by place along the normals. Collective. */
    std::vector<double>
    gaps(const Pair                                &pair,
         const std::vector<Share>                  &shares,
         const std::vector<dealii::Tensor<1, dim>> &normal) const;

    /** @throws StepFailure if points that stay have moved by half a cell. Collective. */
    void
    check_fixed(const MaterialPoints &points) const;

    const Scene &scene;
    const Space &space;
    double       size = 0.; ///< of a cell (m)

    std::vector<Pair> pairs;

    /** By place the local nodes of the layers, and by local node the place and the
     *  layer. */
    std::vector<std::vector<unsigned int>> nodes;
    std::vector<unsigned int>              place_of, layer_of;
  };
} // namespace geocone::GEOCONE_DIM

#endif
