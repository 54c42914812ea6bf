// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_limit_analysis_reliability_h
#define geocone_limit_analysis_reliability_h

#include <geocone/limit_analysis/bound_analysis.h>
#include <geocone/limit_analysis/sampled_body.h>
#include <geocone/mesh/bisected.h>
#include <geocone/mesh/triangles.h>
#include <geocone/output/field_files.h>

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Result of one sample. */
  struct SampleRecord
  {
    unsigned int number  = 0; ///< from 1
    int          verdict = 0; ///< SampleVerdict::Kind

    /** Bounds on the load factor; NaN if a bound is not certified or was not
     *  needed. */
    double lower = std::numeric_limits<double>::quiet_NaN(), upper = lower;

    unsigned int cells = 0, factorisations = 0;
    double       cpu_seconds = 0.;

    void
    state(StateRow &row)
    {
      row(number, verdict, lower, upper, cells, factorisations, cpu_seconds);
    }
  };

  /** Probability of failure, estimated from the numbers of failed and undecided
   *  samples. */
  struct FailureProbability
  {
    unsigned int          n_samples = 0, n_failed = 0, n_undecided = 0;
    double                lower = 0., upper = 1.; ///< of these samples
    std::array<double, 2> limits = {{0., 1.}};    ///< of all samples

    /** Evaluates the results of the samples.
     *  @param confidence least probability with which the limits include the
     *  probability of failure */
    FailureProbability(const std::vector<SampleRecord> &samples,
                       const double                     confidence);
  };

  /** Output of a reliability analysis: samples.csv with one line per sample,
   *  the field files of a selected sample, and the summary. */
  class ReliabilityOutput : public TableOutput<SampleRecord>
  {
  public:
    using TableOutput::TableOutput;

    void
    prepare(const RunOptions &options);

    bool
    writes_fields() const
    {
      return with_fields;
    }

    /** Writes the field file of a sample. Collective. */
    void
    write_fields(const double number, const FieldTable &table);

  private:
    void
    report_results(std::ostream &out) const override;

    std::unique_ptr<FieldFiles> fields;
  };

  /**
   * Reliability analysis: probability that a body fails under its loads,
   * estimated from samples of random fields. A sample is classified as failed
   * (stable) only if this is certified by an upper (lower) bound; otherwise it
   * is undecided. The bounds are computed on the first mesh and on finer meshes
   * with the same strengths. Triangles are refined where the bounds differ. The
   * samples are distributed over the ranks; each step of the run is a batch of
   * samples.
   */
  class Reliability : public BoundAnalysis
  {
  public:
    Reliability(const MPI_Comm comm, const ParameterFile &file, Log &log);

    OutputBase &
    output() override
    {
      return reliability_output;
    }

  private:
    std::vector<std::string>
    prepare(const RunOptions &options) override;
    std::vector<unsigned int>
    programme() const override;
    void
    prepare_output(const RunOptions &options) override
    {
      reliability_output.prepare(options);
    }
    std::string
    headline(const std::string &name) const override;
    Json
    model() override;
    StepOutcome
    advance(TimePoint &now) override;
    void
    record(const TimePoint &) override
    {}
    std::string
    progress(const TimePoint &) const override;
    Json
    topics() override;
    void
    finish(const double t) override;
    void
    state(StateRow &row) override
    {
      row(mechanisms, oldest);
    }

    std::string
    kind_word() const override
    {
      return "reliability";
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
      return most_levels > 1;
    }
    bool
    reduces_strength() const override
    {
      return false; // samples are compared with a load factor of 1
    }
    bool
    runs_on_ranks() const override
    {
      return true;
    }
    LoadBracket
    bracket() const override
    {
      return {}; // samples have no common load
    }

    /** Mesh of the body, with the limit analysis problems of the samples on
     *  this mesh. */
    struct Body
    {
      Body(const Scene       &scene,
           const BoundedLoad &load,
           const NestedMesh  &nested,
           const unsigned int n_first)
        : triangles(nested.mesh)
        , sampled(load.on(scene, triangles), nested.parent, n_first)
      {}

      const Triangles   triangles;
      const SampledBody sampled;
    };

    /** Returns true if a failure mechanism of an earlier sample proves that the
     *  present sample fails. */
    bool
    fails_by_earlier(const RandomFactors &factors, SampleRecord &record) const;

    /** Result of a sample, with the failure mechanism if a new one was found. */
    struct Sample
    {
      SampleRecord           record;
      std::vector<Mechanism> found; ///< one at most

      void
      state(StateRow &row)
      {
        row(record, found);
      }
    };

    /** Computes the bounds for a sample on a given mesh.
     *  @return triangles to be refined, empty if the sample is decided */
    std::vector<bool>
    solve_on(const Body          &body,
             const RandomFactors &factors,
             Sample              &sample) const;

    /** Computes the bounds for a sample on successively refined meshes until
     *  the sample is decided or the refinement limit is reached. */
    Sample
    solve(const unsigned int number) const;

    /** Writes the random factors and the velocities of the upper bound of a sample
     *  on the first mesh to a field file. Collective. */
    void
    write_sample(const unsigned int number);

    FailureProbability
    probability() const
    {
      return {reliability_output.all_records(), confidence};
    }

    ReliabilityOutput reliability_output;
    RandomFields      fields;
    BoundedLoad       bounded_load;

    unsigned int n_samples  = 1000;
    double       confidence = 0.95;

    std::optional<NestedMesh> first_mesh;
    std::unique_ptr<Body>     first;

    /** Latest failure mechanisms of earlier batches, the same on all ranks. */
    std::vector<Mechanism> mechanisms;
    std::size_t            oldest = 0; ///< of them, to be replaced next
  };
} // namespace geocone::GEOCONE_DIM

#endif
