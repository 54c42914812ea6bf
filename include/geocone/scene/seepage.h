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
  /** Part of the boundary of a body with seepage that is exposed to open water,
   *  air or rain, or a drain in the body. */
  class SeepageBoundary : public BoundaryPart
  {
  public:
    explicit SeepageBoundary(const std::string &name);

    void
    prepare();

    /** Height y of the level of open water (m); none: air. */
    std::optional<double> level;

    /** Rain (m/s) per horizontal area, an upper limit of infiltration. */
    double rain = 0.;

    /** Line of a drain in the body, or empty (m). */
    std::vector<dealii::Point<dim>> drain;

    /** Whether x lies on the drain, within rounding. */
    bool
    is_on_drain(const dealii::Point<dim> &x) const;

  private:
    std::string level_text = "none";
  };

  /** Boundaries of a body with seepage that are exposed to water or air, named
   *  in "Seepage/Names"; all others are impervious. */
  class Seepage : public NamedList<SeepageBoundary>
  {
  public:
    explicit Seepage(const ParameterFile &file);

    /** @throws InputError for invalid parameters, and geometries without a mesh */
    void
    prepare(const Geometry &geometry);

    bool
    acts() const
    {
      return !list.empty();
    }

    /** Levels of all boundaries, in the order of the list (m; none: air). */
    using Levels = std::vector<std::optional<double>>;

    /** A flow to be solved: a steady one, or a step of a transient one. */
    struct Step
    {
      Levels levels;        ///< at its end
      double duration = 0.; ///< (s); 0: steady
      double time     = 0.; ///< at its end (s)
    };

    /** The initial levels. */
    Levels
    levels() const;

    /** Flows of a stage that begins at a time with the levels @p before; none
     *  if the stage does not change the levels. @throws InputError for unknown
     *  names */
    std::vector<Step>
    steps(const Stage &stage, const double begin, const Levels &before) const;

    /** Number of triangles of the finest mesh. */
    unsigned int n_cells = 5000;

    /** Time of the loading whose pressures are the initial ones (s): that of bounds. */
    double time = 0.;
  };
} // namespace geocone::GEOCONE_DIM

#endif
