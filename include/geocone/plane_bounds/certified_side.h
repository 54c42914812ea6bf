// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_plane_bounds_certified_side_h
#define geocone_plane_bounds_certified_side_h

#include <geocone/plane_bounds/certificate.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Power of the strength of a material in a solved problem, by parameter: the
   *  derivative of the dissipation, at constant rates, or of the yield function, at
   *  constant stresses, with respect to the logarithm of the parameter. */
  struct StrengthPower
  {
    double cohesion = 0., growth = 0., tan_phi = 0.;
  };

  /** Solution of one bound on one mesh and its certificate, in scaled units. */
  struct CertifiedSide
  {
    BoundSolution solution;
    Bound         bound;
    unsigned int  n_unknowns = 0;

    /** Internal power |V s.e| of each triangle (volume, stress, strain rate),
     *  computed with the lower bound only. The strain rates e are those of
     *  the dual velocities. */
    std::vector<double> power;

    /** Power of the strength of each material of an axisymmetric body. */
    std::vector<StrengthPower> strength_power;
  };
} // namespace geocone::GEOCONE_DIM

#endif
