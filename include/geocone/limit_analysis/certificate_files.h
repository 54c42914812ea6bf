// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_certificate_files_h
#define geocone_limit_analysis_certificate_files_h

#include <geocone/limit_analysis/certificate.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Writes the files by which another program can verify both bounds of a plane limit
   * analysis. A file certificate_lower.json or certificate_upper.json contains the mesh,
   * the strengths and loads, and the stresses or velocities that certify one bound. All
   * values are in SI units, so that the file can be checked without this program;
   * scripts/check_certificate is such a checker.
   */
  struct CertificateFiles
  {
    /** Certified bound on the limit load or the factor of safety. */
    struct Claim
    {
      BoundSide    side;
      const Bound &bound;
      double       value; ///< of the bound, as reported

      /** Factor F by which the strength is divided; 1 for a limit load. */
      double strength_factor;

      /** Ratio of the reported load to the reaction along the velocity, for bounds
       *  on a reaction; 1 otherwise. */
      double multiple;
    };

    /** Writes the file of a bound to a folder, replacing the file of an earlier mesh.
     *  @param given input of the analysis with unreduced strength
     *  @param kind of the analysis, "limit load" or "strength reduction" */
    static void
    write(const std::string &folder,
          const std::string &kind,
          const BoundScene  &given,
          const Claim       &claim);
  };
} // namespace geocone::GEOCONE_DIM

#endif
