// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_record_h
#define geocone_element_element_record_h

#include <geocone/element/element_point.h>
#include <geocone/output/statistics_table.h>

#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Record of an element test: state of the material point initially or
   *  after an accepted increment. */
  struct ElementRecord
  {
    unsigned int        increment   = 0;
    unsigned int        stage       = 0; ///< from 1; 0: initial state
    Tensor6             strain      = {};
    Tensor6             stress      = {};         ///< (Pa)
    double              strain_path = 0.;         ///< sum of increment norms
    std::vector<double> shown;                    ///< ElementPoint::values()
    unsigned long long  substeps = 0, forced = 0; ///< in the increment

    double
    volumetric_strain() const
    {
      return strain[0] + strain[1] + strain[2];
    }

    /** Deviatoric strain eps_q = sqrt(2/3) ||dev eps||. */
    double
    deviatoric_strain() const;
  };

  /** Defines the columns of path.csv for a material point.
   *  @param volume initial specific volume (-) */
  StatisticsTable<ElementRecord>
  element_columns(const ElementPoint &point, const double volume);
} // namespace geocone::GEOCONE_DIM

#endif
