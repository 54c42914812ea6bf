// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_bound_analysis_h
#define geocone_limit_analysis_bound_analysis_h

#include <geocone/limit_analysis/limit_output.h>
#include <geocone/limit_analysis/load_choice.h>
#include <geocone/mesh/mesh_parameters.h>
#include <geocone/run/simulation.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Run of strict bounds of a rigid-plastic scene with associated flow, in the plane or in
   * three dimensions: parameters, checks and reports. Each mesh is a step of the run.
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

    /** Declares the parameters of loads, meshes and accuracy. */
    void
    declare_parameters(LoadChoice &load);

    /** Checks the parameters. @throws InputError for parameters out of range, several
     *  ranks, and particles */
    void
    check_parameters() const;

    /** Prepares the scene and checks that it admits strict bounds.
     *  @throws InputError if it does not */
    void
    prepare_scene(const RunOptions &options);

    /** Prints the dry run's size of the meshes, and magnitudes of the scene.
     *  @param n_cells of the first mesh @param more appended to the size */
    void
    print_start(const RunOptions               &options,
                const std::size_t               n_cells,
                const std::string              &more,
                const dealii::BoundingBox<dim> &body) const;

    /** Tolerance of the interior-point method, relative to the load. */
    double
    inner_tolerance() const
    {
      return std::min(tolerance, gap_tolerance / 10.);
    }

    /** Text of the analysis in messages, "'Analysis/Kind' = limit load". */
    std::string
    where() const
    {
      return "'Analysis/Kind' = " + kind_word();
    }

    /** One of the two bounds on a mesh. */
    struct Side
    {
      double             load; ///< in units of a problem
      bool               certified;
      const std::string &rejection; ///< reason for rejection, if not certified
      bool               converged;
      const std::string &reason; ///< why it did not converge
      unsigned int       factorisations, n_unknowns;
      double             violation, error;
    };

    /** Prints why a bound may be sharper or is not certified. */
    void
    print_reasons(const Side &upper, const Side &lower) const;

    /** Collects both bounds on a mesh. @param unit load that a problem's 1 corresponds to */
    static BoundLevel
    level_of(const Side        &upper,
             const Side        &lower,
             const unsigned int n_cells,
             const double       unit);

    /** @param bounds a sum of bounds of a load. @throws StepFailure if it is not finite */
    static void
    check_finite(const double bounds);

    /** Adds a mesh to the results. @param[in,out] now its time is the number of meshes */
    void
    add_level(BoundLevel level, TimePoint &now);

    /** Whether the last mesh is the final one. @param gap certified so far */
    bool
    is_complete(const std::optional<double> &gap) const;

    /** Warns of bounds that are not certified or too far apart, and prints the bracket. */
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
    /** Checks or computes water pressures, after the materials and before the loads. */
    virtual void
    prepare_water(const RunOptions &options) = 0;
    /** Whether meshes other than the first can be generated. */
    virtual bool
    refines() const = 0;
    /** Bracket certified so far. */
    virtual LoadBracket
    bracket() const = 0;
    /** Topics of the summary between the size and the cost. */
    virtual Json
    results() const;
    /** Name of the bounded quantity in messages. */
    virtual std::string
    bounded() const
    {
      return "load";
    }
    /** @} */

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

    double       gap_tolerance = 0.01;
    double       growth        = 2.;
    unsigned int most_cells    = 20000;
    unsigned int most_levels   = 12;

  private:
    double tolerance = 1e-3;
  };
} // namespace geocone::GEOCONE_DIM

#endif
