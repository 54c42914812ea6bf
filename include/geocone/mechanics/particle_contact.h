// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mechanics_particle_contact_h
#define geocone_mechanics_particle_contact_h

#include <geocone/discretisation/material_points.h>
#include <geocone/discretisation/space.h>
#include <geocone/mechanics/contact.h>
#include <geocone/mechanics/unknowns.h>
#include <geocone/scene/scene.h>

#include <Eigen/Dense>

#include <vector>

namespace geocone
{
  /**
   * Per obstacle the gap to it of the nearest particle that a node moves (m), by the
   * node's first dof, for ObstacleContact::begin(). A particle is a square of its
   * volume. Collective.
   * @param moved what the obstacles have moved since the start
   */
  std::vector<Vector>
  gaps_of_particles(const MaterialPoints           &points,
                    const Obstacles                &obstacles,
                    const std::vector<RigidMotion> &moved,
                    const Space                    &space);

  /** @throws InputError if a particle is in an obstacle at the start. Collective. */
  void
  check_particles_outside(const MaterialPoints &points,
                          const Obstacles      &obstacles,
                          const MPI_Comm        comm);

  /**
   * Where bodies of particles touch. Each has a layer of the background mesh, so that in
   * a place that both reach there is a node of each. Both are parted there by a plane
   *   n.x + o = 0,   n out of the other body,
   * by logistic regression of the particles p that move them (Nairn et al. 2020): with
   * c = 1 in the first body, -1 in the other one, and weights w that are V_p N_i and sum
   * up to 1 in each, the minimum of the convex function
   *   sum_p w_p ln(1 + exp(-c_p (n.x_p + o))) + lambda |n|^2/2
   * of places over the size of a cell. It does not mind sides of the mesh, edges of a
   * body and how densely it is filled, as gradients of volume do. Along n/|n| the gap is
   * what is between the nearest particles of both, squares of their volume; and the
   * length that the node stands for is int N_i dA of the body that has less of it:
   *   -n.sum_p V_p grad N_i of the first, n.sum_p V_p grad N_i of the other one.
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
     * @throws StepFailure if three bodies touch in one place. Collective.
     */
    std::vector<FacingNode>
    find(const MaterialPoints &points, const Unknowns &unknowns) const;

  private:
    /** Two bodies, by the contact between them. */
    struct Pair
    {
      unsigned int contact;
      unsigned int first, other; ///< layers
    };

    /** n and o of each place. */
    using Planes = std::vector<Eigen::Matrix<double, dim + 1, 1>>;

    /** A particle that moves a node of a pair in a place. */
    struct Share
    {
      unsigned int point, place;
      double       side;   ///< c
      double       weight; ///< V N
    };

    std::vector<Share>
    shares_of(const Pair              &pair,
              const MaterialPoints    &points,
              const std::vector<bool> &is_shared) const;

    /** @param[in,out] shares in: weights V N; out: w. Collective. */
    Planes
    part(const Pair           &pair,
         const MaterialPoints &points,
         std::vector<Share>   &shares) const;

    /** Sums the rows of places, of a pair of bodies, over the ranks: by row in turn.
     *  Collective. */
    void
    sum(const Pair &pair, Eigen::MatrixXd &rows) const;

    /** x_p from a place, over the size of a cell, and 1. */
    Eigen::Matrix<double, dim + 1, 1>
    reach(const Share &share, const MaterialPoints &points) const;

    const Scene &scene;
    const Space &space;
    double       size = 0.; ///< of a cell (m)

    std::vector<Pair> pairs;

    /** By place the local nodes of the layers, and by local node the place and the
     *  layer. */
    std::vector<std::vector<unsigned int>> nodes;
    std::vector<unsigned int>              place_of, layer_of;
  };
} // namespace geocone

#endif
