// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// A step that is not solved is reported with a reason, whatever formulation,
// globalisation, law and friction are asked for. The rounding floor of the
// residual hides none of them: a velocity that is wrong by a millionth is no
// solution, though the step that it belongs to ends at the floor.

#include <geocone/reduced/stress_methods.h>
#include <geocone/run/implicit_simulation.h>

#include "../simulate.h"
#include "../test.h"

#include <cstdio>

namespace solvers_not_solved_01
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

    Scene               scene;
    Method              method;
    BackgroundMesh      mesh;
    Space               space;
    NonsmoothNewton     newton{stress_methods()};
    Freezer             freezer;
    ImplicitFEM         stepper;
    dealii::TimerOutput timer;
    MaterialPoints      points;
    Kinematics          kinematics;
  };

  std::unique_ptr<Parts>
  make(const std::vector<std::string> &overrides)
  {
    dealii::ParameterAcceptor::clear();
    const ParameterFile file(GEOCONE_SOURCE_DIR "/tests/footing_coarse.prm",
                             overrides);
    auto                parts = std::make_unique<Parts>(file);
    // The rest of what the parameter file speaks of.
    StepControl   control;
    ExactSolution exact;
    Log           log(MPI_COMM_WORLD, true);
    RunOutput     output(MPI_COMM_WORLD, log);
    file.parse();
    parts->prepare();
    return parts;
  }

  /** A step of 40 s pushes the footing through the ground. */
  void
  try_all()
  {
    const std::vector<std::string>              formulations   = {"automatic",
                                                                  "return map",
                                                                  "natural map",
                                                                  "reduced",
                                                                  "reduced with multipliers",
                                                                  "Gauss-Seidel"};
    const std::vector<std::string>              globalisations = {"automatic",
                                                                  "line search",
                                                                  "elastic blend",
                                                                  "merit search",
                                                                  "lag continuation",
                                                                  "none"};
    const std::vector<std::vector<std::string>> laws           = {
                {"Materials/soil/Friction angle = 0",
                 "Materials/soil/Dilatancy angle = 0"},
                {},
                {"Materials/soil/Dilatancy angle = 0"}};
    unsigned int n_tried = 0, n_failed = 0, n_silent = 0;
    for (const std::string &formulation : formulations)
      for (const std::string &globalisation : globalisations)
        for (const auto &law : laws)
          for (const std::string friction :
               {"Time stepping/Friction = exact",
                "Time stepping/Friction = automatic",
                "Materials/soil/Friction memory = "
                "0.01"})
            {
              std::vector<std::string> overrides = {
                "Mesh/Cell size = 0.5",
                "Boundary conditions/footing/Box = 0, -0.1; 0.5, 0.1",
                "Time stepping/Inertia = true",
                "Newton/Maximum iterations = 2",
                "Newton/Formulation = " + formulation,
                "Newton/Globalisation = " + globalisation,
                friction};
              overrides.insert(overrides.end(), law.begin(), law.end());
              try
                {
                  const auto       parts = make(overrides);
                  const StepReport report =
                    parts->stepper.advance(parts->kinematics,
                                           parts->points,
                                           parts->newton,
                                           parts->freezer,
                                           parts->timer,
                                           0.,
                                           40.,
                                           1.);
                  ++n_tried;
                  n_failed += !report.converged;
                  if (report.converged != report.newton.reason.empty())
                    {
                      ++n_silent;
                      std::printf("%s, %s, %s: reason '%s'\n",
                                  formulation.c_str(),
                                  globalisation.c_str(),
                                  friction.c_str(),
                                  report.newton.reason.c_str());
                    }
                }
              catch (const InputError &)
                {} // options that exclude each other
            }
    std::printf("steps tried: %u\nall failed: %d\nwithout a reason: %u\n",
                n_tried,
                int(n_failed == n_tried),
                n_silent);
  }

  /** The floor of a step that nearly keeps its volume, and what is near it. */
  void
  try_floor()
  {
    const auto       parts  = make({"Materials/soil/Cohesion = 1e9",
                                    "Materials/soil/Poisson ratio = 0.499999"});
    const StepReport report = parts->stepper.advance(parts->kinematics,
                                                     parts->points,
                                                     parts->newton,
                                                     parts->freezer,
                                                     parts->timer,
                                                     0.,
                                                     0.02,
                                                     1.);
    std::printf(
      "the elastic step is solved: %d, by one system: %d, at the floor "
      "of rounding: %d\n",
      int(report.converged),
      int(report.newton.iterations == 1),
      int(report.newton.at_rounding_floor));
    for (const double nu : {0.3, 0.499999})
      for (const double error : {1e-8, 1e-6, 1e-4})
        {
          const auto other =
            make({"Materials/soil/Cohesion = 1e9",
                  "Materials/soil/Poisson ratio = " + std::to_string(nu)});
          other->stepper.advance(other->kinematics,
                                 other->points,
                                 other->newton,
                                 other->freezer,
                                 other->timer,
                                 0.,
                                 0.02,
                                 1.);
          Constraints constraints(other->scene,
                                  other->mesh,
                                  other->space,
                                  other->scene.loading.list.front()->name);
          constraints.number_unknowns(nullptr);
          IncrementalProblem problem(other->points,
                                     other->scene.materials,
                                     constraints,
                                     other->space.partitioner(),
                                     nullptr);
          // The next step, of which the velocity of the last one is a solution.
          Vector v = problem.make_vector(), residual = problem.make_vector();
          v = other->kinematics.velocity;
          problem.begin_step(0.02, nullptr, v, v);
          for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
            if (constraints.is_free(i))
              v.local_element(i) *= 1. + error * std::sin(7. * i);
          v.update_ghost_values();
          const ResidualReport state = problem.residual(residual, v);
          std::printf(
            "nu = %g, a velocity that is wrong by %g is taken: %d\n",
            nu,
            error,
            int(state.norm <= problem.internal_forces().rounding_floor(v)));
        }
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    try_all();
    try_floor();
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace solvers_not_solved_01
