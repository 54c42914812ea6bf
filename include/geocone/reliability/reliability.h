// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_reliability_reliability_h
#define geocone_reliability_reliability_h

#include <geocone/base/choice.h>
#include <geocone/bounds/bound_analysis.h>
#include <geocone/mesh/bisected.h>
#include <geocone/mesh/triangles.h>
#include <geocone/output/mesh_output.h>
#include <geocone/reliability/failure_probability.h>
#include <geocone/reliability/importance_sampling.h>
#include <geocone/reliability/sample_search.h>
#include <geocone/reliability/sampled_body.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Selection of the samples of a reliability analysis. */
  enum class Sampling
  {
    monte_carlo, ///< by the distribution of the random fields
    importance   ///< around the design point, with weights (SamplingDensity)
  };

  /** Fields of the latest samples, which may decide others. */
  template <typename Field>
  class LatestFields
  {
  public:
    void
    add(std::vector<Field> fields)
    {
      for (Field &field : fields)
        if (list.size() < most)
          list.push_back(std::move(field));
        else
          list[oldest++ % most] = std::move(field);
    }

    auto
    begin() const
    {
      return list.begin();
    }
    auto
    end() const
    {
      return list.end();
    }

    void
    state(StateRow &row)
    {
      row(list, oldest);
    }

  private:
    static constexpr std::size_t most = 100;

    std::vector<Field> list;
    std::size_t        oldest = 0; ///< to be replaced next
  };

  /** Output of a reliability analysis: samples.csv with one line per sample,
   *  the field files of a selected sample, and the summary. */
  class ReliabilityOutput : public MeshOutput<SampleRecord>
  {
  public:
    using MeshOutput::MeshOutput;

    void
    prepare(const RunOptions &options);

    bool
    writes_fields() const
    {
      return with_fields;
    }

  private:
    void
    report_results(std::ostream &out) const override;
  };

  /**
   * Reliability analysis: probability that a body fails under its loads,
   * estimated from samples of random fields. A sample is classified as failed
   * (stable) only if this is certified by an upper (lower) bound; otherwise it
   * is undecided. The bounds are computed on the first mesh and on finer meshes
   * with the same strengths. Triangles are refined where the bounds differ. Mechanisms
   * and stresses of earlier samples are tried first, which needs no solution. The
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
      row(mechanisms, stresses, designs);
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

    /** Returns true if a failure mechanism or a stress field of an earlier sample
     *  decides the present sample. */
    bool
    is_decided_by_earlier(const RandomFactors &factors,
                          SampleRecord        &record) const;

    /** Result of a sample, with new fields that may decide others. */
    struct Sample
    {
      SampleRecord             record;
      std::vector<Mechanism>   mechanism; ///< one at most
      std::vector<StressField> stresses;  ///< one at most

      void
      state(StateRow &row)
      {
        row(record, mechanism, stresses);
      }
    };

    /** Standard normal numbers of a sample. */
    Eigen::VectorXd
    numbers_of(const unsigned int number) const
    {
      return density().moved(number, fields.numbers_of(number));
    }

    SamplingDensity
    density() const
    {
      std::vector<Eigen::VectorXd> centres;
      for (const DesignPoint &design : designs)
        centres.push_back(design.centre());
      return {std::move(centres), n_samples};
    }

    /** Finds the design points and the centres of samples on the first mesh.
     *  Collective. */
    void
    find_design_points();

    /** Logarithm of the load factor for given standard normal numbers on the first
     *  mesh; its fields are kept. */
    LimitState
    limit_state(const Eigen::VectorXd &numbers);

    /** Computes a bound for a sample on a given mesh.
     *  @return refinement indicator, empty if the sample is decided */
    std::vector<double>
    solve_on(const Body          &body,
             const RandomFactors &factors,
             const BoundSide      side,
             SampleSearch        &search,
             Sample              &sample) const;

    /** Computes bounds for a sample on successively refined meshes until it is decided, or
     *  is expected to remain undecided on the largest mesh. */
    void
    decide_by_bounds(const RandomFactors &factors, Sample &sample) const;

    Sample
    solve(const unsigned int number) const;

    /** Writes the random factors and the velocities of the upper bound of a sample
     *  on the first mesh to a field file. Collective. */
    void
    write_sample(const unsigned int number);

    FailureProbability
    probability() const
    {
      return {reliability_output.all_records(),
              confidence,
              density().largest_weight()};
    }

    ReliabilityOutput reliability_output;
    RandomFields      fields;
    BoundedLoad       bounded_load;

    Choice<Sampling> sampling   = {{{"Monte Carlo", Sampling::monte_carlo},
                                    {"importance", Sampling::importance}}};
    unsigned int n_samples  = 1000;
    double       confidence = 0.95;

    std::optional<NestedMesh> first_mesh;
    std::unique_ptr<Body>     first;
    std::optional<double>     gap_of_mean; ///< body, on the first mesh

    /** Fields of earlier batches, the same on all ranks. */
    LatestFields<Mechanism>   mechanisms;
    LatestFields<StressField> stresses;

    std::vector<DesignPoint>
      designs; ///< the nearest first; empty before the first batch
  };
} // namespace geocone::GEOCONE_DIM

#endif
