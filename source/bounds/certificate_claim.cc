// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/files.h>
#include <geocone/bounds/certificate_claim.h>

namespace geocone
{
  Json
  CertificateClaim::entries(const std::string &analysis,
                            const double       load_factor,
                            const double       speed) const
  {
    return {{"format", "certificate of a " + analysis + ", 1"},
            {"bound", side()},
            {"of", kind},
            {"value", value},
            {"strength_factor", strength_factor},
            {"load_factor", load_factor},
            {"multiple", multiple},
            {"speed", speed}};
  }

  void
  CertificateClaim::write(const std::string &folder, const Json &json) const
  {
    write_file(folder + "/certificate_" + side() + ".json",
               [&](std::ostream &out) { out << json.dump() << "\n"; });
  }
} // namespace geocone
