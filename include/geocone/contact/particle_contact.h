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
   * Gap between each obstacle and the nearest particle moved by a node (m), by
   * the node's first dof, for ObstacleContact::begin(). A particle is a square
   * of its volume. Collective.
   *
   * If another obstacle continues the surface of an obstacle, the particles in
   * front of both count.
   * @param moved displacements of the obstacles since the start
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
   * Contact between bodies of particles. Each body has its own layer of the
   * background mesh, so that at a position within reach of both there is a node
   * of each. The normal there is that of the plane that separates the particles
   * of both nodes with the largest margin: along the shortest line between
   * their convex hulls. Unlike gradients of volume it does not depend on
   * boundaries of the mesh, edges of a body and the density of particles. If no
   * plane separates them, as in a notch, the normal is that of the gradients,
   *   n = a_other - a_first,   a = sum_p V_p grad N_i = int N_i n dA  of a body.
   * The gap is the distance along n between the nearest particles of both,
   * squares of their volume. The tributary length of the node is the smaller of
   * -n.a of the first body and n.a of the other one.
   */
  class ParticleBodies
  {
  public:
    ParticleBodies(const Scene          &scene,
                   const BackgroundMesh &mesh,
                   const Space          &space);

    /**
     * Finds the nodes of first bodies that may contact the other ones, of this
     * rank and its ghosts: at each position those of the nearest pair.
     * @param unknowns which nodes have mass
     * @throws StepFailure if three bodies meet at one position, or if a body
     * with fixed quadrature points has moved too far for it. Collective.
     */
    std::vector<FacingNode>
    find(const MaterialPoints &points, const Unknowns &unknowns) const;

    /** @throws InputError if particles of two bodies overlap at the start.
     *  Collective. */
    void
    check_start(const MaterialPoints &points, const Unknowns &unknowns) const;

  private:
    /** Two bodies in contact, as layers of the mesh. */
    struct Pair
    {
      unsigned int contact;
      unsigned int first, other; ///< layers
    };

    /** A particle that moves the node of a pair at a position. */
    struct Share
    {
      unsigned int       place;
      bool               is_first; ///< of the first body
      dealii::Point<dim> x;
      double             half; ///< half the side of its square (m)
    };

    /** Shares of all particles that move nodes of a pair, where both have
     *  mass. */
    std::vector<Share>
    shares_of(const Pair           &pair,
              const MaterialPoints &points,
              const Unknowns       &unknowns) const;

    /** Normals by position; zero if no plane separates the bodies. Each rank
     *  receives the corners of all hulls, which are few. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    normals(const Pair &pair, const std::vector<Share> &shares) const;

    /** Gaps by position along the normals. Collective. */
    std::vector<double>
    gaps(const Pair                                &pair,
         const std::vector<Share>                  &shares,
         const std::vector<dealii::Tensor<1, dim>> &normal) const;

    /** @throws StepFailure if fixed quadrature points have moved by half a
     *  cell. Collective. */
    void
    check_fixed(const MaterialPoints &points) const;

    const Scene &scene;
    const Space &space;
    double       size = 0.; ///< of a cell (m)

    std::vector<Pair> pairs;

    /** Local nodes of the layers by position, and position and layer by local
     *  node. */
    std::vector<std::vector<unsigned int>> nodes;
    std::vector<unsigned int>              place_of, layer_of;
  };
} // namespace geocone::GEOCONE_DIM

#endif
