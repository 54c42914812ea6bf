// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_points_outflow_h
#define geocone_points_outflow_h

#include <geocone/base/choice.h>

#include <deal.II/base/parameter_acceptor.h>

namespace geocone
{
  /** Treatment of particles that leave the background mesh: error or
   *  removal. */
  class Outflow : public dealii::ParameterAcceptor
  {
  public:
    Outflow()
      : dealii::ParameterAcceptor("/Particles")
    {
      kind.declare(
        *this,
        "Outflow",
        ": treatment of a particle that leaves the background mesh. Error: the "
        "run terminates with an error that identifies it. Count: it is removed "
        "and counted.");
    }

    bool
    is_error() const
    {
      return kind == Kind::error;
    }

  private:
    enum class Kind
    {
      error,
      count
    };
    Choice<Kind> kind = {{{"error", Kind::error}, {"count", Kind::count}}};
  };
} // namespace geocone

#endif
