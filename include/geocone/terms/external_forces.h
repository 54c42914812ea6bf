// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_external_forces_h
#define geocone_terms_external_forces_h

#include <geocone/terms/term.h>

namespace geocone::GEOCONE_DIM
{
  /** Term -F of the residual, with the external forces F due to self-weight and
   *  surface tractions. */
  class ExternalForces : public Term
  {
  public:
    /** Sets the external forces of a step.
     *  @param forces F at the end of the step, or null for none */
    void
    begin_step(const Vector *forces)
    {
      force = forces;
    }

    void
    residual(Vector &part, const Vector &, const LocalLaw &) override
    {
      part = 0.;
      if (force != nullptr)
        part.add(-1., *force);
    }

    /** Nodal forces F (N/m), or null for none. */
    const Vector *
    vector() const
    {
      return force;
    }

  private:
    const Vector *force = nullptr;
  };
} // namespace geocone::GEOCONE_DIM

#endif
