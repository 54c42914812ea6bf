// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_bounds_bound_analysis_h
#define geocone_bounds_bound_analysis_h

#include <geocone/bounds/certificate_claim.h>
#include <geocone/bounds/limit_output.h>
#include <geocone/bounds/load_choice.h>
#include <geocone/bounds/safety_search.h>
#include <geocone/mesh/mesh_parameters.h>
#include <geocone/run/simulation.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Base class of limit analyses in two and three dimensions, with parameters, checks and
   * reports. Strict bounds are computed for a rigid-plastic scene with associated flow.
   * Each mesh is a step of the run.
   */
  class BoundAnalysis : public Simulation, public dealii::ParameterAcceptor
  {
  public:
    OutputBase &
    output() override
    {
      return limit_output;
    }

  protected:
    BoundAnalysis(const MPI_Comm comm, const ParameterFile &file, Log &log);

    /** Declares the parameters of the loads, the meshes and the accuracy. */
    void
    declare_parameters(LoadChoice &load);

    /** Checks the parameters of the analysis. @throws InputError for parameters out of
     *  range, several ranks, and particles */
    void
    check_parameters() const;

    /** Prepares the scene and checks that strict bounds can be computed.
     *  @throws InputError if they cannot */
    void
    prepare_scene(const RunOptions &options);

    /** Prints characteristic magnitudes of the scene and, in a dry run, the numbers of
     *  cells.
     *  @param n_cells of the first mesh @param more text appended to the numbers of
     *  cells */
    void
    print_start(const RunOptions               &options,
                const std::size_t               n_cells,
                const std::string              &more,
                const dealii::BoundingBox<dim> &body) const;

    /** Returns the tolerance of the interior-point method, relative to the load,
     *  that does not limit the gap. */
    double
    inner_tolerance() const
    {
      return std::min(tolerance, gap_tolerance / 10.);
    }

    /** Returns the parameter and value that select the analysis, for messages:
     *  "'Analysis/Kind' = limit load". */
    std::string
    where() const
    {
      return "'Analysis/Kind' = " + kind_word();
    }

    /** Upper or lower bound computed on a mesh, with its certificate and the
     *  computational cost. */
    struct Side
    {
      double             load; ///< bound on the load, in scaled units
      bool               certified;
      const std::string &rejection; ///< reason for rejection, if not certified
      bool               converged;
      const std::string &reason; ///< cause of non-convergence
      unsigned int       factorisations, n_unknowns;
      double             violation, error;
    };

    /** Prints the reasons why a bound is not certified or has not converged. */
    void
    print_reasons(const Side &upper, const Side &lower) const;

    /** Returns both bounds computed on a mesh, converted to loads, as the
     *  results of a refinement level.
     *  @param unit load that corresponds to the load factor 1 of a problem */
    static BoundLevel
    level_of(const Side        &upper,
             const Side        &lower,
             const unsigned int n_cells,
             const double       unit);

    /** Replaces the bounds on the load of a level by those on the factor of
     *  safety. */
    static void
    set_factor(BoundLevel &level, const SafetySearch::Level &found);

    /** Adds the name, the unit and the flow rule of the analysis to a
     *  bracket. */
    LoadBracket
    described(LoadBracket bracket) const;

    /** Checks that the sum of the two bounds is finite.
     *  @param bounds sum of both bounds on the load @throws StepFailure if the sum is not
     *  finite */
    static void
    check_finite(const double bounds);

    /** Appends the results of a mesh to the table of refinement levels.
     *  @param[in,out] now the time is set to the number of meshes */
    void
    add_level(BoundLevel level, TimePoint &now);

    /** Calls a function for each bound of a level that is the best one so far, if
     *  certificates are to be written. @param best of all levels */
    void
    for_each_claim(
      const BoundLevel                                    &level,
      const LoadBracket                                   &best,
      const std::function<void(const CertificateClaim &)> &write) const;

    /** Returns the largest lower bound and the smallest upper bound on the load
     *  that have been certified on any mesh. If water pressures differ between
     *  meshes, the bracket of the last mesh with both bounds is returned. */
    LoadBracket
    certified_by(const std::vector<BoundLevel> &levels) const;

    /** Returns true if no further mesh is required. @param gap certified so far */
    bool
    is_complete(const std::optional<double> &gap) const;

    /** Returns true if no further mesh is allowed. @param n_cells,number of the mesh */
    bool
    is_last_mesh(const unsigned int n_cells, const unsigned int number) const
    {
      return growth * n_cells > 1.15 * most_cells || number == programme()[0];
    }

    /** Prepares the stages whose flow problems determine the pore pressures.
     *  @throws InputError if 'Seepage/Time' is not in them */
    void
    prepare_flow();

    /** Prepares the parameters of a mesh of triangles. @throws InputError for
     *  quadrilaterals */
    void
    prepare_triangles();

    /** Value of a bound as text, "?" if it is not certified. */
    static std::string
    shown_bound(const double value, const bool certified);

    /** Prints the lower and upper bounds on the load, and warns if they are not
     *  certified or too far apart. */
    void
    conclude(const LoadBracket &best,
             const std::string &rejection_upper,
             const std::string &rejection_lower) const;

    /** @name Properties of the analysis */
    /** @{ */
    virtual std::string
    kind_word() const = 0;
    virtual const LoadChoice &
    load_choice() const = 0;
    /** Computes the pore water pressures by a seepage analysis. Pore water is
     *  rejected if the bounds do not support it. Called after the materials and
     *  before the loads are prepared. */
    virtual void
    prepare_water(const RunOptions &options) = 0;
    /** Returns true if finer meshes than the first mesh can be generated. */
    virtual bool
    refines() const = 0;
    /** Returns true if the analysis can compute the bounds of axisymmetric
     *  bodies. */
    virtual bool
    is_possible_around_axis() const
    {
      return false;
    }
    /** Returns true if the analysis can bound scenes with structures. */
    virtual bool
    is_possible_with_structures() const
    {
      return false;
    }
    /** Returns true if the analysis can run on several MPI ranks. */
    virtual bool
    runs_on_ranks() const
    {
      return false;
    }
    /** Returns the lower and upper bounds on the load certified so far. */
    virtual LoadBracket
    bracket() const = 0;
    /** True if the bounded quantity is the factor of safety, false if it is a
     *  load. */
    virtual bool
    reduces_strength() const = 0;
    /** Sections of the summary that are specific to the analysis, between size
     *  and cost. */
    virtual Json
    results() const;
    /** @} */

    /** Name of the bounded quantity (load or factor of safety) in messages. */
    std::string
    bounded() const
    {
      return reduces_strength() ? "factor of safety" : "load";
    }

    std::vector<unsigned int>
    programme() const override;
    void
    prepare_output(const RunOptions &options) override;
    std::string
    headline(const std::string &name) const override;
    void
    begin(const TimePoint &) override
    {}
    void
    record(const TimePoint &now) override;
    std::string
    progress(const TimePoint &) const override
    {
      return "";
    }
    Json
    topics() override;

    Scene          scene;
    Method         method;
    MeshParameters mesh_parameters;
    LimitOutput    limit_output;

    double       tolerance     = 1e-3; ///< of the interior-point method
    double       gap_tolerance = 0.01;
    double       growth        = 2.;
    unsigned int most_cells    = 20000;
    unsigned int most_levels   = 12;
  };
} // namespace geocone::GEOCONE_DIM

#endif
