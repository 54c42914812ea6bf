// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_point_h
#define geocone_element_element_point_h

#include <geocone/base/state_row.h>
#include <geocone/materials/constitutive_law.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Names of the six components of a symmetric tensor (Tensor6). */
  extern const std::array<const char *, 6> component_names;

  /** Frobenius norm of a symmetric tensor. Each shear component is included
   *  twice. */
  double
  norm(const Tensor6 &x);

  /**
   * Interface to a single material point, independent of its constitutive law.
   * Stresses and strains are positive in tension. Trial increments start from
   * the last accepted state, so that rejected trials have no effect.
   */
  class ElementPoint
  {
  public:
    virtual ~ElementPoint() = default;

    /** Returns true if a tensor component can be controlled. In plane
     *  strain, out-of-plane components cannot be controlled. */
    virtual bool
    has(const unsigned int component) const = 0;

    /** Computes the stress (Pa) after a trial strain increment. */
    virtual Tensor6
    try_strain(const Tensor6 &strain) = 0;

    /** Accepts the state of the last trial increment. */
    virtual void
    accept() = 0;

    /** Stress of the last accepted state (Pa). */
    virtual Tensor6
    stress() const = 0;

    /** Reference elastic modulus for scaling stresses to strains (Pa). */
    virtual double
    modulus() const = 0;

    /** @name Output quantities of the accepted state; names include the unit */
    /** @{ */
    virtual std::vector<std::string>
    names() const = 0;
    virtual std::vector<double>
    values() const = 0;
    /** @} */

    /** Computes plane sections of the yield surfaces at the accepted state. */
    virtual std::vector<YieldCurve>
    yield_curves(const SectionPlane &plane) const = 0;

    /** Saves the accepted state to a checkpoint, or restores it from one. */
    virtual void
    state(StateRow &row) = 0;

    /** Statistics of the constitutive updates in all accepted strain
     *  increments. */
    LawCounts counts;

  protected:
    LawCounts trial_counts; ///< statistics of the last trial
  };

  /** Stress components that a material point uses: in-plane components only, or
   *  all. */
  enum class StressComponents
  {
    automatic, ///< all, if supported by the law
    plane_strain,
    axisymmetric, ///< normal components and xy
    all
  };

  /**
   * Creates a material point with a constitutive law.
   * @param stress initial stress (Pa)
   * @param[out] changed remark on values changed by the initialisation, or
   * empty
   * @throws InputError if the law does not support the components or the stress
   */
  std::unique_ptr<ElementPoint>
  make_element_point(const ConstitutiveLaw &law,
                     const StressComponents components,
                     const Tensor6         &stress,
                     std::string           &changed);
} // namespace geocone::GEOCONE_DIM

#endif
