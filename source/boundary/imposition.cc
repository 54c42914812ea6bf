// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/boundary/imposition.h>

namespace geocone
{
  namespace
  {
    using PrescribedParticle = Imposition::PrescribedParticle;
    using Share = Imposition::Share;

    Share
    own_row(const PrescribedParticle &particle)
    {
      return {particle.id, 1.};
    }

    Share
    mean_of_cell(const PrescribedParticle &particle)
    {
      return {particle.cell, particle.of_cell};
    }

    Share
    mean_of_all(const PrescribedParticle &particle)
    {
      return {0, particle.of_all};
    }
  } // namespace

  const std::vector<Imposition> &
  impositions()
  {
    using On                                 = Imposition::On;
    static const std::vector<Imposition> all = {
      {"nodes", On::nodes, nullptr, false},
      {"points", On::particles, &own_row, true},
      {"particles (FLIP)", On::particles, &own_row, true, true},
      {"cell averages", On::particles, &mean_of_cell, false},
      {"mean of points", On::particles, &mean_of_all, false},
      {"segments", On::side, nullptr, false}};
    return all;
  }

  Choice<const Imposition *>
  imposition_choice()
  {
    Choice<const Imposition *>::Words words;
    for (const Imposition &one : impositions())
      words.emplace_back(one.word, &one);
    return words;
  }
} // namespace geocone
