// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_friction_memory_h
#define geocone_materials_friction_memory_h

#include <geocone/base/types.h>
#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace geocone::GEOCONE_DIM
{
  /**
   * Friction with memory: a regularised friction law in which the strength
   * follows the normal stress with a delay (doc/theory/friction_memory.md). The
   * normal stress in the yield condition is delayed with the relaxation time
   * tau. A history variable p obeys dp/dt = (s_n - p)/tau, and an implicit step
   * h has
   *   p = lambda p_n + (1 - lambda) s_n,   lambda = tau/(h + tau).
   */
  class FrictionMemory
  {
  public:
    /** Constructor. @param text default value of the parameter: "automatic", or
     *  a time (s) */
    explicit FrictionMemory(const std::string &text = "automatic")
      : text(text)
    {}

    /** Name of the input parameter for the relaxation time of friction with
     *  memory. */
    static constexpr const char *entry = "Friction memory";

    /** Declares the parameter 'Friction memory'. */
    void
    declare(dealii::ParameterAcceptor &section);

    /** Reads the relaxation time from the input parameter. @param section
     *  section of the parameter
     *  @param is_useful whether friction exceeds dilatancy
     *  @throws InputError */
    void
    prepare(const dealii::ParameterAcceptor &section, const bool is_useful);

    /** Sets the relaxation time if the value of the input parameter is
     *  "automatic". */
    void
    set_automatic(const double time)
    {
      if (text == "automatic")
        tau = time;
    }

    /** Relaxation time tau of friction with memory (s); 0 for the exact
     *  friction law. */
    double
    time() const
    {
      return tau;
    }

    /** Weight lambda of the old delayed normal stress (at t_n) in the new
     *  delayed normal stress, for a step of size h (s). */
    double
    remembered(const double h) const
    {
      return tau > 0. ? tau / (h + tau) : 0.;
    }

    /** Delayed normal stress p (Pa) of friction with memory, at the end of a
     *  step of size h (s).
     *  @param s_n normal stress at the end of the step (Pa) */
    double
    next(const double p, const double s_n, const double h) const
    {
      const double part = remembered(h);
      return part * p + (1. - part) * s_n;
    }

    /** Returns true for strongly non-associated laws, for which the value
     *  "automatic" activates friction with memory. @param non_associativity (a
     *  - b)/a
     *  @param aperture_left sin(phi) - sin(theta) */
    static bool
    is_hard(const double non_associativity, const double aperture_left);

  private:
    std::string text;
    double      tau = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
