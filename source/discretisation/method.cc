// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/discretisation/method.h>

namespace geocone
{
  Method::Method()
    : dealii::ParameterAcceptor("/Discretisation")
  {
    add_parameter("Method",
                  name,
                  "FEM: the mesh fits the body, its quadrature points carry "
                  "the material. MPM: particles carry it through a background "
                  "mesh, implicitly, with inertia.");
  }

  void
  Method::prepare()
  {
    if (name != "FEM" && name != "MPM")
      throw InputError(
        "Discretisation/Method", name, "FEM | MPM", "choose one of them");
  }
} // namespace geocone
