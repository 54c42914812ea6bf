// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What a free body keeps: momentum always; angular momentum with APIC and with a
// mass that is nearly consistent, while a lumped mass loses some of it in FLIP.
// Volume grows by the first order of the time step in a rotation.

#include <geocone/base/version.h>
#include <geocone/run/implicit_simulation.h>

#include "../test.h"

#include <cstdio>

namespace mpm_invariants_01
{
  using namespace geocone;
  using dealii::Tensor;

  /** Sums over the particles. */
  struct Invariants
  {
    double         mass = 0., volume = 0.;
    Tensor<1, dim> momentum;
    double         angular_momentum = 0.; ///< about the origin
  };

  Invariants
  sum(const MaterialPoints &points, const Space &space)
  {
    Invariants sums;
    for (unsigned int c = 0; c < points.n_cells(); ++c)
      for (unsigned int p = points.first_point[c];
           p < points.first_point[c + 1];
           ++p)
        {
          sums.mass += points.mass[p];
          sums.volume += points.weight[p];
          sums.momentum += points.mass[p] * points.velocity[p];
          // What the nodes get of it, with the affine part of APIC.
          for (unsigned int i = 0; i < points.n_nodes; ++i)
            {
              const auto x =
                space.node_positions()[points.nodes[c * points.n_nodes + i]];
              const auto v = points.velocity[p] +
                             points.affine[p] * (x - points.position[p]);
              sums.angular_momentum += points.mass[p] *
                                       points.values[p * points.n_nodes + i] *
                                       (x[0] * v[1] - x[1] * v[0]);
            }
        }
    return sums;
  }

  /** Steps through a parameter file and compares the end with the start. */
  void
  run(const char                     *name,
      const std::string              &file_name,
      const std::vector<std::string> &overrides)
  {
    dealii::ParameterAcceptor::clear();
    const ParameterFile file(GEOCONE_SOURCE_DIR "/prm/" + file_name, overrides);
    Log                 log(MPI_COMM_WORLD, true);
    dealii::TimerOutput timer(
      std::cout, dealii::TimerOutput::never, dealii::TimerOutput::wall_times);
    Scene           scene(file);
    Method          method;
    BackgroundMesh  mesh(MPI_COMM_WORLD);
    Space           space;
    NonsmoothNewton newton;
    Freezer         freezer;
    ImplicitFEM     fem;
    ImplicitMPM     mpm(file);
    StepControl     step_control;
    ExactSolution   exact_solution;
    RunOutput       output(MPI_COMM_WORLD, log);
    file.parse();
    scene.prepare();
    newton.prepare();
    mesh.prepare(scene, method);
    space.prepare(mesh, method);
    Kinematics     kinematics;
    MaterialPoints points;
    mpm.prepare(scene, mesh, space, newton, timer, kinematics, points);

    const Invariants start = sum(points, space);
    double           t = 0., momentum = 0.;
    for (const double h : scene.loading.list[0]->step_sizes())
      {
        if (!mpm.advance(kinematics, points, newton, freezer, timer, t, h, 1.)
               .converged)
          std::printf("FAILED\n");
        t += h;
        momentum = std::max(
          momentum, (sum(points, space).momentum - start.momentum).norm());
      }
    const Invariants end = sum(points, space);
    std::printf("%s: mass %.10f, momentum changes by %s, volume %.4f",
                name,
                end.mass / start.mass,
                momentum < 1e-10 ? "nothing" : "TOO MUCH",
                end.volume / start.volume);
    if (std::abs(start.angular_momentum) > 1e-10)
      std::printf(", angular momentum %.4f",
                  end.angular_momentum / start.angular_momentum);
    std::printf("\n");
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

    const std::string square = "rotating_square.prm", discs = "two_discs.prm";
    const std::string cubic = "Discretisation/Element = B-spline 3",
                      Q1    = "Discretisation/Element = Q1",
                      apic  = "Material point method/Transfer = APIC",
                      mass  = "Material point method/Consistent mass part = ",
                      size  = "Loading/turn/Step size = ";
    run("rotation, Q1", square, {Q1, mass + "0"});
    run("rotation, cubic", square, {cubic, mass + "0"});
    run("rotation, consistent mass", square, {cubic, mass + "0.999"});
    run("the same, h/2", square, {cubic, mass + "0.999", size + "0.005"});
    run("rotation, APIC", square, {cubic, mass + "0", apic});
    run("collision", discs, {"Loading/flight/Step size = 0.06"});
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace mpm_invariants_01
