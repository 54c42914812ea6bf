// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_linear_elastic_h
#define geocone_materials_linear_elastic_h

#include <geocone/materials/material.h>

namespace geocone
{
  /** Isotropic linear elasticity, s = s_n + D e. No parameters of its own. */
  class LinearElastic : public Material
  {
  public:
    using Material::Material;

    void
    update(const Increment &increment, const Response &response) const override;

    /** By the kernel of the cones, with one that is never reached. */
    void
    advance(const PointBlock &block, LawCounts &counts) const override;
  };
} // namespace geocone

#endif
