// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reduced_stress_methods_h
#define geocone_reduced_stress_methods_h

#include <geocone/newton/nonsmooth_newton.h>

namespace geocone::GEOCONE_DIM
{
  /** Parameter value that selects the Gauss-Seidel method. It applies to the
   *  formulation and to the first iterate. */
  constexpr const char *gauss_seidel = "Gauss-Seidel";

  /** Returns the solution methods with stresses as the only unknowns. They are reduced
   *  formulations solved by Newton's method or Gauss-Seidel, and first iterates by
   *  Gauss-Seidel sweeps. */
  StressMethods
  stress_methods();
} // namespace geocone::GEOCONE_DIM

#endif
