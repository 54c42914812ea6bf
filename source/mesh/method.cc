// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/mesh/method.h>

namespace geocone
{
  Method::Method()
    : dealii::ParameterAcceptor("/Discretisation")
  {
    kind.declare(
      *this,
      "Method",
      ". FEM: implicit finite elements on a mesh that fits the body. MPM: "
      "implicit material point method with inertia; particles move through a "
      "background mesh. Explicit MPM: many small explicit steps, for fast "
      "flows and for laws without a closed-form return map. Point: a single "
      "material point, loaded along the section Path, without a scene.");
  }
} // namespace geocone
