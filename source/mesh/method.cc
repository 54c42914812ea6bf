// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/method.h>

namespace geocone
{
  Method::Method()
    : dealii::ParameterAcceptor("/Discretisation")
  {
    kind.declare(*this,
                 "Method",
                 ". FEM: the mesh fits the body, its quadrature points carry "
                 "the material. MPM: particles carry it through a background "
                 "mesh, implicitly, with inertia. Explicit MPM: the same in "
                 "many small explicit steps, for fast flows and soils without "
                 "a closed form. Point: one material point that is led along "
                 "the section Path, without a scene.");
  }
} // namespace geocone
