// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_discretisation_method_h
#define geocone_discretisation_method_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace geocone
{
  /**
   * Where the continuum lives: at quadrature points of a mesh that fits the body
   * (finite element method), or at particles that move through a background
   * mesh (material point method).
   */
  class Method : public dealii::ParameterAcceptor
  {
  public:
    Method();

    /** @throws InputError for another name */
    void
    prepare();

    bool
    is_mpm() const
    {
      return name != "FEM";
    }

    /** Whether time is stepped explicitly. */
    bool
    is_explicit() const
    {
      return name == "explicit MPM";
    }

    std::string name = "FEM";
  };
} // namespace geocone

#endif
