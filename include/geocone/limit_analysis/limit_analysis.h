// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_limit_analysis_h
#define geocone_limit_analysis_limit_analysis_h

#include <geocone/limit_analysis/bounded_load.h>
#include <geocone/limit_analysis/certified_bounds.h>
#include <geocone/limit_analysis/gradients.h>
#include <geocone/limit_analysis/limit_output.h>
#include <geocone/limit_analysis/strength_reduction.h>
#include <geocone/mesh/domain_of_triangles.h>
#include <geocone/run/simulation.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Kind of analysis of a scene. */
  enum class AnalysisKind
  {
    steps,             ///< motion, step by step
    limit_load,        ///< strict bounds of the limit load
    strength_reduction, ///< strict bounds of the factor of safety
    seepage             ///< steady flow of water alone
  };

  /**
   * Limit analysis of a rigid-plastic scene with associated flow: strict bounds of the
   * limit load, or of the factor of safety, on meshes refined adaptively where the
   * bounds differ. Each level is a step of the run.
   */
  class LimitAnalysis : public Simulation, public dealii::ParameterAcceptor
  {
  public:
    LimitAnalysis(const MPI_Comm comm, const ParameterFile &file, Log &log);

    OutputBase &
    output() override
    {
      return limit_output;
    }

    AnalysisKind
    kind() const
    {
      return analysis;
    }

  private:
    /** Tolerance of the interior-point method. */
    double
    inner_tolerance() const
    {
      return std::min(tolerance, gap_tolerance / 10.);
    }

    /** @throws InputError for parameters out of range, several ranks and particles */
    void
    check_parameters() const;

    /** Checks the scene, and that it admits strict bounds. @throws InputError */
    void
    prepare_scene(const RunOptions &options);

    /** Warnings about the magnitudes of the scene, a fixed mesh and
     *  time-dependent loads. */
    std::vector<std::string>
    warnings_of(const dealii::BoundingBox<dim> &body) const;

    /** @throws InputError if the water table cuts cells of the first mesh */
    void
    check_water() const;

    /** Whether the factor of safety is bounded instead of a load. */
    bool
    reduces_strength() const
    {
      return analysis == AnalysisKind::strength_reduction;
    }

    /** Name of the bounded quantity, for messages. */
    std::string
    bounded() const
    {
      return reduces_strength() ? "factor of safety" : "load";
    }

    /** Bounds the load on the present mesh. @throws StepFailure if there is no bound */
    BoundLevel
    bound_load();

    /** Bounds the factor of safety on the present mesh. @throws StepFailure if
     *  there is no bound */
    BoundLevel
    bound_factor();

    /** Whether other meshes than the first one can be made. */
    bool
    refines() const
    {
      return scene.geometry.shape != Geometry::Shape::file ||
             file_domain->obstacle().empty();
    }

    /** Mesh with the sizes of the next one. */
    CoarseMesh
    next_mesh() const;

    /** Number of cells requested of the next mesh. */
    double
    next_cells(const BoundLevel &level);

    /** Davis's estimates for non-associated flow: both bounds of the bounded quantity on
     *  the last mesh (LoadBracket::davis). */
    std::vector<std::array<double, 2>>
    estimates_by_davis() const;

    /** The bracket certified by all meshes, or, if water pressures differ
     *  between the meshes, by the last one with both bounds. */
    LoadBracket
    certified_by(const std::vector<BoundLevel> &levels) const;

    /** Gradients of both bounds of the last mesh. */
    std::vector<Gradient>
    gradients_of_last() const;

    /** The bracket certified so far, with that estimate. */
    LoadBracket
    bracket() const;

    std::vector<std::string>
    prepare(const RunOptions &options) override;
    std::vector<unsigned int>
    programme() const override;
    void
    prepare_output(const RunOptions &options) override;
    std::string
    headline(const std::string &name) const override;
    Json
    model() override;
    void
    begin(const Place &) override
    {}
    Ended
    advance(Place &place) override;
    void
    record(const Place &place) override;
    std::string
    progress(const Place &place) const override;
    void
    write_fields(const double t) override;
    Json
    topics() override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override;

    Scene             scene;
    Method            method;
    MeshParameters    mesh_parameters;
    LimitOutput       limit_output;
    BoundedLoad       bounded_load;
    StrengthReduction reduction;

    Choice<AnalysisKind> analysis = {
      {{"steps", AnalysisKind::steps},
       {"limit load", AnalysisKind::limit_load},
       {"strength reduction", AnalysisKind::strength_reduction},
       {"seepage", AnalysisKind::seepage}}};
    double       gap_tolerance = 0.01;
    double       growth        = 2.;
    unsigned int most_cells    = 20000;
    unsigned int most_levels   = 12;
    double       tolerance     = 1e-3;

    std::optional<CellSizes> sizes; ///< of the next mesh

    /** Of the mesh of a file, if others can be made of it. */
    std::optional<DomainOfTriangles> file_domain;

    double asked_cells = 0.;        ///< requested of it, or 0 for the first one

    std::vector<std::array<double, 2>> davis; ///< of the last mesh

    /** @name Last level */
    /** @{ */
    std::optional<Triangles> triangles;
    CertifiedBounds          bounds;
    StrengthReduction::Level reduced; ///< of a strength reduction
    std::vector<Gradient>    gradients;
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
