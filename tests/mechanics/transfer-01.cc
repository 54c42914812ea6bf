// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Steps of the implicit material point method. Particles and nodes must have
// the same momentum; a free body must keep its mass and momentum, with APIC also
// the angular one; loads must add momentum as they act. FLIP must leave
// velocities as they are, to the last bit, where those of the nodes do not
// change. APIC must hand affine velocities on. A body that turns must turn its
// stress with it, and not change it otherwise.

#include <geocone/implicit/implicit_mpm.h>

#include "../discretisation/setup.h"
#include "../test.h"

#include <cmath>

namespace mechanics_transfer_01
{
  using namespace discretisation_tests;
  using namespace geocone;
  using dealii::Point;
  using dealii::Tensor;
  using dealii::TimerOutput;

  /** A run of some steps, whose particles can be set in between. */
  struct Run
  {
    explicit Run(const std::vector<std::string> &overrides)
      : file((dealii::ParameterAcceptor::clear(),
              GEOCONE_SOURCE_DIR "/tests/mechanics/transfer.prm"),
             overrides)
      , scene(file)
      , mesh(comm)
      , stepper(file)
      , timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
    {
      file.parse();
      scene.prepare();
      newton.prepare();
      mesh.prepare(scene, method);
      space.prepare(mesh, method);
      stepper.prepare(scene, mesh, space, newton, timer, kinematics, points);
    }

    void
    step(const double h)
    {
      report =
        stepper.advance(kinematics, points, newton, freezer, timer, t, h, 1.);
      if (!report.converged && speaks())
        std::printf("  failed: %s\n", report.newton.reason.c_str());
      t += h;
    }

    /** Mass, momentum and angular momentum about the origin of the particles. */
    std::array<double, 4>
    sums(const bool apic = false) const
    {
      std::array<double, 4> s = {};
      for (unsigned int p = 0; p < points.n_points(); ++p)
        {
          const double          m = points.mass[p];
          const Point<dim>     &x = points.position[p];
          const Tensor<1, dim> &v = points.velocity[p];
          s[0] += m;
          s[1] += m * v[0];
          s[2] += m * v[1];
          s[3] += m * (x[0] * v[1] - x[1] * v[0]);
          // Cubic splines of size 0.1 have the second moment h^2/3.
          if (apic)
            s[3] += m * (points.affine[p][1][0] - points.affine[p][0][1]) *
                    (0.01 / 3.);
        }
      for (double &x : s)
        x = mpi::sum(x, comm);
      return s;
    }

    ParameterFile   file;
    Method          method;
    Scene           scene;
    BackgroundMesh  mesh;
    Space           space;
    NonsmoothNewton newton;
    Freezer         freezer;
    ImplicitMPM     stepper;
    TimerOutput     timer;
    Kinematics      kinematics;
    MaterialPoints  points;
    StepReport      report;
    double          t = 0.;
  };

  double
  sum(const double x)
  {
    return mpi::sum(x, comm);
  }

  Mandel
  sum(const Mandel &x)
  {
    return {sum(x[0]), sum(x[1]), sum(x[2])};
  }

  template <typename T>
  T
  sum(const T &x)
  {
    T all;
    for (unsigned int d = 0; d < dim; ++d)
      all[d] = sum(x[d]);
    return all;
  }

  /** A field of the particles of all ranks, by their numbers. */
  template <typename T>
  std::vector<T>
  by_number(const Run &run, const std::vector<T> &field)
  {
    T zero = field.empty() ? T() : field[0];
    zero *= 0.;
    std::vector<T> all(mpi::sum(run.points.n_points(), comm), zero);
    for (unsigned int p = 0; p < field.size(); ++p)
      all[run.points.id[p]] = field[p];
    for (T &x : all)
      x = sum(x);
    return all;
  }

  const std::string vx    = "Initial velocity/Velocity x = ",
                    vy    = "Initial velocity/Velocity y = ",
                    apic  = "Material point method/Transfer = APIC",
                    soft  = "Materials/soil/Young modulus = 1e-9",
                    start = "Material point method/Start = particle velocity";

  /** Sums of mass and momentum over the nodes and over the particles. */
  void
  check_nodes(const std::string &name, std::vector<std::string> overrides)
  {
    if (speaks())
      std::printf("%s\n", name.c_str());
    overrides.insert(overrides.end(), {vx + "0.1+x*y", vy + "sin(3*x)-y"});
    Run        run(overrides);
    const bool with_affine = name.find("APIC") != std::string::npos;
    const auto before      = run.sums(with_affine);
    // What the particles give, with the velocities that the nodes got.
    Vector             mass(run.space.partitioner());
    const auto        &points = run.points;
    const unsigned int n      = points.n_nodes;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            mass.local_element(dim * points.nodes[c * n + i] + d) +=
              points.mass[p] * points.values[p * n + i];
    mass.compress(dealii::VectorOperation::add);
    double sums[2] = {}, momentum[2] = {};
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      {
        sums[i % 2] += mass.local_element(i);
        momentum[i % 2] +=
          mass.local_element(i) * run.kinematics.velocity.local_element(i);
      }
    double error = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      error = std::max(
        {error,
         std::abs(mpi::sum(sums[d], comm) / before[0] - 1.),
         std::abs(mpi::sum(momentum[d], comm) - before[1 + d]) / before[0]});
    print("nodes have the mass and the momentum of the particles",
          error < 1e-12);

    for (unsigned int i = 0; i < 3; ++i)
      run.step(0.01);
    const auto after = run.sums(with_affine);
    if (speaks())
      std::printf(
        "  mass %.8f, momentum %.6f %.6f\n", after[0], after[1], after[2]);
    error = std::abs(after[0] - before[0]) / before[0];
    print("the mass stays", error < 1e-14);
    error =
      std::max(std::abs(after[1] - before[1]), std::abs(after[2] - before[2])) /
      before[0];
    print("the momentum stays", error < 1e-9);
    if (with_affine)
      print("the angular momentum stays",
            std::abs(after[3] - before[3]) < 1e-9 * before[0]);
  }

  void
  check_load()
  {
    if (speaks())
      std::printf("traction on a part of the top, and weight\n");
    const double q = -3000., g = -9.81, h = 0.002;
    for (const std::string size : {"0.1", "0.077"})
      {
        Run          run({"Mesh/Cell size = " + size,
                          "Gravity/Acceleration = 0, -9.81",
                          "Tractions/Names = load",
                          "Tractions/load/Sides = top",
                          "Tractions/load/Box = 0.83, 1; 1.22, 2",
                          "Tractions/load/Traction y = -3000",
                          "Tractions/load/Traction x = 500*t"});
        const double mass = run.sums()[0];
        run.step(h);
        run.step(h);
        const auto after = run.sums();
        print("it adds its impulse",
              std::abs(after[2] - 2. * h * (q * 0.39 + g * mass)) <
                  1e-9 * std::abs(after[2]) &&
                std::abs(after[1] - h * 500. * 3. * h * 0.39) <
                  1e-8 * std::abs(after[2]));
      }
  }

  void
  check_flip()
  {
    if (speaks())
      std::printf("FLIP in free flight\n");
    // Velocities that the nodes see averaged.
    for (const double part : {1., 0.})
      {
        Run        flip({vx + "sin(40*x)",
                         vy + "cos(50*y)",
                         soft,
                         start,
                         "Material point method/FLIP part = " + std::to_string(part)});
        const auto before = by_number(flip, flip.points.velocity);
        flip.step(1e-6);
        bool same = true, none = true;
        for (unsigned int p = 0; p < flip.points.n_points(); ++p)
          {
            const bool equal =
              flip.points.velocity[p] == before[flip.points.id[p]];
            same &= equal;
            none &= !equal;
          }
        print(part == 1. ? "velocities stay, to the last bit"
                         : "with PIC none of them does",
              part == 1. ? same : none);
      }
  }

  void
  check_apic(const std::string &element)
  {
    if (speaks())
      std::printf("APIC with affine velocities, %s\n", element.c_str());
    Run run({apic, soft, start, "Discretisation/Element = " + element});
    Tensor<2, dim> C({{0.3, -0.7}, {1.1, -0.2}});
    Tensor<1, dim> v0({0.4, -0.1});
    run.step(1e-3); // from here on the particles can be set
    for (unsigned int p = 0; p < run.points.n_points(); ++p)
      {
        run.points.velocity[p] = v0 + C * run.points.position[p];
        run.points.affine[p]   = C;
      }
    const auto   before = by_number(run, run.points.position);
    const double h      = 0.01;
    run.step(h);
    double      nodes = 0., velocities = 0., affine = 0., places = 0.;
    const auto &v = run.kinematics.velocity;
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      if (v.local_element(i) != 0.)
        nodes = std::max(
          nodes,
          std::abs(v.local_element(i) -
                   (v0 + C * run.space.node_positions()[i / dim])[i % dim]));
    for (unsigned int p = 0; p < run.points.n_points(); ++p)
      {
        const Point<dim>    &x        = before[run.points.id[p]];
        const Tensor<1, dim> expected = v0 + C * x;
        velocities =
          std::max(velocities, (run.points.velocity[p] - expected).norm());
        affine = std::max(affine, (run.points.affine[p] - C).norm());
        places =
          std::max(places, (run.points.position[p] - x - h * expected).norm());
      }
    print("nodes have the affine velocity", nodes < 1e-10);
    print("particles as well", velocities < 1e-10);
    print("and its gradient", affine < 1e-9);
    print("and move by it", places < 1e-12);
  }

  void
  check_rotation(const std::string &element)
  {
    if (speaks())
      std::printf("a prestressed body turns, %s\n", element.c_str());
    // So heavy that its stress moves nothing.
    Run          run({apic,
                      soft,
                      start,
                      "Materials/soil/Density = 1e18",
                      "Initial stress/Type = given",
                      "Initial stress/Stress xx = 10+x",
                      "Initial stress/Stress yy = -20",
                      "Initial stress/Stress xy = 5*y",
                      "Discretisation/Element = " + element});
    const double omega = 0.8, h = 0.25;
    run.step(1e-6);
    for (unsigned int p = 0; p < run.points.n_points(); ++p)
      {
        run.points.affine[p] = Tensor<2, dim>({{0., -omega}, {omega, 0.}});
        run.points.velocity[p] =
          run.points.affine[p] * (run.points.position[p] - Point<dim>(1., 1.));
      }
    const auto stresses = by_number(run, run.points.stress);
    const auto weights  = by_number(run, run.points.volume);
    run.step(h);
    double               invariants = 0., angle = 0., volume = 0.;
    const double         c = std::cos(omega * h), s = std::sin(omega * h);
    const Tensor<2, dim> Q({{c, -s}, {s, c}});
    for (unsigned int p = 0; p < run.points.n_points(); ++p)
      {
        const Mandel &now = run.points.stress[p];
        const Mandel &was = stresses[run.points.id[p]];
        invariants        = std::max({invariants,
                                      std::abs(now.norm() - was.norm()),
                                      std::abs(now[0] + now[1] - was[0] - was[1])});
        const Tensor<2, dim> S(
          {{was[0], was[2] / sqrt2}, {was[2] / sqrt2, was[1]}});
        const Tensor<2, dim> T = Q * S * transpose(Q);
        angle                  = std::max(
          angle, (now - Mandel(T[0][0], T[1][1], sqrt2 * T[0][1])).norm());
        volume =
          std::max(volume,
                   std::abs(run.points.volume[p] / weights[run.points.id[p]] -
                            1. - omega * omega * h * h));
      }
    print("the invariants of the stress stay", invariants < 1e-10);
    print("it turns by the angle of the body", angle < 1e-10);
    print("volumes grow by 1 + angle^2, as the forward step has it",
          volume < 1e-10);
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
    check_nodes("FLIP, B-spline 3", {});
    check_nodes("FLIP, Q1", {"Discretisation/Element = Q1"});
    check_nodes("FLIP, consistent mass",
                {"Material point method/Consistent mass part = 0.9"});
    check_nodes("PIC", {"Material point method/FLIP part = 0"});
    check_nodes("APIC, B-spline 3", {apic});
    check_load();
    check_flip();
    for (const std::string element :
         {"Q1", "Q2", "Q3", "B-spline 2", "B-spline 3"})
      check_apic(element);
    for (const std::string element : {"Q1", "B-spline 3"})
      check_rotation(element);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mechanics_transfer_01
