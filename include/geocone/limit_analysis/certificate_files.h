// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_certificate_files_h
#define geocone_limit_analysis_certificate_files_h

#include <geocone/bounds/certificate_claim.h>
#include <geocone/plane_bounds/certificate.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Writes the file by which another program can verify a bound of a plane or
   * axisymmetric limit analysis: the mesh, the strengths and loads, and the stresses or
   * velocities that certify it. All values are in SI units, so that the file can be
   * checked without this program.
   * @param given input of the analysis with unreduced strength
   */
  void
  write_certificate(const std::string      &folder,
                    const BoundScene       &given,
                    const Bound            &bound,
                    const CertificateClaim &claim);
} // namespace geocone::GEOCONE_DIM

#endif
