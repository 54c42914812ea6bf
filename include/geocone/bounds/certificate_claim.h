// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_certificate_claim_h
#define geocone_bounds_certificate_claim_h

#include <geocone/folder/json.h>

#include <string>

namespace geocone
{
  /** Bound that a file states together with the fields that prove it. Another
   *  program can verify it: scripts/check_certificate. */
  struct CertificateClaim
  {
    std::string kind; ///< of analysis: "limit load" or "strength reduction"
    bool        is_lower;
    double      value; ///< of the bound, as reported

    /** Factor F by which the strength is divided; 1 for a limit load. */
    double strength_factor;

    /** Ratio of the reported load to the reaction along the velocity, for
     *  bounds on a reaction; 1 otherwise. */
    double multiple;

    /** First entries of the file.
     *  @param analysis "plane limit analysis" or "limit analysis in space"
     *  @param load_factor of the live loads; 0 for a reaction
     *  @param speed prescribed, for a reaction (m/s); otherwise 0 */
    Json
    entries(const std::string &analysis,
            const double       load_factor,
            const double       speed) const;

    /** Writes certificate_lower.json or certificate_upper.json, replacing the
     *  file of an earlier mesh. */
    void
    write(const std::string &folder, const Json &json) const;

  private:
    const char *
    side() const
    {
      return is_lower ? "lower" : "upper";
    }
  };
} // namespace geocone

#endif
