// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_plate_strength_h
#define geocone_terms_plate_strength_h

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace geocone
{
  /** Axial force of a segment of a plate or bending moment at a point of it,
   *  divided by its strength. */
  struct PlateForce
  {
    /** Elastic force, in and force within the strength, out (-). */
    double value = 0.;

    /** Elastic energy is compliance/2 value^2: the square of the strength over
     *  the stiffness of this force. */
    double compliance = 1.;
  };

  /** Forces of a plate that yield together. */
  struct YieldingForces
  {
    std::vector<unsigned int> forces; ///< positions in the list of forces

    /** Derivative of the forces by the elastic forces. With the compliances as
     *  row factors it is symmetric. */
    Eigen::MatrixXd derivative;
  };

  /**
   * Projects the elastic forces of a plate onto its strength
   *   |m| + n^2 <= 1
   * for each pair of a moment m and an axial force n of a segment beside it, in
   * the elastic energy norm: the closed form of the complementarity between
   * forces and plastic strains with associated flow, at all points of the plate
   * at once (doc/theory/structures.md).
   * @param[in,out] forces elastic forces, and forces within the strength
   * @param pairs positions of m and n in the list
   * @return the groups of forces that yield; all others are elastic
   */
  std::vector<YieldingForces>
  return_to_interaction(std::vector<PlateForce>                        &forces,
                        const std::vector<std::array<unsigned int, 2>> &pairs);
} // namespace geocone

#endif
