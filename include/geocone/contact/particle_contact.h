// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_contact_particle_contact_h
#define geocone_contact_particle_contact_h

#include <geocone/conditions/unknowns.h>
#include <geocone/contact/contact.h>
#include <geocone/points/material_points.h>
#include <geocone/scene/scene.h>
#include <geocone/space/space.h>

#include <algorithm>
#include <bitset>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Obstacles by index; the last element stands for all from there on. */
  using ObstacleSet = std::bitset<64>;

  /** Returns the element of an obstacle. */
  inline unsigned int
  element_of(const unsigned int obstacle)
  {
    return std::min<unsigned int>(obstacle, ObstacleSet().size() - 1);
  }

  /**
   * Gaps between obstacles and a particle, as the nodes that move the particle see
   * them. A particle is a square with the particle's volume. If another obstacle
   * continues the surface of an obstacle, the particles in front of both count.
   */
  class ParticleGaps
  {
  public:
    /** @param nodes positions of all nodes; must outlive this object */
    ParticleGaps(const Obstacles                       &obstacles,
                 const std::vector<dealii::Point<dim>> &nodes);

    /** Places the obstacles.
     *  @param moved displacements since the beginning of the run; must not change
     *  until the next call
     *  @param margin see Neighbours */
    void
    begin_step(const std::vector<RigidMotion> &moved, const double margin);

    /** Selects a particle.
     *  @param half half the side of its square (m)
     *  @param is_near obstacles that may be near; the others are not considered */
    void
    take(const dealii::Point<dim> &x,
         const double              half,
         const ObstacleSet        &is_near = ObstacleSet().set());

    /** Returns the gap between an obstacle and the selected particle (m), for a node
     *  that moves it. */
    double
    gap(const unsigned int obstacle, const unsigned int node);

    /** Returns the smallest gap between the selected particle and an obstacle (m). */
    double
    least_gap() const;

  private:
    /** Distance of a node from an obstacle, known if it is of the current step. */
    struct OfNode
    {
      Obstacle::Nearest nearest;
      unsigned int      step = 0;
    };

    const Obstacles                       &obstacles;
    const std::vector<dealii::Point<dim>> &nodes;
    const std::vector<RigidMotion>        *moved  = nullptr;
    double                                 margin = 0.;
    unsigned int                           step   = 0;
    std::vector<Neighbours>                neighbours;
    std::vector<std::vector<OfNode>>       of_nodes; ///< by obstacle
    std::vector<Obstacle::Nearest>         near;     ///< of the particle
    dealii::Point<dim>                     x;
    double                                 half = 0.;
  };

  /**
   * Computes the gap between each obstacle and the nearest particle in the support
   * of each node (m). Gaps are stored at the first dof of the node, for
   * ObstacleContact::begin(). Collective.
   * @param moved displacements of the obstacles since the beginning of the run
   * @param margin see Neighbours
   */
  std::vector<Vector>
  gaps_of_particles(const MaterialPoints           &points,
                    const Scene                    &scene,
                    const std::vector<RigidMotion> &moved,
                    const Space                    &space,
                    const double                    margin);

  /** Checks obstacles in contact with particles: that they have no laws that need a
   *  contact area or initial positions, and that no particle is inside them in the
   *  initial state. Collective.
   *  @param positions of the particles of this rank
   *  @throws InputError otherwise */
  void
  check_obstacles_of_particles(const std::vector<dealii::Point<dim>> &positions,
                               const Obstacles                       &obstacles,
                               const MPI_Comm                         comm);

  /**
   * Contact between bodies discretised by particles. Each body has its own layer of
   * the background mesh, so that at a position within reach of both bodies there is
   * a node of each. The contact normal is that of the plane that separates the
   * particles of both nodes with the largest margin: along the shortest line between
   * their convex hulls. Unlike gradients of volume, this normal does not depend on
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
     * Finds the potential contact nodes of the first body of each contact pair,
     * owned or ghost. At each position, only the nodes of the nearest pair are
     * selected. Collective.
     * @param unknowns determine which nodes have mass
     * @throws StepFailure if three bodies meet at one position, or if the
     * displacement of a body with fixed quadrature points is too large
     */
    std::vector<FacingNode>
    find(const MaterialPoints &points, const Unknowns &unknowns) const;

    /** Checks that particles of different bodies do not overlap in the initial
     *  state. Collective. @throws InputError if particles overlap */
    void
    check_start(const MaterialPoints &points, const Unknowns &unknowns) const;

  private:
    /** Contact pair: two bodies, identified by layers of the mesh. */
    struct Pair
    {
      unsigned int contact;
      unsigned int first, other; ///< layers of both bodies
    };

    /** A particle in the support of the shape functions of a pair of coincident
     *  nodes, one on each body. */
    struct SupportParticle
    {
      unsigned int       position_index; ///< number of the position
      bool               is_first;       ///< belongs to the first body
      dealii::Point<dim> x;
      double             half; ///< half the side of the particle's square (m)
    };

    /** Lists the particles in the support of each pair of coincident nodes that
     *  both have mass. */
    std::vector<SupportParticle>
    support_particles(const Pair           &pair,
                      const MaterialPoints &points,
                      const Unknowns       &unknowns) const;

    /** Computes the contact normal at each pair of coincident nodes. Zero if no
     *  plane separates the bodies. Each rank receives the corners of all convex
     *  hulls, which are few. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    normals(const Pair                         &pair,
            const std::vector<SupportParticle> &particles) const;

    /** Computes the gap along the contact normal at each pair of coincident nodes
     *  (m). Collective. */
    std::vector<double>
    gaps(const Pair                                &pair,
         const std::vector<SupportParticle>        &particles,
         const std::vector<dealii::Tensor<1, dim>> &normal) const;

    /** Checks that the displacements of fixed quadrature points are smaller
     *  than half a cell. Collective. @throws StepFailure if they are larger */
    void
    check_fixed(const MaterialPoints &points) const;

    const Scene &scene;
    const Space &space;
    double       size = 0.; ///< cell size (m)

    std::vector<Pair> pairs;

    /** Local nodes of all mesh layers, grouped by position. The arrays index_of
     *  and layer_of contain the position and the layer of each local node. */
    std::vector<std::vector<unsigned int>> nodes;
    std::vector<unsigned int>              index_of, layer_of;
  };
} // namespace geocone::GEOCONE_DIM

#endif
