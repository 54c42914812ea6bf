// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_seepage_h
#define geocone_scene_seepage_h

#include <geocone/base/named_list.h>
#include <geocone/scene/boundary_conditions.h>
#include <geocone/scene/loading.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** A boundary of the seepage problem: a part of the boundary exposed to open
   *  water, air or rain, or a drain in the body. */
  class SeepageBoundary : public BoundaryPart
  {
  public:
    explicit SeepageBoundary(const std::string &name);

    void
    prepare();

    /** Level y of open water (m); no value: air. */
    std::optional<double> level;

    /** Rainfall rate (m/s) per horizontal area, an upper limit of
     *  infiltration. */
    double rain = 0.;

    /** Polyline of a drain in the body (m); empty: no drain. */
    std::vector<dealii::Point<dim>> drain;

    /** Whether x lies on the drain, within rounding. */
    bool
    is_on_drain(const dealii::Point<dim> &x) const;

  private:
    std::string level_text = "none";
  };

  /** The boundaries of the seepage problem, named in "Seepage/Names"; all other
   *  parts of the boundary are impervious. */
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

    /** Water levels of all boundaries, in the order of the list (m; no value:
     *  air). */
    using Levels = std::vector<std::optional<double>>;

    /** A flow problem: steady flow, or a time step of transient flow. */
    struct Step
    {
      Levels levels;        ///< at the end of the step
      double duration = 0.; ///< size of the step (s); 0: steady flow
      double time     = 0.; ///< at the end of the step (s)
    };

    /** Initial water levels. */
    Levels
    levels() const;

    /** Flow problems of a stage that begins at the time @p begin (s) with the
     *  water levels @p before; empty if the stage does not change the levels.
     *  @throws InputError for unknown names */
    std::vector<Step>
    steps(const Stage &stage, const double begin, const Levels &before) const;

    /** Target number of triangles of the finest mesh. */
    unsigned int n_cells = 5000;

    /** Time in the loading programme at which limit analysis takes the pore
     *  pressures of the flow (s). */
    double time = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
