// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_problem_ghost_stiffness_h
#define geocone_problem_ghost_stiffness_h

#include <geocone/problem/term.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Three adjacent functions of a row or a column of splines, the last of
   *  which has very little material in its support. */
  struct GhostStencil
  {
    std::array<unsigned int, 3> node;        ///< local
    std::array<double, 3>       coefficient; ///< c
    double                      stiffness;   ///< k (Pa)
  };

  /**
   * Viscous force that couples low-mass functions to their neighbours. A
   * function reached only by the tail of a few particles has almost no mass and
   * stiffness: a load on it causes velocities a thousand times those around, at
   * no cost (spurious velocities). With its two neighbours towards the
   * material, at Greville abscissae x0, x1, and x2 its own,
   *   g = v2 - (1 + a) v1 + a v0 = c.v,   a = (x2 - x1)/(x1 - x0),
   * which is zero for linear fields. Force and work in a step h are
   *   R += k h c g,   k = gamma E (1 - fill/0.2),   W = h^2 sum k g^2 >= 0.
   * It has no memory. Forces and moments of a stencil are self-equilibrated, so
   * that the reactions of supports remain equal to the load.
   */
  class GhostStiffness : public Term
  {
  public:
    GhostStiffness(std::vector<GhostStencil> stencils,
                   const Unknowns           &unknowns);

    void
    begin_step(const double step)
    {
      h = step;
    }

    void
    residual(Vector &part, const Vector &v, const LocalLaw &law) override;

    void
    linearise(const JacobianPattern &pattern,
              const double           elastic_blend,
              SparseMatrix          &matrix) const override;

    void
    apply_tangent(Vector &dst, const Vector &dv) const override;

    void
    add_elastic_diagonal(Vector &dst) const override;

    /** W of a step with the velocities v (J/m), of all ranks. Collective. */
    double
    work(const Vector &v) const;

    const std::vector<GhostStencil> &
    stencils() const
    {
      return all;
    }

    std::vector<std::vector<unsigned int>>
    node_groups() const override;

  private:
    /** g of a stencil along a component. */
    static double
    bend(const GhostStencil &stencil,
         const Vector       &v,
         const unsigned int  component);

    /** Computes part += k h c g(v), including ghosts. */
    void
    add_forces(Vector &part, const Vector &v) const;

    const std::vector<GhostStencil> all;
    const Unknowns                 &unknowns;
    double                          h = 0.;
  };

  /**
   * Candidates for ghost stiffness in a space of splines: all triples of
   * adjacent functions, each on the rank of one cell in the support of all
   * three.
   */
  class GhostPlaces
  {
  public:
    GhostPlaces(const BackgroundMesh &mesh, const Space &space);

    /** Fill below which a function is low-mass. */
    static constexpr double least_fill = 0.2;

    /** Fill sum_p V_p N_i(x_p)/int N_i of a local node.
     *  @param volume see stencils() */
    double
    fill(const Vector &volume, const unsigned int node) const
    {
      return volume.local_element(dim * node) / integral[node];
    }

    /**
     * Stencils of the low-mass functions with mass, in all directions in which
     * their neighbours have a larger fill.
     * @param volume at the dofs of each node sum_p V_p N_i (m^2) and sum_p V_p
     * E_p N_i (N), with ghosts
     * @param is_wanted by local node; empty: all
     * @param gamma of the stiffness
     */
    std::vector<GhostStencil>
    stencils(const Vector            &volume,
             const Unknowns          &unknowns,
             const std::vector<bool> &is_wanted,
             const double             gamma) const;

    /** Number of low-mass functions with mass, of all ranks. Collective. */
    unsigned int
    n_light(const Vector &volume, const Unknowns &unknowns) const;

  private:
    struct Triple
    {
      std::array<unsigned int, 3> node;
      double                      a;
    };
    std::vector<Triple> triples;
    std::vector<double> integral; ///< int N_i (m^2), by local node
    unsigned int        n_owned = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
