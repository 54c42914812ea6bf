// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_solid_limit_analysis_h
#define geocone_limit_analysis_solid_limit_analysis_h

#include <geocone/limit_analysis/limit_output.h>
#include <geocone/limit_analysis/solid_certificate.h>
#include <geocone/mesh/mesh_parameters.h>
#include <geocone/run/simulation.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Limit analysis of a three-dimensional rigid-plastic scene with associated flow: strict
   * bounds of the limit load on tetrahedra. Each mesh is a step of the run; the cells of
   * the next one are smaller everywhere.
   */
  class SolidLimitAnalysis : public Simulation, public dealii::ParameterAcceptor
  {
  public:
    SolidLimitAnalysis(const MPI_Comm       comm,
                       const ParameterFile &file,
                       Log                 &log);

    OutputBase &
    output() override
    {
      return limit_output;
    }

    /** Whether loads are bounded instead of steps taken. */
    bool
    is_chosen() const
    {
      return kind == Kind::limit_load;
    }

  private:
    /** @throws InputError for parameters out of range, several ranks and particles */
    void
    check_parameters() const;

    /** Checks the scene, and that it admits strict bounds. @throws InputError */
    void
    prepare_scene(const RunOptions &options);

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
    void
    begin(const TimePoint &) override
    {}
    StepOutcome
    advance(TimePoint &now) override;
    void
    record(const TimePoint &now) override;
    std::string
    progress(const TimePoint &) const override
    {
      return "";
    }
    Json
    topics() override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override;

    Scene          scene;
    Method         method;
    MeshParameters mesh_parameters;
    LimitOutput    limit_output;
    SolidLoad      load;

    enum class Kind
    {
      steps,
      limit_load
    };
    Choice<Kind> kind = {
      {{"steps", Kind::steps}, {"limit load", Kind::limit_load}}};
    double       gap_tolerance = 0.01;
    double       growth        = 2.;
    unsigned int most_cells    = 20000;
    unsigned int most_levels   = 12;
    double       tolerance     = 1e-3;

    enum class Order
    {
      linear,
      quadratic
    };
    Choice<Order> velocities = {
      {{"quadratic", Order::quadratic}, {"linear", Order::linear}}};
    Choice<Order> stresses = {
      {{"linear", Order::linear}, {"quadratic", Order::quadratic}}};

    double refinement = 1.; ///< factor of the cell sizes, of the next mesh
    double refined    = 1.; ///< of the parameters at present
    std::optional<Tetrahedra> tetrahedra;
    SolidBound                upper, lower; ///< of the last mesh
  };
} // namespace geocone::GEOCONE_DIM

#endif
