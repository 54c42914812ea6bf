// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/newton/globalisation.h>
#include <geocone/newton/line_search.h>

#include <algorithm>

namespace geocone::GEOCONE_DIM
{
  NewtonLine::NewtonLine(const StepWorkspace &work, const LocalLaw &law)
    : direction(work.problem.make_vector())
    , work(work)
    , law(law)
    , start(work.problem.make_vector())
  {}

  void
  NewtonLine::move(const double x)
  {
    for (unsigned int i = 0; i < start.locally_owned_size(); ++i)
      work.v.local_element(i) =
        start.local_element(i) + x * direction.local_element(i);
    state = work.evaluate(law);
  }

  double
  Globalisation::blend(const double) const
  {
    return 0.;
  }

  double
  Globalisation::move(NewtonLine &line)
  {
    line.move(1.);
    return 1.;
  }

  double
  LineSearch::move(NewtonLine &line)
  {
    return line_search(line.slope(), [&](const double x) {
      line.move(x);
      return line.slope();
    });
  }

  double
  ElasticBlend::blend(const double residual) const
  {
    return std::min(0.5, factor * residual);
  }

  double
  MeritSearch::blend(const double) const
  {
    return damping;
  }

  double
  MeritSearch::move(NewtonLine &line)
  {
    const double before = line.merit();
    double       length = 1.;
    const auto   falls  = [&]() {
      line.move(length);
      return line.merit() <= (1. - 1e-4 * length) * before;
    };
    bool done = falls();
    for (unsigned int halvings = 0; !done && halvings < 8; ++halvings)
      {
        length /= 2.;
        done = falls();
      }
    if (!done)
      {
        length = 0.;
        line.move(length);
      }
    if (length < 0.05)
      damping = std::min(1., std::max(0.02, 3. * damping));
    else if (length > 0.4)
      damping = damping / 4. < 0.01 ? 0. : damping / 4.;
    return length;
  }
} // namespace geocone::GEOCONE_DIM
