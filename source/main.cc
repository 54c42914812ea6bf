// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/version.h>
#include <geocone/command_line.h>
#include <geocone/explicit_simulation.h>
#include <geocone/replay.h>
#include <geocone/simulation.h>

#include <deal.II/base/mpi.h>

#include <omp.h>

#include <filesystem>
#include <iostream>

#include <dlfcn.h>
#include <unistd.h>

namespace
{
  using namespace geocone;

  const char *usage =
    "geocone FILE.prm [--output FOLDER] [--set 'Section/Parameter = value']... "
    "[--quiet]\n"
    "mpirun -np RANKS geocone FILE.prm ...\n"
    "geocone --replay FILE.h5|FILE.dat [--output FOLDER] [--set ...]...\n"
    "\n"
    "  --output FOLDER      folder of the results (default: results/NAME)\n"
    "  --set 'S/P = value'  overrides a parameter of the file; repeatable\n"
    "  --replay FILE        solves a frozen problem again ('Output/Freeze "
    "steps', or\n"
    "                       a problem file of Siconos); --set takes options "
    "of the\n"
    "                       solver, e.g. 'Newton/Globalisation = line "
    "search'\n"
    "  --quiet              nothing on the screen but errors and warnings\n"
    "  --defaults NEW.prm   writes all parameters with their defaults, "
    "commented\n"
    "  --help               this text and all parameters\n"
    "  --version            versions of geocone and its libraries\n"
    "\n"
    "The exit code is 0 if the run has finished and its expectations hold, "
    "and\n"
    "1 otherwise.\n";

  /** All parameters with an example of each kind of named section. */
  void
  print_defaults(std::ostream &out)
  {
    const std::filesystem::path example =
      std::filesystem::temp_directory_path() /
      ("geocone-" + std::to_string(getpid()) + ".prm");
    {
      std::ofstream file(example);
      file << "subsection Boundary conditions\nset Names = footing\nend\n"
              "subsection Tractions\nset Names = surcharge\nend\n";
    }
    const ParameterFile file(example.string(), {});
    std::filesystem::remove(example);
    Log                log(MPI_COMM_WORLD, true);
    Simulation         simulation(MPI_COMM_WORLD, file, log);
    ExplicitSimulation explicit_simulation(MPI_COMM_WORLD, file, log);
    file.parse();
    ParameterFile::print(out, true);
  }

  int
  run(const int argc, char **argv, std::string &drawing)
  {
    const bool first =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    const CommandLine call =
      parse_command_line(argc, argv, "geocone", {"--replay"});
    if (call.version)
      {
        if (first)
          std::cout << "geocone " << version << " (deal.II "
                    << DEAL_II_PACKAGE_VERSION << ", "
#ifdef __clang__
                    << "clang " << __clang_version__
#else
                    << "g++ " << __VERSION__
#endif
#ifdef DEBUG
                    << ", with assertions)" << std::endl;
#else
                    << ", optimised)" << std::endl;
#endif
        return 0;
      }
    if (call.help)
      {
        if (first)
          {
            std::cout << usage << "\nAll parameters, with their defaults:\n\n";
            print_defaults(std::cout);
          }
        return 0;
      }
    if (!call.defaults_file.empty())
      {
        if (first)
          write_file(call.defaults_file, &print_defaults);
        return 0;
      }
    if (call.own.count("--replay") > 0)
      {
        if (!call.file.empty())
          throw InputError("--replay takes no parameter file, but '" +
                           call.file +
                           "' was given\n  remedy:  use --set for "
                           "options of the solver");
        if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
          throw InputError("--replay works on one rank\n"
                           "  remedy:  call it without mpirun");
        Log log(MPI_COMM_WORLD, call.quiet);
        return replay(call.own.at("--replay"), call.overrides, call.folder, log)
                 ? 0
                 : 1;
      }
    if (call.file.empty())
      {
        if (first)
          std::cerr << "error: no parameter file\n" << usage;
        return 1;
      }

    const ParameterFile file(call.file, call.overrides);
    Log                 log(MPI_COMM_WORLD, call.quiet);
    // Both, so that a file may hold the parameters of all methods.
    Simulation         simulation(MPI_COMM_WORLD, file, log);
    ExplicitSimulation explicit_simulation(MPI_COMM_WORLD, file, log);
    file.parse();
    const std::string name = std::filesystem::path(call.file).stem().string();
    const bool        is_explicit =
      file.peek("Discretisation/Method", "FEM") == "explicit MPM";
    const bool ok = is_explicit ? explicit_simulation.run(name, call.folder)
                                : simulation.run(name, call.folder);
    const OutputBase &output =
      is_explicit ? explicit_simulation.output() : simulation.output();
    if (first && output.wants_pictures())
      drawing = drawing_command(output.folder(), call.quiet);
    return ok ? 0 : 1;
  }
} // namespace

int
main(int argc, char **argv)
{
  std::string drawing;
  int         status = 1;
  {
    // One thread per rank: the parallelism is MPI's. Cholmod asks for a fixed
    // number of threads in blocks that are far too small for them, which was
    // measured to triple the time of a factorisation; this alone stops it.
    omp_set_max_active_levels(0);
    if (const auto set_blas_threads = reinterpret_cast<void (*)(int)>(
          dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
      set_blas_threads(1);
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    const bool                               several =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
    const bool first =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    try
      {
        status = run(argc, argv, drawing);
      }
    // All ranks find these two together, and end without waiting for each other.
    catch (const InputError &error)
      {
        if (first)
          std::cerr << "error: " << error.what() << std::endl;
      }
    catch (const StepFailure &error)
      {
        if (first)
          std::cerr << "error: " << error.what() << std::endl;
      }
    catch (const std::exception &error)
      {
        std::cerr << "error: " << error.what() << std::endl;
        if (several)
          MPI_Abort(MPI_COMM_WORLD, 1);
      }
  }
  draw(drawing);
  return status;
}
