// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_bound_fields_h
#define geocone_limit_analysis_bound_fields_h

#include <geocone/output/simplex_table.h>
#include <geocone/plane_bounds/certificate.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Creates the field file of a mesh, with both failure mechanisms and the
   *  contribution of each triangle to the gap between the bounds. The arguments
   *  must outlive the table. */
  SimplexTable<Triangles>
  table_of_bounds(const BoundScene          &bound,
                  const Bound               &upper,
                  const Bound               &lower,
                  const std::vector<double> &gap);
} // namespace geocone::GEOCONE_DIM

#endif
