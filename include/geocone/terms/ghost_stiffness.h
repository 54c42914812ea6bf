// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_terms_ghost_stiffness_h
#define geocone_terms_ghost_stiffness_h

#include <geocone/terms/term.h>

#include <array>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Stencil of three adjacent spline basis functions along a grid direction.
   *  The support of the last basis function contains very little material. */
  struct GhostStencil
  {
    std::array<unsigned int, 3> node;        ///< local node numbers
    std::array<double, 3>       coefficient; ///< c of GhostStiffness
    double                      stiffness;   ///< k of GhostStiffness (Pa)
  };

  /**
   * Ghost stiffness: viscous force that couples low-mass basis functions to
   * adjacent basis functions. A basis function whose support contains only a
   * few particles near its boundary has almost no mass and stiffness: a load on
   * it causes spurious velocities, a thousand times larger than in the
   * surroundings. With x2 the Greville abscissa of the low-mass function, and
   * x0, x1 those of the next two functions towards the material, the stiffness
   * acts on
   *   g = v2 - (1 + a) v1 + a v0 = c.v,   a = (x2 - x1)/(x1 - x0),
   * which is zero for linear fields. Force and work in a step h are
   *   R += k h c g,   k = gamma E (1 - fill/0.2),   W = h^2 sum k g^2 >= 0.
   * The force has no memory. Forces and moments of a stencil are self-equilibrated, so
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

    /** Work of the ghost stiffness forces in a step with the velocities v
     *  (J/m). Collective. */
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
    /** Weighted velocity difference g = c.v of the three nodes of a stencil,
     *  for one velocity component. */
    static double
    bend(const GhostStencil &stencil,
         const Vector       &v,
         const unsigned int  component);

    /** Adds the ghost stiffness forces k h c g(v) of all stencils to @p part,
     *  including entries of ghost dofs. */
    void
    add_forces(Vector &part, const Vector &v) const;

    const std::vector<GhostStencil> all;
    const Unknowns                 &unknowns;
    double                          h = 0.;
  };

  /**
   * Candidate stencils for the ghost stiffness of a spline space. They are all triples
   * of adjacent basis functions, each on the rank that owns a cell in the common
   * support.
   */
  class GhostPlaces
  {
  public:
    GhostPlaces(const BackgroundMesh &mesh, const Space &space);

    /** Fraction of the support filled with material (see fill()) below which a
     *  basis function is low-mass and receives ghost stiffness. */
    static constexpr double least_fill = 0.2;

    /** Fraction of the support of a basis function that contains material, sum_p V_p
     *  N_i(x_p)/int N_i.
     *  @param volume see stencils() */
    double
    fill(const Vector &volume, const unsigned int node) const
    {
      return volume.local_element(dim * node) / integral[node];
    }

    /**
     * Stencils of the ghost stiffness for all low-mass basis functions with
     * nonzero mass. They exist in each direction in which the adjacent
     * functions have a larger fill.
     * @param volume at the dofs of each node sum_p V_p N_i (m^2) and sum_p V_p
     * E_p N_i (N), with ghosts
     * @param is_wanted selected nodes, by local node; empty: all
     * @param gamma factor of the stiffness k
     */
    std::vector<GhostStencil>
    stencils(const Vector            &volume,
             const Unknowns          &unknowns,
             const std::vector<bool> &is_wanted,
             const double             gamma) const;

    /** Number of low-mass basis functions (little material in the support) with
     *  nonzero mass, summed over all ranks. Collective. */
    unsigned int
    n_light(const Vector &volume, const Unknowns &unknowns) const;

  private:
    struct Triple
    {
      std::array<unsigned int, 3> node;
      double                      a;
    };
    std::vector<Triple> triples;
    std::vector<double> integral; ///< integral of N_i, by local node (m^2)
    unsigned int        n_owned = 0;
  };
} // namespace geocone::GEOCONE_DIM

#endif
