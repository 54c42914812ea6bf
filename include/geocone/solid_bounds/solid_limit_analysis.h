// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_solid_bounds_solid_limit_analysis_h
#define geocone_solid_bounds_solid_limit_analysis_h

#include <geocone/bounds/bound_analysis.h>
#include <geocone/bounds/safety_search.h>
#include <geocone/solid_bounds/solid_certificate.h>

#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Limit analysis of a three-dimensional rigid-plastic scene with associated
   * flow. Strict bounds on the limit load or the factor of safety are computed
   * on tetrahedra, which are bisected where the bounds differ. Each mesh is a
   * step of the run.
   */
  class SolidLimitAnalysis : public BoundAnalysis
  {
  public:
    SolidLimitAnalysis(const MPI_Comm       comm,
                       const ParameterFile &file,
                       Log                 &log);

    /** Returns true if strict bounds are computed instead of time steps. */
    bool
    is_chosen() const
    {
      return kind == Kind::limit_load || kind == Kind::strength_reduction;
    }

    /** Returns true if only the flow of water is computed. */
    bool
    is_seepage() const
    {
      return kind == Kind::seepage;
    }

  private:
    static Side
    figures_of(const SolidBound &side);

    class Reduced;

    /** Bounds on the load or the factor of safety for the current mesh.
     *  @throws StepFailure if there is no bound */
    /** @{ */
    BoundLevel
    bound_load();
    BoundLevel
    bound_factor();
    /** @} */

    double
    share_of_gap() const;

    bool
    reduces_strength() const override
    {
      return kind == Kind::strength_reduction;
    }
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
    Json
    model() override;
    StepOutcome
    advance(TimePoint &now) override;
    void
    write_fields(const double t) override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override;

    SolidLoad    load;
    SafetySearch search;

    enum class Kind
    {
      steps,
      limit_load,
      strength_reduction,
      seepage
    };
    Choice<Kind> kind = {{{"steps", Kind::steps},
                          {"limit load", Kind::limit_load},
                          {"strength reduction", Kind::strength_reduction},
                          {"seepage", Kind::seepage}}};

    enum class Order
    {
      linear,
      quadratic
    };
    static unsigned int
    degree(const Order order)
    {
      return order == Order::linear ? 1 : 2;
    }
    Choice<Order> velocities = {
      {{"quadratic", Order::quadratic}, {"linear", Order::linear}}};
    Choice<Order> stresses = {
      {{"linear", Order::linear}, {"quadratic", Order::quadratic}}};

    std::vector<double>
      error; ///< by which the next mesh is refined; empty on the first

    /** @name Results of the last level */
    /** @{ */
    std::optional<Tetrahedra> tetrahedra;
    SolidBound                upper, lower;
    std::vector<double>       gap;        ///< gap_of_cells()
    double                    share = 0.; ///< their sum over the gap
    /** @} */
  };
} // namespace geocone::GEOCONE_DIM

#endif
