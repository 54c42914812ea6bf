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
   * state that was accepted, so that what is tried and rejected leaves nothing
   * behind.
   */
  class ElementPoint
  {
  public:
    virtual ~ElementPoint() = default;

    /** Whether a component can be controlled, and is not zero by plane strain. */
    virtual bool
    has(const unsigned int component) const = 0;

    /** The stress that a strain increment leads to (Pa). */
    virtual Tensor6
    try_strain(const Tensor6 &strain) = 0;

    /** Accepts the last trial. */
    virtual void
    accept() = 0;

    /** The stress of the last accepted state (Pa). */
    virtual Tensor6
    stress() const = 0;

    /** An elastic modulus, to scale strains by (Pa). */
    virtual double
    modulus() const = 0;

    /** @name What is shown of the accepted state, each name with its unit */
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

    /** Substeps and the like of all accepted trials. */
    LawCounts counts;

  protected:
    LawCounts trial_counts; ///< of the last trial
  };

  /** Which components a point has. */
  enum class StressComponents
  {
    automatic, ///< all if the law has them
    plane_strain,
    axisymmetric, ///< the normal ones and xy
    all
  };

  /**
   * A point of the law.
   * @param stress at the start (Pa)
   * @param[out] changed what initialisation had to change, or nothing
   * @throws InputError if the law has no such components or stress
   */
  std::unique_ptr<ElementPoint>
  make_element_point(const ConstitutiveLaw &law,
                     const StressComponents components,
                     const Tensor6         &stress,
                     std::string           &changed);
} // namespace geocone::GEOCONE_DIM

#endif
