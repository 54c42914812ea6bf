// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_element_element_point_h
#define geocone_element_element_point_h

#include <geocone/base/state_row.h>
#include <geocone/materials/constitutive_law.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace geocone
{
  /** Components xx, yy, zz, xy, yz, zx of a tensor (no Mandel factors). */
  using Tensor6 = std::array<double, 6>;

  /** Their names. */
  extern const std::array<const char *, 6> component_names;

  /** Frobenius norm: shear components count twice. */
  double
  norm(const Tensor6 &x);

  /** A named curve in the plane of p and q, for pictures (Pa). */
  struct Surface
  {
    std::string                            name;
    std::vector<std::pair<double, double>> p_and_q;
  };

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

    /**
     * Yield surfaces of the accepted state, cut by the plane of the hydrostatic
     * axis and the deviator of @p stress; p compression positive.
     * @param axis 0 to 2: q counts positive where this component is compressed
     * more than the others; else the deviator points to positive q
     * @param largest_p how far open surfaces are drawn (Pa)
     */
    virtual std::vector<Surface>
    surfaces(const Tensor6     &stress,
             const unsigned int axis,
             const double       largest_p) const = 0;

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
} // namespace geocone

#endif
