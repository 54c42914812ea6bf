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
                  "mesh, implicitly, with inertia. explicit MPM: the same in "
                  "many small explicit steps, for fast flows and soils without "
                  "a closed form. point: one material point that is led along "
                  "the section Path, without a scene.");
  }

  void
  Method::prepare()
  {
    check_choice(
      "Discretisation/Method", name, {"FEM", "MPM", "explicit MPM", "point"});
  }
} // namespace geocone
