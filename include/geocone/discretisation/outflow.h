// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_outflow_h
#define geocone_discretisation_outflow_h

#include <geocone/base/exceptions.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace geocone
{
  /** What becomes of particles that leave the background mesh. */
  class Outflow : public dealii::ParameterAcceptor
  {
  public:
    Outflow()
      : dealii::ParameterAcceptor("/Particles")
    {
      add_parameter("Outflow",
                    name,
                    "What a particle does that leaves the background mesh: "
                    "error (ends the run and names it) | count (it is removed "
                    "and counted).");
    }

    /** @throws InputError for another name */
    void
    prepare() const
    {
      if (name != "error" && name != "count")
        throw InputError(
          "Particles/Outflow", name, "error | count", "choose one of them");
    }

    bool
    is_error() const
    {
      return name == "error";
    }

  private:
    std::string name = "error";
  };
} // namespace geocone

#endif
