// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// A step that fails must leave the state as it was, bit by bit: kinematics and
// points are compared with copies, and the halved steps that follow with those of
// a stepper that has never failed.

#include <geocone/base/parameter_file.h>
#include <geocone/base/version.h>
#include <geocone/run/implicit_simulation.h>

#include "../test.h"

#include <cstdio>

namespace solvers_step_cut_01
{
  using namespace geocone;

  /** What a run is made of, without the run. */
  struct Parts
  {
    explicit Parts(const ParameterFile &file)
      : scene(file)
      , mesh(MPI_COMM_WORLD)
      , timer(std::cout,
              dealii::TimerOutput::never,
              dealii::TimerOutput::wall_times)
    {}

    void
    prepare()
    {
      scene.prepare();
      newton.prepare();
      mesh.prepare(scene, method);
      space.prepare(mesh, method);
      stepper.prepare(scene, mesh, space, newton, timer, kinematics, points);
    }

    bool
    advance(const double t, const double h)
    {
      return stepper
        .advance(kinematics, points, newton, freezer, timer, t, h, 1.)
        .converged;
    }

    Scene               scene;
    Method              method;
    BackgroundMesh      mesh;
    Space               space;
    NonsmoothNewton     newton;
    Freezer             freezer;
    ImplicitFEM         stepper;
    dealii::TimerOutput timer;
    MaterialPoints      points;
    Kinematics          kinematics;
  };

  bool
  same(const Vector &a, const Vector &b)
  {
    for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
      if (a.local_element(i) != b.local_element(i))
        return false;
    return true;
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    // At most 15 iterations: the long step fails, its halves do not.
    const ParameterFile file(
      GEOCONE_SOURCE_DIR "/tests/footing_coarse.prm",
      {"Newton/Maximum iterations = 15", "Time stepping/Inertia = true"});

    const auto make = [&]() {
      dealii::ParameterAcceptor::clear();
      auto parts = std::make_unique<Parts>(file);
      // The rest of what the parameter file speaks of.
      StepControl   control;
      ExactSolution exact;
      Log           log(MPI_COMM_WORLD, true);
      RunOutput     output(MPI_COMM_WORLD, log);
      file.parse();
      parts->prepare();
      return parts;
    };
    const auto failing = make();
    const auto smooth  = make();

    for (const auto &parts : {failing.get(), smooth.get()})
      for (int i = 0; i < 3; ++i)
        std::printf(
          "step %d converged: %d\n", i, int(parts->advance(0.01 * i, 0.01)));

    const Vector         velocity     = failing->kinematics.velocity;
    const Vector         displacement = failing->kinematics.displacement;
    const MaterialPoints points       = failing->points;
    std::printf("the long step converged: %d\n",
                int(failing->advance(0.03, 40.)));
    std::printf("state untouched: %d\n",
                int(same(velocity, failing->kinematics.velocity) &&
                    same(displacement, failing->kinematics.displacement) &&
                    points.stress == failing->points.stress &&
                    points.plastic_strain == failing->points.plastic_strain &&
                    points.cumulative_plastic_strain ==
                      failing->points.cumulative_plastic_strain));

    for (const auto &parts : {failing.get(), smooth.get()})
      std::printf("the short step converged: %d\n",
                  int(parts->advance(0.03, 0.01)));
    std::printf(
      "as if nothing had failed: %d\n",
      int(same(smooth->kinematics.velocity, failing->kinematics.velocity) &&
          smooth->points.stress == failing->points.stress));
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_step_cut_01
