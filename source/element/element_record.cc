// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/element/element_record.h>

#include <cmath>

namespace geocone::GEOCONE_DIM
{
  double
  ElementRecord::deviatoric_strain() const
  {
    Tensor6 dev = strain;
    for (unsigned int i = 0; i < 3; ++i)
      dev[i] -= volumetric_strain() / 3.;
    return std::sqrt(2. / 3.) * norm(dev);
  }

  StatisticsTable<ElementRecord>
  element_columns(const ElementPoint &point, const double volume)
  {
    using Record = ElementRecord;
    StatisticsTable<Record> table;
    const auto              add_components = [&](const std::string &name,
                                    const std::string &unit,
                                    Tensor6 Record::*member) {
      for (unsigned int i = 0; i < 6; ++i)
        if (point.has(i))
          table.add(name + component_names[i] + unit,
                    [i, member](const Record &r) { return (r.*member)[i]; });
    };
    table.add("increment (-)", [](const Record &r) { return r.increment; });
    table.add("stage (-)", [](const Record &r) { return r.stage; });
    add_components("eps ", " (-)", &Record::strain);
    table.add("eps_v (-)",
              [](const Record &r) { return r.volumetric_strain(); });
    table.add("eps_q (-)",
              [](const Record &r) { return r.deviatoric_strain(); });
    table.add("ln v (-)", [volume](const Record &r) {
      return std::log(volume) + r.volumetric_strain();
    });
    table.add("strain path (-)", [](const Record &r) { return r.strain_path; });
    add_components("stress ", " (Pa)", &Record::stress);
    const std::vector<std::string> of_law = point.names();
    for (std::size_t k = 0; k < of_law.size(); ++k)
      table.add(of_law[k], [k](const Record &r) { return r.shown[k]; });
    table.add("substeps (-)", [](const Record &r) { return r.substeps; });
    table.add("forced substeps (-)", [](const Record &r) { return r.forced; });
    return table;
  }
} // namespace geocone::GEOCONE_DIM
