// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/hdf5_file.h>
#include <geocone/base/stop_request.h>
#include <geocone/command_line.h>
#include <geocone/lab/replay.h>
#include <geocone/linear/blas_kernels.h>
#include <geocone/linear/one_thread.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>
#include <map>

// Three-dimensional counterpart of lab/replay.h.
namespace geocone::dim3
{
  bool
  replay(const std::string              &file_name,
         const std::vector<std::string> &overrides,
         const std::string              &folder,
         Log                            &log);
} // namespace geocone::dim3

namespace
{
  using namespace geocone;

  const char *usage =
    "geocone-lab FILE.h5|FILE.dat|FILE.hdf5... [--output FOLDER]\n"
    "        [--set 'Section/Parameter = value']... [--quiet]\n"
    "\n"
    "Solves problems again, without a scene: frozen ones\n"
    "('Output/Freeze steps'), those of Siconos (.dat) or FCLib (.hdf5).\n"
    "\n"
    "  --output FOLDER      folder of the results (default: none);\n"
    "                       of several problems FOLDER/NAME for NAME.h5\n"
    "  --set 'S/P = value'  overrides an option of the solver, or, of a\n"
    "                       frozen problem, a parameter of Materials\n"
    "  --quiet              nothing on the screen but errors\n"
    "  --help               this text; geocone --help has the parameters\n"
    "  --version            versions of it and its libraries\n"
    "\n"
    "The exit code is 0 if all problems are solved, and 1 otherwise;\n"
    "130, 143 and 129 after Ctrl-C, SIGTERM and SIGHUP.\n";

  /** Dimension of a problem; errors in the file are reported by the plane replay. */
  int
  dimension_of(const std::string &file_name)
  {
    try
      {
        const Hdf5File file(file_name, Hdf5File::Access::read);
        return file.has("dimension") ? file.read_integers("dimension").at(0)
                                     : 2;
      }
    catch (const std::exception &)
      {
        return 2;
      }
  }

  /** Solves a problem. @return whether it is solved */
  bool
  solve(const std::string &file,
        const std::string &folder,
        const CommandLine &call,
        Log               &log)
  {
    dealii::ParameterAcceptor::clear(); // of an earlier problem
    const auto replay_problem =
      dimension_of(file) == 3 ? dim3::replay : dim2::replay;
    return replay_problem(file, call.overrides, folder, log);
  }

  /**
   * Solves several problems, each of which has a folder of its name in that of the
   * results. An error in one is printed and does not concern the others.
   * @return whether all are solved
   * @throws InputError if two have the same name, Stopped
   */
  bool
  solve_all(const CommandLine &call, Log &log)
  {
    std::map<std::string, std::string> file_of;
    for (const std::string &file : call.files)
      {
        const std::string name    = std::filesystem::path(file).stem().string();
        const auto [same, is_new] = file_of.emplace(name, file);
        if (!call.folder.empty() && !is_new)
          throw InputError("the results of '" + printable(same->second) +
                           "' and '" + printable(file) +
                           "' would have the same folder\n"
                           "  remedy:  solve them by two calls");
      }
    bool solved = true;
    for (const std::string &file : call.files)
      try
        {
          const std::string folder = call.folder.empty()
                                       ? ""
                                       : (std::filesystem::path(call.folder) /
                                          std::filesystem::path(file).stem())
                                           .string();
          solved                   = solve(file, folder, call, log) && solved;
        }
      catch (const Stopped &)
        {
          throw;
        }
      catch (const std::exception &error)
        {
          solved = false;
          std::cerr << printable(file) << ":\nerror: " << text_of(error)
                    << std::endl;
        }
    return solved;
  }

  int
  run(const int argc, char **argv)
  {
    const CommandLine call = parse_command_line(argc,
                                                argv,
                                                "geocone-lab",
                                                {"--check",
                                                 "--defaults",
                                                 "--dry-run",
                                                 "--force",
                                                 "--load-library",
                                                 "--resume",
                                                 "--run-gmsh-script",
                                                 "--schema"},
                                                true);
    const bool        first =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    if (call.version || call.help)
      {
        if (first && call.version)
          print_version("geocone-lab");
        else if (first)
          std::cout << usage;
        return 0;
      }
    if (call.files.empty())
      {
        if (first)
          std::cerr << "error: no file of a problem\n" << usage;
        return 1;
      }
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      throw InputError("geocone-lab works on one rank\n"
                       "  remedy:  call it without mpirun");
    Log        log(MPI_COMM_WORLD, call.quiet);
    const bool solved = call.files.size() == 1
                          ? solve(call.files[0], call.folder, call, log)
                          : solve_all(call, log);
    return solved ? 0 : 1;
  }
} // namespace

int
main(int argc, char **argv)
{
  select_blas_kernels();
  use_one_thread();
  return run_program(argv, [&](Drawing &) { return run(argc, argv); });
}
