// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_method_h
#define geocone_mesh_method_h

#include <geocone/base/choice.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace geocone
{
  /**
   * Discretisation method: finite element method (FEM) or material point method
   * (MPM). FEM uses quadrature points of a body-fitted mesh; in MPM, particles
   * move through a background mesh.
   */
  class Method : public dealii::ParameterAcceptor
  {
  public:
    Method();

    bool
    is_mpm() const
    {
      return kind != Kind::fem;
    }

    /** Returns true if the time integration is explicit. */
    bool
    is_explicit() const
    {
      return kind == Kind::explicit_mpm;
    }

    std::string
    name() const
    {
      return kind.word();
    }

  private:
    enum class Kind
    {
      fem,
      mpm,
      explicit_mpm,
      point
    };
    Choice<Kind> kind = {{{"FEM", Kind::fem},
                          {"MPM", Kind::mpm},
                          {"explicit MPM", Kind::explicit_mpm},
                          {"point", Kind::point}}};
  };
} // namespace geocone

#endif
