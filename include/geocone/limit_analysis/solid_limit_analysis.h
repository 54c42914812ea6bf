// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_solid_limit_analysis_h
#define geocone_limit_analysis_solid_limit_analysis_h

#include <geocone/limit_analysis/bound_analysis.h>
#include <geocone/limit_analysis/solid_certificate.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Limit analysis of a three-dimensional rigid-plastic scene with associated flow: strict
   * bounds of the limit load on tetrahedra, which are bisected where the bounds differ.
   * Each mesh is a step of the run.
   */
  class SolidLimitAnalysis : public BoundAnalysis
  {
  public:
    SolidLimitAnalysis(const MPI_Comm       comm,
                       const ParameterFile &file,
                       Log                 &log);

    /** Returns true if the scene is analysed by strict bounds instead of time steps. */
    bool
    is_chosen() const
    {
      return kind == Kind::limit_load;
    }

  private:
    static Side
    figures_of(const SolidBound &side);

    std::string
    kind_word() const override
    {
      return kind.word();
    }
    const LoadChoice &
    load_choice() const override
    {
      return load;
    }
    bool
    refines() const override
    {
      return true;
    }
    LoadBracket
    bracket() const override;
    void
    prepare_water(const RunOptions &options) override;

    std::vector<std::string>
    prepare(const RunOptions &options) override;
    StepOutcome
    advance(TimePoint &now) override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override;

    SolidLoad load;

    enum class Kind
    {
      steps,
      limit_load
    };
    Choice<Kind> kind = {
      {{"steps", Kind::steps}, {"limit load", Kind::limit_load}}};

    enum class Order
    {
      linear,
      quadratic
    };
    Choice<Order> velocities = {
      {{"quadratic", Order::quadratic}, {"linear", Order::linear}}};
    Choice<Order> stresses = {
      {{"linear", Order::linear}, {"quadratic", Order::quadratic}}};

    std::vector<double> error; ///< by which the next mesh is refined; empty on the first

    /** @name Results of the last level */
    /** @{ */
    std::optional<Tetrahedra> tetrahedra;
    SolidBound                upper, lower;
    std::vector<double>       gap; ///< gap_of_cells()
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
