// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_stopwatch_h
#define geocone_base_stopwatch_h

#include <chrono>

namespace geocone
{
  /** Scoped timer: adds the wall time between construction and destruction
   *  to @p seconds. */
  class Stopwatch
  {
  public:
    explicit Stopwatch(double &seconds)
      : seconds(seconds)
      , start(std::chrono::steady_clock::now())
    {}
    ~Stopwatch()
    {
      seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
    }

  private:
    double                                     &seconds;
    const std::chrono::steady_clock::time_point start;
  };
} // namespace geocone

#endif
