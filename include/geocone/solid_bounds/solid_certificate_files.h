// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_solid_certificate_files_h
#define geocone_solid_bounds_solid_certificate_files_h

#include <geocone/bounds/certificate_claim.h>
#include <geocone/solid_bounds/solid_certificate.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Writes the file by which another program can verify a bound of a three-dimensional
   * limit analysis: the mesh, the strengths and loads, and the stresses or velocities of
   * all tetrahedra. All values are in SI units.
   * @param given input of the analysis with unreduced strength
   */
  void
  write_certificate(const std::string      &folder,
                    const SolidScene       &given,
                    const SolidBound       &bound,
                    const CertificateClaim &claim);
} // namespace geocone::GEOCONE_DIM

#endif
