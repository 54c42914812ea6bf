// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_solid_certificate_files_h
#define geocone_limit_analysis_solid_certificate_files_h

#include <geocone/limit_analysis/solid_certificate.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /** Bound of a three-dimensional limit analysis that another program can verify. */
  struct SolidClaim
  {
    bool              is_lower;
    const SolidBound &bound;
    double            value; ///< of the bound, as reported

    /** Factor F by which the strength is divided; 1 for a limit load. */
    double strength_factor;

    /** Ratio of the reported load to the reaction along the velocity, for bounds
     *  on a reaction; 1 otherwise. */
    double multiple;
  };

  /**
   * Writes the file by which another program can verify a bound, replacing the file of an
   * earlier mesh: certificate_lower.json or certificate_upper.json, with the mesh, the
   * strengths and loads, and the stresses or velocities of all tetrahedra. All values are
   * in SI units; scripts/check_certificate checks them without this program.
   * @param given input of the analysis with unreduced strength
   * @param kind of the analysis, "limit load" or "strength reduction"
   */
  void
  write_certificate(const std::string &folder,
                    const std::string &kind,
                    const SolidScene  &given,
                    const SolidClaim  &claim);
} // namespace geocone::GEOCONE_DIM

#endif
