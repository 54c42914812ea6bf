// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/linear/linear_solver.h>
#include <geocone/linear/preconditioner.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

namespace geocone
{
  namespace
  {
    const UsedWhere used_linear_solver[] = {
      {"Linear solver/*", "Discretisation/Method", {"FEM", "MPM"}},
      {"Linear solver/Largest tolerance",
       "Linear solver/Name",
       {"automatic", "multigrid", "p-multigrid"}}};
  } // namespace

  void
  LinearSolver::fail(const std::string &why)
  {
    throw RunError(why + "\n  remedy:  take fewer cells, more memory or more "
                         "ranks, 'Linear solver/Out of core', or another "
                         "'Linear solver/Name'");
  }

  LinearSolverParameters::LinearSolverParameters()
    : dealii::ParameterAcceptor("/Linear solver")
  {
    name.declare(
      *this,
      "Name",
      ". Automatic: Cholmod for associated flow on one rank, otherwise Mumps; "
      "beyond Largest direct system in three dimensions p-multigrid, where "
      "it is possible and there are no obstacles. Multigrid needs less memory "
      "in "
      "three dimensions; p-multigrid is for FEM with P2, P3, Q2 or Q3.");
    index_size.declare(
      *this,
      "Index size",
      ": bits of the indices of Cholmod's factors. Automatic: 64 if 32 are too "
      "few (beyond about 2e7 unknowns in the plane).");
    add_parameter("Out of core",
                  out_of_core,
                  "Whether Mumps stores the factors on disk: a third of the "
                  "memory for 10 to 30 % more time.");
    add_parameter("Out-of-core folder",
                  folder,
                  "Folder of these files, on a local disk of each rank; they "
                  "are deleted when the run ends.");
    add_parameter(
      "Tolerance",
      tolerance,
      "Tolerance of multigrid: residual relative to the right-hand side [-].",
      prm,
      dealii::Patterns::Double(1e-14, 0.1));
    add_parameter(
      "Largest tolerance",
      largest_tolerance,
      "Largest tolerance of multigrid [-] in steps of soil that can yield: far "
      "from equilibrium, Newton's method takes a larger tolerance (Eisenstat "
      "and Walker 1996). Values below Tolerance have no effect: it is then "
      "constant.",
      prm,
      dealii::Patterns::Double(1e-14, 0.5));
    add_parameter("Maximum iterations",
                  max_iterations,
                  "Maximum number of multigrid iterations; if exceeded, a "
                  "direct solver solves the system, or beyond Largest direct "
                  "system Newton's method takes the direction found.",
                  prm,
                  dealii::Patterns::Integer(1));
    add_parameter("Largest direct system",
                  largest_direct,
                  "Number of unknowns in three dimensions up to which "
                  "'automatic' selects a direct solver, and multigrid leaves "
                  "to one what exceeds Maximum iterations: 300 000 take about "
                  "5 GB and a minute.",
                  prm,
                  dealii::Patterns::Integer(0));
  }

  std::unique_ptr<LinearSolver>
  LinearSolverParameters::make(const MPI_Comm comm,
                               const bool     symmetric,
                               const bool     on_degrees) const
  {
    if (name == Name::p_multigrid && !on_degrees)
      throw InputError("Linear solver/Name",
                       name.word(),
                       "automatic | Cholmod | Umfpack | Mumps | multigrid, "
                       "except for FEM with P2, P3, Q2 or Q3 and no tied sides",
                       "take multigrid, or such an element");
    if (name != Name::multigrid && !on_degrees)
      return make_direct(name.get(), comm, symmetric);
    const auto direct = [&]() {
      return make_direct(Name::automatic, comm, symmetric);
    };
    auto preconditioner = make_aggregation(comm, symmetric);
    if (on_degrees)
      preconditioner =
        make_p_multigrid(symmetric, direct(), std::move(preconditioner));
    return make_iterative(
      symmetric, *this, std::move(preconditioner), direct());
  }

  bool
  LinearSolverParameters::selects_p_multigrid(const std::size_t n_dofs) const
  {
    return name == Name::p_multigrid ||
           (name == Name::automatic && !out_of_core && n_dofs > largest_direct);
  }

  std::unique_ptr<LinearSolver>
  LinearSolverParameters::make_direct(Name           chosen,
                                      const MPI_Comm comm,
                                      const bool     symmetric) const
  {
    const bool serial = dealii::Utilities::MPI::n_mpi_processes(comm) == 1;
    if (chosen == Name::automatic)
      chosen =
        serial && symmetric && !out_of_core ? Name::cholmod : Name::mumps;
    if (chosen != Name::mumps && !serial)
      throw InputError("Linear solver/Name",
                       name.word(),
                       "automatic | Mumps | multigrid on several ranks",
                       "take automatic, or one rank");
    if (out_of_core && dealii::Utilities::MPI::logical_or(
                         access(folder.c_str(), W_OK | X_OK) != 0, comm))
      throw InputError("Linear solver/Out-of-core folder",
                       folder,
                       "a folder that can be written to",
                       "make it first, or take another one");
    if (chosen != Name::mumps && out_of_core)
      throw InputError("Linear solver/Out of core",
                       "true",
                       "false with Umfpack and Cholmod",
                       "set Linear solver/Name = Mumps");
    if (chosen == Name::cholmod && !symmetric)
      throw InputError("Linear solver/Name",
                       name.word(),
                       "automatic | Umfpack | Mumps with non-associated flow",
                       "its Jacobian is not symmetric: take automatic");
    if (chosen != Name::cholmod && index_size == IndexSize::bits_64)
      throw InputError("Linear solver/Index size",
                       index_size.word(),
                       "automatic | 32 with Umfpack and Mumps",
                       "Mumps counts entries in 64 bits by itself: take "
                       "automatic");
    if (chosen == Name::cholmod)
      return make_cholmod(index_size.get());
    if (chosen == Name::umfpack)
      return make_umfpack();
    return make_mumps(comm, symmetric, out_of_core ? folder : "");
  }
} // namespace geocone
