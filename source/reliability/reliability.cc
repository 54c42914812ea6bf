// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/base/shared_counter.h>
#include <geocone/base/stop_request.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/mesh/fitted_mesh.h>
#include <geocone/output/model_of_triangles.h>
#include <geocone/output/simplex_table.h>
#include <geocone/reliability/reliability.h>
#include <geocone/reliability/statistics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const UsedWhere used_reliability[] = {
      {"Analysis/Sampling", "Analysis/Kind", {"reliability"}},
      {"Analysis/Samples", "Analysis/Kind", {"reliability"}},
      {"Analysis/Confidence", "Analysis/Kind", {"reliability"}}};

    /** Samples of a step, on any number of ranks: few at first, whose fields decide others,
     *  and then so many that ranks hardly wait for each other. */
    constexpr unsigned int n_short = 8, of_short = 16, of_long = 128;

    /** First sample of a step, from 1. */
    unsigned int
    first_of_step(const unsigned int step)
    {
      return 1 + of_short * std::min(step, n_short) +
             (step > n_short ? of_long * (step - n_short) : 0);
    }

    /** Trial samples of importance sampling. */
    constexpr unsigned int n_pilots = 16;
  } // namespace

  void
  ReliabilityOutput::prepare(const RunOptions &options)
  {
    begin(options, "sample");
    table.add("sample (-)", &SampleRecord::number);
    table.add("verdict (-)", &SampleRecord::verdict);
    table.add("weight (-)", &SampleRecord::weight);
    table.add("lower bound of the load factor (-)",
              &SampleRecord::lower,
              Finite::may_be);
    table.add("upper bound of the load factor (-)",
              &SampleRecord::upper,
              Finite::may_be);
    table.add("triangles (-)", &SampleRecord::cells);
    table.add("factorisations (-)", &SampleRecord::factorisations);
    table.add("CPU time (s)", &SampleRecord::cpu_seconds);
    open_table("samples.csv");
  }

  void
  ReliabilityOutput::report_results(std::ostream &out) const
  {
    const Json &found = summary["reliability"];
    out << format("%u %u %u\n",
                  found["samples"].get<unsigned int>(),
                  found["failed"].get<unsigned int>(),
                  found["undecided"].get<unsigned int>());
  }

  Reliability::Reliability(const MPI_Comm       comm,
                           const ParameterFile &file,
                           Log                 &log)
    : BoundAnalysis(comm, file, log)
    , reliability_output(comm, log)
    , fields(file)
  {
    declare_parameters(bounded_load);
    sampling.declare(*this,
                     "Sampling",
                     ". Of the random fields. Monte Carlo: by their "
                     "distribution. Importance: nine samples of ten around the "
                     "design point, which gradients of the bounds find, with "
                     "weights; small probabilities need few samples.");
    add_parameter(
      "Samples", n_samples, "Number of samples of the random fields [-].");
    add_parameter("Confidence",
                  confidence,
                  "Probability [-] with which the limits of the probability "
                  "of failure include it: at least this with Monte Carlo "
                  "sampling, about this with importance sampling.");
  }

  void
  Reliability::prepare_water(const RunOptions &)
  {
    if (scene.water.seepage.acts())
      throw InputError("Seepage/Names",
                       ParameterFile::value("Seepage/Names"),
                       "none with " + where(),
                       "bodies of random soil have no water; leave it out");
  }

  std::vector<std::string>
  Reliability::prepare(const RunOptions &options)
  {
    check_parameters();
    if (n_samples == 0 || n_samples > 10000000)
      throw InputError("Analysis/Samples",
                       n_samples,
                       "1 to 10000000",
                       "100 over the probability of failure give it to 20 % by "
                       "Monte Carlo sampling");
    if (sampling == Sampling::importance && n_samples < 20)
      throw InputError("Analysis/Samples",
                       n_samples,
                       ">= 20 with importance sampling",
                       "its limits are those of a mean of many samples");
    if (!(confidence > 0. && confidence < 1.))
      throw InputError(
        "Analysis/Confidence", confidence, "> 0, < 1", "0.95 is usual");
    prepare_scene(options);
    scene.materials.refuse_strength_formulas("with " + where());
    scene.water.refuse(where(),
                       "give undrained strengths and total unit weights");
    prepare_triangles();
    first_mesh.emplace(fitted_mesh(mesh_parameters, scene, comm));
    const Triangles triangles(first_mesh->mesh);
    if (triangles.cells.size() > most_cells)
      throw InputError("Analysis/Maximum cells",
                       most_cells,
                       format("%zu at least, the triangles of the mesh",
                              triangles.cells.size()),
                       "raise it, or take larger cells");
    bounded_load.prepare_reduction(scene, triangles, kind_word());
    fields.prepare(scene);
    fields.prepare_on(triangles);
    first = std::make_unique<Body>(
      scene, bounded_load, *first_mesh, triangles.cells.size());
    print_start(options,
                triangles.cells.size(),
                "",
                dealii::BoundingBox<dim>(triangles.vertices));
    if (!options.dry_run)
      fields.factorise(triangles);
    std::vector<std::string> warnings;
    if (bounded_load.non_associated())
      warnings.push_back("flow is taken as associated: with less dilatancy a "
                         "body may fail under smaller loads");
    return warnings;
  }

  std::vector<unsigned int>
  Reliability::programme() const
  {
    unsigned int n = 0;
    while (first_of_step(n) <= n_samples)
      ++n;
    return {n};
  }

  std::string
  Reliability::headline(const std::string &name) const
  {
    return name + format(": probability of failure by %u samples on %zu "
                         "triangles",
                         n_samples,
                         first->triangles.cells.size());
  }

  Json
  Reliability::model()
  {
    return model_of(scene, model_mesh_of(first->triangles));
  }

  bool
  Reliability::is_decided_by_earlier(const RandomFactors &factors,
                                     SampleRecord        &record) const
  {
    using Kind = SampleVerdict::Kind;
    for (const Mechanism &mechanism : mechanisms)
      if (const double load = mechanism.bound(factors); load < 1.)
        {
          record.verdict = static_cast<int>(Kind::fails);
          record.upper   = load;
          return true;
        }
    for (const StressField &field : stresses)
      if (const double load = field.bound(factors); load >= 1.)
        {
          record.verdict = static_cast<int>(Kind::stands);
          record.lower   = load;
          return true;
        }
    return false;
  }

  LimitState
  Reliability::limit_state(const Eigen::VectorXd &numbers)
  {
    LoadResponse response =
      first->sampled.respond(fields.factors(numbers), tolerance);
    if (response.mechanism)
      mechanisms.add({std::move(*response.mechanism)});
    if (response.stresses)
      stresses.add({std::move(*response.stresses)});
    return {std::log(response.load),
            fields.gradient(numbers, std::move(response.elasticity))};
  }

  void
  Reliability::find_design_points()
  {
    try
      {
        const auto state = [&](const Eigen::VectorXd &u) {
          return limit_state(u);
        };
        designs = design_points(fields.rank(), state);
        // Numbers that no sample has.
        std::vector<Eigen::VectorXd> pilots;
        for (unsigned int i = 0; i < n_pilots; ++i)
          pilots.push_back(fields.numbers_of(-1U - i));
        for (DesignPoint &design : designs)
          design.distance = distance_of_centre(design, pilots, state);
      }
    catch (const Stopped &)
      {} // all ranks are together here
    stop_if_asked(comm);
    // Ranks of different machines may round differently.
    StateRow of_first;
    of_first(designs, mechanisms, stresses);
    StateRow row(dealii::Utilities::MPI::broadcast(comm, of_first.values()));
    row(designs, mechanisms, stresses);
    for (const DesignPoint &point : designs)
      log.print(
        format("design point: reliability index %.4g, load factor %.4g; "
               "samples around it at the distance %.4g",
               point.index(),
               point.load_factor,
               point.distance));
    const DesignPoint &design = designs.front();
    if (design.mean_fails())
      log.warn(format("the body with mean properties fails (load factor %.4g): "
                      "samples are those of Monte Carlo",
                      design.load_factor));
    else if (!design.converged)
      log.warn(format("the design point was not found: load factor %.4g after "
                      "%u iterations, at the reliability index %.4g; the "
                      "limits hold, but may be wide",
                      design.load_factor,
                      design.iterations,
                      design.index()));
  }

  std::vector<double>
  Reliability::solve_on(const Body          &body,
                        const RandomFactors &factors,
                        const BoundSide      side,
                        SampleSearch        &search,
                        Sample              &sample) const
  {
    SampleRecord      &record  = sample.record;
    const unsigned int n_cells = body.triangles.cells.size();
    SampleVerdict      verdict = body.sampled.judge(factors, tolerance, side);
    record.factorisations += verdict.factorisations;
    record.cells = n_cells;
    // Bounds of all meshes are valid.
    record.lower   = std::fmax(record.lower, verdict.lower);
    record.upper   = std::fmin(record.upper, verdict.upper);
    record.verdict = static_cast<int>(verdict.kind);
    search.add(
      side, n_cells, side == BoundSide::lower ? verdict.lower : verdict.upper);
    if (verdict.mechanism)
      sample.mechanism = {std::move(*verdict.mechanism)};
    if (verdict.stresses)
      sample.stresses = {std::move(*verdict.stresses)};
    for (double &of_cell : verdict.refinement_indicator)
      of_cell = std::isfinite(of_cell) ? std::max(of_cell, 0.) : 0.;
    return verdict.refinement_indicator;
  }

  void
  Reliability::decide_by_bounds(const RandomFactors &factors,
                                Sample              &sample) const
  {
    SampleSearch        search(*gap_of_mean, most_cells);
    NestedMesh          nested = *first_mesh;
    std::optional<Body> refined;
    std::vector<double> indicator =
      solve_on(*first, factors, BoundSide::lower, search, sample);
    // The upper bound of the first mesh costs less than a wrong choice on the next one.
    if (sample.record.is_undecided() && search.next() == BoundSide::upper)
      indicator = solve_on(*first, factors, BoundSide::upper, search, sample);
    constexpr double least_growth = 1.1;
    for (unsigned int level = 1;
         level < most_levels && sample.record.is_undecided();
         ++level)
      {
        const std::size_t n_before = nested.mesh.cells.size();
        const auto        side     = search.next();
        if (!side || least_growth * n_before > most_cells)
          break;
        nested = bisected(std::move(nested),
                          indicator,
                          std::min<std::size_t>(growth * n_before, most_cells));
        if (nested.mesh.cells.size() == n_before)
          break;
        refined.emplace(
          scene, bounded_load, nested, first->triangles.cells.size());
        indicator = solve_on(*refined, factors, *side, search, sample);
      }
    // At least once, if the choice was wrong.
    if (sample.record.is_undecided() && !std::isfinite(sample.record.upper))
      {
        const unsigned int n_cells = sample.record.cells;
        solve_on(*first, factors, BoundSide::upper, search, sample);
        sample.record.cells = n_cells;
      }
  }

  Reliability::Sample
  Reliability::solve(const unsigned int number) const
  {
    dealii::Timer         time;
    const Eigen::VectorXd numbers = numbers_of(number);
    const RandomFactors   factors = fields.factors(numbers);
    Sample                sample;
    sample.record.number = number;
    sample.record.weight = density().weight(numbers);
    sample.record.cells  = first->triangles.cells.size();
    if (!is_decided_by_earlier(factors, sample.record))
      decide_by_bounds(factors, sample);
    sample.record.cpu_seconds = time.cpu_time();
    return sample;
  }

  Simulation::StepOutcome
  Reliability::advance(TimePoint &now)
  {
    namespace mpi = dealii::Utilities::MPI;
    if (sampling == Sampling::importance && designs.empty())
      find_design_points();
    const unsigned int last =
      std::min(first_of_step(now.in_stage + 1) - 1, n_samples);
    StateRow of_rank;
    {
      SharedCounter counter(comm, first_of_step(now.in_stage));
      try
        {
          if (!gap_of_mean)
            gap_of_mean = first->sampled.respond({}, tolerance).gap;
          for (unsigned int s; (s = counter.take()) <= last;)
            {
              Sample sample = solve(s);
              of_rank(sample);
            }
        }
      catch (const Stopped &)
        {} // all ranks are together here
    }
    stop_if_asked(comm);
    std::vector<Sample> samples;
    for (const auto &values : mpi::all_gather(comm, of_rank.values()))
      for (StateRow row(values); !row.at_end();)
        {
          samples.emplace_back();
          row(samples.back());
        }
    std::sort(samples.begin(), samples.end(), [](const auto &a, const auto &b) {
      return a.record.number < b.record.number;
    });
    for (Sample &sample : samples)
      {
        reliability_output.add_record(sample.record);
        mechanisms.add(std::move(sample.mechanism));
        stresses.add(std::move(sample.stresses));
      }
    now.time = last;
    return last == n_samples ? StepOutcome::stage : StepOutcome::well;
  }

  std::string
  Reliability::progress(const TimePoint &) const
  {
    const FailureProbability found = probability();
    return format("%u samples  %u failed  %u undecided  %.4g <= P_f <= %.4g",
                  found.n_samples,
                  found.n_failed,
                  found.n_undecided,
                  found.limits[0],
                  found.limits[1]);
  }

  Json
  Reliability::topics()
  {
    const auto              &records = reliability_output.all_records();
    const FailureProbability found   = probability();
    unsigned int             finest = 0, refined = 0, without = 0;
    double                   cpu = 0.;
    for (const SampleRecord &record : records)
      {
        finest = std::max(finest, record.cells);
        refined += record.cells > first->triangles.cells.size();
        without += record.is_without_solution();
        cpu += record.cpu_seconds;
      }
    Json json;
    json["size"]        = {{"method", kind_word()},
                           {"cells", first->triangles.cells.size()},
                           {"cells_finest", finest}};
    json["reliability"] = {
      {"sampling", sampling.word()},
      {"samples", found.n_samples},
      {"failed", found.n_failed},
      {"undecided", found.n_undecided},
      {"refined", refined},
      {"without_solution", without},
      {"lower", found.lower},
      {"upper", found.upper},
      {"confidence", confidence},
      {"limit_lower", found.limits[0]},
      {"limit_upper", found.limits[1]},
      {"cpu_s_per_sample", records.empty() ? 0. : cpu / records.size()}};
    if (!designs.empty())
      json["reliability"].update(
        {{"reliability_index", designs.front().index()},
         {"distance_of_centre", designs.front().distance},
         {"design_points", designs.size()},
         {"design_point_load_factor", designs.front().load_factor},
         {"design_point_found", designs.front().converged},
         {"mean_weight", found.mean_weight},
         {"effective_failed", found.effective_failed}});
    json["cost"] = times();
    return json;
  }

  void
  Reliability::finish(const double)
  {
    const FailureProbability found = probability();
    log.print(format("%u of %u samples fail, %u are undecided: the probability "
                     "of failure of these samples is %.4g to %.4g; with "
                     "confidence %g it is %.4g to %.4g",
                     found.n_failed,
                     found.n_samples,
                     found.n_undecided,
                     found.lower,
                     found.upper,
                     confidence,
                     found.limits[0],
                     found.limits[1]));
    if (found.n_undecided > 0.1 * std::max(1U, found.n_failed))
      log.warn(format("%u samples are undecided; raise 'Analysis/Maximum "
                      "cells' or 'Maximum levels', or take smaller cells",
                      found.n_undecided));
    constexpr double few = 20.;
    if (!density().is_normal() && found.effective_failed < few)
      log.warn(format("the failed samples have the weight of %.1f equal ones: "
                      "the limits are asymptotic and need %g or more; take "
                      "more samples",
                      found.effective_failed,
                      few));
    if (!reliability_output.writes_fields())
      return;
    // The first sample that fails by a mechanism of its own on the first mesh.
    for (const SampleRecord &record : reliability_output.all_records())
      if (record.verdict < 0 && record.factorisations > 0 &&
          record.cells == first->triangles.cells.size())
        return write_sample(record.number);
  }

  void
  Reliability::write_sample(const unsigned int number)
  {
    const Body         &on      = *first;
    const RandomFactors factors = fields.factors(numbers_of(number));
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    Eigen::VectorXd q;
    try
      {
        if (is_first)
          q = on.sampled.velocities(factors, tolerance);
      }
    catch (const Stopped &)
      {} // all ranks are together here
    stop_if_asked(comm);
    SimplexTable table(on.triangles, is_first);
    using Index = unsigned int;
    table.add("velocity", dim, [&](const Index, const Index v, const Index d) {
      return q[dim * v + d];
    });
    for (const auto &[name, factor] :
         {std::pair<const char *, const std::vector<double> &>(
            "cohesion_factor", factors.cohesion),
          {"tan_phi_factor", factors.tan_phi},
          {"unit_weight_factor", factors.unit_weight}})
      if (!factor.empty())
        table.add_of_cells(name, factor);
    table.add_materials();
    reliability_output.write_fields(number, table);
  }
} // namespace geocone::GEOCONE_DIM
