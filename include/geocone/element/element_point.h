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
  /** Names of the components of a Tensor6. */
  extern const std::array<const char *, 6> component_names;

  /** Frobenius norm: shear components count twice. */
  double
  norm(const Tensor6 &x);

  /**
   * One material point of any law, tension positive. Trials start from the last
   * accepted state, so that rejected trials have no effect.
   */
  class ElementPoint
  {
  public:
    virtual ~ElementPoint() = default;

    /** Whether a component can be controlled, i.e. is not zero by plane
     *  strain. */
    virtual bool
    has(const unsigned int component) const = 0;

    /** Stress after a trial strain increment (Pa). */
    virtual Tensor6
    try_strain(const Tensor6 &strain) = 0;

    /** Accepts the last trial. */
    virtual void
    accept() = 0;

    /** Stress of the last accepted state (Pa). */
    virtual Tensor6
    stress() const = 0;

    /** An elastic modulus, for scaling strains (Pa). */
    virtual double
    modulus() const = 0;

    /** @name Output of the accepted state; names include the unit */
    /** @{ */
    virtual std::vector<std::string>
    names() const = 0;
    virtual std::vector<double>
    values() const = 0;
    /** @} */

    /** Sections of the yield surfaces of the accepted state. */
    virtual std::vector<YieldCurve>
    yield_curves(const SectionPlane &plane) const = 0;

    /** The accepted state, for a checkpoint. */
    virtual void
    state(StateRow &row) = 0;

    /** Statistics of all accepted trials, e.g. substeps. */
    LawCounts counts;

  protected:
    LawCounts trial_counts; ///< of the last trial
  };

  /** Components of a point. */
  enum class StressComponents
  {
    automatic, ///< all if the law has them
    plane_strain,
    axisymmetric, ///< the normal ones and xy
    all
  };

  /**
   * Creates a point of a law.
   * @param stress at the start (Pa)
   * @param[out] changed a note on values changed by the initialisation, or
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
