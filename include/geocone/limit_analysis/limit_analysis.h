// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_limit_analysis_h
#define geocone_limit_analysis_limit_analysis_h

#include <geocone/bounds/bound_analysis.h>
#include <geocone/limit_analysis/bounded_load.h>
#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/limit_analysis/gradients.h>
#include <geocone/limit_analysis/interval_bounds.h>
#include <geocone/limit_analysis/strength_reduction.h>
#include <geocone/mesh/domain_of_triangles.h>
#include <geocone/plane_bounds/bar_cells.h>

#include <deal.II/base/bounding_box.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Type of the analysis performed for a scene. */
  enum class AnalysisKind
  {
    steps,              ///< incremental analysis
    limit_load,         ///< strict bounds on the limit load
    strength_reduction, ///< strict bounds on the factor of safety
    reliability,        ///< probability of failure
    shakedown,          ///< shakedown under loads that vary
    seepage             ///< steady seepage alone
  };

  /**
   * Plane or axisymmetric limit analysis of a rigid-plastic scene with associated flow. Strict
   * bounds on the limit load or the factor of safety are computed on meshes
   * that are adaptively refined where the bounds differ. Each level is a step
   * of the run.
   */
  class LimitAnalysis : public BoundAnalysis
  {
  public:
    LimitAnalysis(const MPI_Comm comm, const ParameterFile &file, Log &log);

    AnalysisKind
    kind() const
    {
      return analysis;
    }

  private:
    /** Returns warnings about magnitudes of parameters, about a mesh file that
     *  cannot be refined, and about obstacle loads that are zero at t = 0. */
    std::vector<std::string>
    warnings_of(const dealii::BoundingBox<dim> &body) const;

    /** Checks that the water table coincides with sides of the cells.
     *  @throws InputError if the water table cuts cells of the first mesh */
    void
    check_water() const;

    bool
    reduces_strength() const override
    {
      return analysis == AnalysisKind::strength_reduction;
    }

    bool
    is_possible_around_axis() const override
    {
      return true;
    }

    bool
    is_possible_with_structures() const override
    {
      return true;
    }

    static Side
    figures_of(const CertifiedSide &side);

    /** Returns both bounds computed on the current mesh, converted to loads, as
     *  the results of a refinement level.
     *  @param unit load that corresponds to the load factor 1 of a problem */
    BoundLevel
    level_of(const double unit) const;

    /** Computes both bounds on the load for the current mesh.
     *  @throws StepFailure if there is no bound */
    BoundLevel
    bound_load();

    /** Computes both bounds on the factor of safety for the current mesh.
     *  @throws StepFailure if there is no bound */
    BoundLevel
    bound_factor();

    bool
    refines() const override
    {
      return scene.geometry.shape != Geometry::Shape::file ||
             file_domain->obstacle().empty();
    }

    /** Generates the next mesh with the cell sizes and fans from the refinement. */
    CoarseMesh
    next_mesh() const;

    /** Selects the cell sizes and fans of the next mesh.
     *  @param level results on the current mesh */
    void
    refine(const BoundLevel &level);

    /** Returns the number of cells requested for the next mesh. */
    double
    next_cells(const BoundLevel &level);

    /** Warns of tractions that are not linear between the vertices. */
    void
    warn_of_tractions() const;

    /** Computes Davis's estimates for non-associated flow on the finest mesh. They are
     *  both bounds on the load or factor of safety for each variant
     *  (LoadBracket::davis). */
    std::vector<std::array<double, 2>>
    estimates_by_davis() const;

    /** Computes, on the current mesh, the gradients of both bounds. */
    std::vector<Gradient>
    gradients_of_last() const;

    /** Bounds the load or factor of safety for all parameters of the intervals, on the
     *  current mesh. */
    IntervalBounds::Answer
    bounds_of_intervals() const;

    /** Returns the forces of the lower bound and the rates of the upper bound along all
     *  structures, on the current mesh. */
    std::vector<BarPoint>
    points_of_structures() const;

    /** Returns the lower and upper bounds on the load certified so far, with
     *  Davis's estimate. */
    LoadBracket
    bracket() const override;

    std::string
    kind_word() const override
    {
      return analysis.word();
    }
    const LoadChoice &
    load_choice() const override
    {
      return bounded_load;
    }
    void
    prepare_water(const RunOptions &options) override;
    /** @throws InputError for what bounds around an axis do not know */
    void
    check_axis() const;
    Json
    results() const override;

    std::vector<std::string>
    prepare(const RunOptions &options) override;
    Json
    model() override;
    StepOutcome
    advance(TimePoint &now) override;
    void
    write_fields(const double t) override;
    Json
    topics() override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override;

    BoundedLoad       bounded_load;
    StrengthReduction reduction;
    IntervalBounds    intervals;

    Choice<AnalysisKind> analysis = {
      {{"steps", AnalysisKind::steps},
       {"limit load", AnalysisKind::limit_load},
       {"strength reduction", AnalysisKind::strength_reduction},
       {"reliability", AnalysisKind::reliability},
       {"shakedown", AnalysisKind::shakedown},
       {"seepage", AnalysisKind::seepage}}};

    /** Parameters of materials that are set although laws around an axis do not know
     *  them: path, value, value without effect, and remedy. */
    std::vector<std::array<std::string, 4>> of_plane_laws;

    std::optional<CellSizes> sizes; ///< cell sizes and fans of the next mesh

    /** Domain of a mesh that was read from a file; empty if the domain cannot
     *  be remeshed. */
    std::optional<DomainOfTriangles> file_domain;

    double asked_cells = 0.; ///< requested; 0 for the first mesh

    std::vector<std::array<double, 2>> davis; ///< estimates_by_davis()

    /** @name Results of the last level */
    /** @{ */
    std::optional<Triangles> triangles;
    CertifiedBounds          bounds;
    StrengthReduction::Level reduced; ///< strength reduction only
    std::vector<Gradient>    gradients;
    IntervalBounds::Answer   of_intervals;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
