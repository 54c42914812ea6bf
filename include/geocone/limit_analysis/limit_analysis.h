// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_limit_analysis_h
#define geocone_limit_analysis_limit_analysis_h

#include <geocone/discretisation/fitted_mesh.h>
#include <geocone/limit_analysis/limit_output.h>
#include <geocone/run/simulation.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone
{
  /** What is computed of a scene. */
  enum class AnalysisKind
  {
    steps,     ///< its motion, step by step
    limit_load ///< strict bounds of its limit load
  };

  /**
   * The limit load of a rigid-plastic scene with associated flow, between strict
   * bounds, on meshes that are made anew where the bounds differ: a level is a
   * step of the run.
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
    std::vector<std::string>
    prepare(const RunOptions &options) override;
    std::vector<unsigned int>
    programme() const override;
    void
    prepare_output(const RunOptions &options) override;
    std::string
    headline(const std::string &name) const override;
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
    void
    write_summary(const std::string &status) override;
    void
    finish(const double t) override;
    void
    save(Archive &archive) override;
    void
    load(const Archive &archive) override;

    /** The strengths of the materials. @throws InputError for laws without */
    void
    take_cones();

    /** What the load factor multiplies, and the velocity of the loaded part.
     *  @throws InputError if there is nothing to be bounded, or too much */
    void
    choose_factor();

    void
    choose_units();

    /** @throws InputError if a rigid motion of the body is free */
    void
    check_supports(const BoundProblem &problem) const;

    BoundSolution
    solve_upper(const BoundProblem &problem) const;
    BoundSolution
    solve_lower(const BoundProblem &problem) const;

    /** Solves both problems of a mesh. */
    BoundLevel
    solve(const Triangles &triangles);

    /** Sizes for the next mesh, by the parts of the cells in the gap. */
    CellSizes
    next_sizes() const;

    /** Both bounds for the strength of Davis (1968) on the last mesh. */
    Json
    davis_estimate() const;

    BoundScene
    bound_scene(const Triangles &triangles) const;

    Scene          scene;
    Method         method;
    MeshParameters mesh_parameters;
    LimitOutput    limit_output;

    Choice<AnalysisKind> analysis = {
      {{"steps", AnalysisKind::steps},
       {"limit load", AnalysisKind::limit_load}}};
    Choice<LoadFactor> asked_factor  = {{{"automatic", LoadFactor::automatic},
                                         {"velocity", LoadFactor::velocity},
                                         {"weight", LoadFactor::weight},
                                         {"tractions", LoadFactor::tractions}}};
    double             gap_tolerance = 0.01;
    double             growth        = 2.;
    unsigned int       most_cells    = 20000;
    unsigned int       most_levels   = 12;
    double             tolerance     = 1e-4;

    LoadFactor               factor    = LoadFactor::automatic;
    double                   load_unit = 1.; ///< load of a problem's 1
    std::string              unit      = "-";
    BoundUnits               units;
    std::vector<FlowCone>    flow_cones;
    bool                     non_associated = false;
    std::optional<CellSizes> sizes; ///< of the next mesh
    std::vector<BoundLevel>  levels;

    /** @name The last level */
    /** @{ */
    std::optional<Triangles> triangles;
    Bound                    upper, lower;
    std::vector<double>      gap;
    Json                     davis;
    bool no_limit = false; ///< its stresses grow beyond all bounds
    /** @} */
  };
} // namespace geocone

#endif
