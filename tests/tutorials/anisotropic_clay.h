// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef tests_anisotropic_clay_h
#define tests_anisotropic_clay_h

#include <geocone/materials/material.h>

namespace geocone::GEOCONE_DIM
{
  /**
   * Undrained clay in plane strain whose strength depends on the direction of loading:
   *   |dev(s) - s_0| <= sqrt2 (s_A + s_P)/2,  s_0 = (s_A - s_P)/2 (1, -1, 0),
   * with s_A in vertical (active) and s_P in horizontal (passive) compression. This is
   * Tresca's circle about another centre (Davis and Christian 1971, with a circle instead
   * of an ellipse). Flow is associated and keeps the volume.
   */
  class AnisotropicClay : public Material
  {
  public:
    explicit AnisotropicClay(const std::string &section);

    /** @throws InputError unless both strengths are positive */
    void
    prepare() override;

    void
    update(const Increment &increment, const Response &response) const override;

    /** |dev(s) - s_0| less the radius (Pa). */
    std::optional<double>
    overstress(const Mandel &stress, const double *history) const override;

    /** Divides both strengths by F. */
    void
    reduce_strength(const double F) override;

    /** Steps are solved by the tangent of update(). */
    bool
    has_natural_map() const override
    {
      return false;
    }

  private:
    double active = 30e3, passive = 20e3; ///< parameters (Pa)
    double radius = 0.;                   ///< of the circle (Pa)
    Mandel centre;                        ///< s_0 (Pa)
  };
} // namespace geocone::GEOCONE_DIM

#endif
