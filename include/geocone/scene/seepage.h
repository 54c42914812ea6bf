// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_seepage_h
#define geocone_scene_seepage_h

#include <geocone/base/named_list.h>
#include <geocone/boundary/boundary_conditions.h>
#include <geocone/boundary/loading.h>
#include <geocone/functions/expression.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Boundary condition of the seepage problem. It applies to a part of the
   *  boundary exposed to open water, air or rain, or to a drain in the body. */
  class SeepageBoundary : public BoundaryPart
  {
  public:
    /** @param folder to which names of files are relative */
    SeepageBoundary(const std::string &name, const std::string &folder);

    void
    prepare();

    /** Initial water level y at the boundary (m). Without a value the boundary is
     *  exposed to air. */
    std::optional<double> level;

    /** Water level y (m) at time t if the level is a formula or a time history.
     *  No value: stages change the level. */
    std::optional<double>
    prescribed_level(const double t) const;

    /** Rainfall rate at time t per unit horizontal area (m/s); upper limit on
     *  the infiltration rate. @throws InputError for a negative rate */
    double
    rain(const double t) const;

    /** Returns true if the rainfall rate is nonzero at any time. */
    bool
    has_rain() const
    {
      return !rain_in_time.is_zero();
    }

    /** Vertices (m) of the polyline that represents a drain in the body. Empty
     *  without a drain. */
    std::vector<dealii::Point<dim>> drain;

    /** Returns true if the point x lies on the drain, within rounding. */
    bool
    is_on_drain(const dealii::Point<dim> &x) const;

  private:
    const std::string         folder;
    std::string               level_text = "none", rain_text = "0";
    Expression                rain_in_time;
    std::optional<Expression> level_in_time;
  };

  /** List of all boundary conditions of the seepage problem, from the parameter
   *  "Seepage/Names". All other parts of the boundary are impervious. */
  class Seepage : public NamedList<SeepageBoundary>
  {
  public:
    explicit Seepage(const ParameterFile &file);

    /** Checks the parameters. @throws InputError for invalid parameters, and
     *  for geometries without a mesh */
    void
    prepare(const Geometry &geometry);

    bool
    acts() const
    {
      return !list.empty();
    }

    /** Water levels at all seepage boundaries (m), in the order of the list.
     *  Boundaries without a value are exposed to air. */
    using Levels = std::vector<std::optional<double>>;

    /** A flow problem: either steady flow, or one time step of transient
     *  flow. */
    struct Step
    {
      Levels levels;        ///< water levels at the end of the step
      double duration = 0.; ///< size of the step (s); 0: steady flow
      double time     = 0.; ///< time at the end of the step (s)
    };

    /** Initial water levels. */
    Levels
    levels() const;

    /** Returns the flow problems of a stage of the loading programme. The list
     *  is empty if the stage does not change the water levels.
     *  @param begin time at the beginning of the stage (s)
     *  @param before water levels at the beginning of the stage
     *  @throws InputError for unknown names */
    std::vector<Step>
    steps(const Stage &stage, const double begin, const Levels &before) const;

    /** Target number of cells in the finest mesh of the seepage problem. */
    unsigned int n_cells = 5000;

    /** Polynomial degree of the pressure heads. */
    unsigned int degree = 1;

    /** Height y (m) of a water table; the initial pressures are hydrostatic
     *  relative to it. No value: the steady flow at t = 0 is the initial state. */
    std::optional<double> initial_table;

    /** Largest time discretisation error of the effective saturation per time
     *  step (-), of unsaturated flow. */
    double tolerance = 0.01;

    /** Time (s) in the loading programme at which limit analysis evaluates the
     *  pore pressures. */
    double time = 0.;

  private:
    /** Applies 'Water levels' of a stage to the levels before it.
     *  @throws InputError for unknown names and prescribed levels */
    Levels
    levels_after(const Stage &stage, Levels levels) const;

    std::string initial_text = "steady";
  };
} // namespace geocone::GEOCONE_DIM

#endif
