// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/log.h>
#include <geocone/points/initial_overstress.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  using namespace dealii;

  std::string
  warn_of_overstress(const MaterialPoints &points,
                     const Materials      &materials,
                     const MPI_Comm        comm)
  {
    unsigned int n = 0, first = materials.size();
    for (unsigned int p = 0; p < points.n_points(); ++p)
      if (const auto overstress = materials[points.material[p]].overstress(
            points.stress[p], points.history_of(p));
          overstress && *overstress > 1e-6 * points.stress[p].norm())
        {
          ++n;
          first = std::min(first, points.material[p]);
        }
    n     = Utilities::MPI::sum(n, comm);
    first = Utilities::MPI::min(first, comm);
    if (n == 0)
      return "";
    return format("the initial stress of %u points is outside of the "
                  "strength, e.g. of the material '",
                  n) +
           materials.name(first) +
           "': the first step jumps to another one; set 'Initial stress/K0' "
           "= "
           "automatic where it is geostatic, or change the stress or the "
           "strength";
  }
} // namespace geocone::GEOCONE_DIM
