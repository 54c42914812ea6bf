// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_shakedown_shakedown_h
#define geocone_shakedown_shakedown_h

#include <geocone/bounds/bound_analysis.h>
#include <geocone/mesh/gmsh_mesh.h>
#include <geocone/output/mesh_output.h>
#include <geocone/shakedown/shakedown_bounds.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Shakedown factors of one mesh. */
  struct ShakedownRecord
  {
    unsigned int number = 0; ///< from 1
    unsigned int cells = 0, factorisations = 0;

    /** Factors with the elastic stresses of the mesh; the upper one is at most that of
     *  alternating plasticity at a point. */
    double lower = 0., upper = 0.;
    double alternating     = std::numeric_limits<double>::infinity();
    double lower_in_plane  = 0.; ///< without the strength out of the plane
    double gap             = 0.; ///< upper/lower - 1
    bool   lower_certified = false, upper_certified = false;

    /** Upper bound for the exact elastic stresses; infinite if unknown. */
    double proven        = std::numeric_limits<double>::infinity();
    double elastic_limit = std::numeric_limits<double>::quiet_NaN();
    double elastic_error = 0.;

    double       net_share = 0., state_share = 0.; ///< ShakedownBounds
    unsigned int most_active = 0;
    double       cpu_seconds = 0., mesh_seconds = 0.;

    bool
    certified() const
    {
      return lower_certified && upper_certified;
    }

    void
    state(StateRow &row);

    /** Name of the mechanism: alternating plasticity, incremental collapse or collapse
     *  in one state. */
    std::string
    mode() const;
  };

  /** Output of a shakedown analysis: shakedown.csv with one line per mesh, the fields of
   *  each mesh, and the summary. */
  class ShakedownOutput : public MeshOutput<ShakedownRecord>
  {
  public:
    using MeshOutput::MeshOutput;

    void
    prepare(const RunOptions &options);

  private:
    void
    report_results(std::ostream &out) const override;
  };

  /** Shakedown analysis of a plane elastic, perfectly plastic body with associated flow,
   *  under loads that vary between limits. Its meshes are refined where both factors and
   *  the elastic stresses of both methods differ; each mesh is a step of the run. */
  class Shakedown : public BoundAnalysis
  {
  public:
    Shakedown(const MPI_Comm comm, const ParameterFile &file, Log &log);

    OutputBase &
    output() override
    {
      return shakedown_output;
    }

  private:
    std::vector<std::string>
    prepare(const RunOptions &options) override;
    void
    prepare_output(const RunOptions &options) override
    {
      shakedown_output.prepare(options);
    }
    std::string
    headline(const std::string &name) const override;
    Json
    model() override;
    StepOutcome
    advance(TimePoint &now) override;
    void
    record(const TimePoint &now) override;
    void
    write_fields(const double t) override;
    Json
    topics() override;
    /** Warns if the lower factor of the last mesh is below that of a coarser one. */
    void
    warn_of_falling_factor() const;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override;

    std::string
    kind_word() const override
    {
      return "shakedown";
    }
    const LoadChoice &
    load_choice() const override
    {
      return bounded_load;
    }
    void
    prepare_water(const RunOptions &options) override;
    bool
    refines() const override
    {
      return scene.geometry.shape != Geometry::Shape::file;
    }
    bool
    reduces_strength() const override
    {
      return false;
    }
    LoadBracket
    bracket() const override
    {
      return {}; // the lower factor is no bound
    }

    /** @throws InputError for scenes whose elastic stresses or yield conditions are
     *  unknown here */
    void
    check_scene() const;

    /** Selects the cell sizes of the next mesh. */
    void
    refine(const ShakedownRecord &record);

    ShakedownOutput shakedown_output;
    VaryingLoads    loads;
    BoundedLoad     bounded_load;

    std::optional<CellSizes> sizes; ///< of the next mesh
    std::optional<Triangles> triangles;
    ShakedownBounds          found; ///< on the last mesh
  };
} // namespace geocone::GEOCONE_DIM

#endif
