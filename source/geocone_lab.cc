// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/hdf5_file.h>
#include <geocone/command_line.h>
#include <geocone/lab/replay.h>
#include <geocone/linear/blas_kernels.h>
#include <geocone/linear/one_thread.h>

#include <deal.II/base/mpi.h>

#include <iostream>

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
    "geocone-lab FILE.h5|FILE.dat|FILE.hdf5 [--output FOLDER]\n"
    "        [--set 'Section/Parameter = value']... [--quiet]\n"
    "\n"
    "Solves a problem again, without a scene: a frozen one\n"
    "('Output/Freeze steps'), one of Siconos (.dat) or FCLib (.hdf5).\n"
    "\n"
    "  --output FOLDER      folder of the results (default: none)\n"
    "  --set 'S/P = value'  overrides an option of the solver, or, of a\n"
    "                       frozen problem, a parameter of Materials\n"
    "  --quiet              nothing on the screen but errors\n"
    "  --help               this text; geocone --help has the parameters\n"
    "  --version            versions of it and its libraries\n"
    "\n"
    "The exit code is 0 if the problem is solved, and 1 otherwise;\n"
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
                                                 "--resume",
                                                 "--run-gmsh-script",
                                                 "--schema"});
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
    if (call.file.empty())
      {
        if (first)
          std::cerr << "error: no file of a problem\n" << usage;
        return 1;
      }
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      throw InputError("geocone-lab works on one rank\n"
                       "  remedy:  call it without mpirun");
    Log        log(MPI_COMM_WORLD, call.quiet);
    const auto solve =
      dimension_of(call.file) == 3 ? dim3::replay : dim2::replay;
    return solve(call.file, call.overrides, call.folder, log) ? 0 : 1;
  }
} // namespace

int
main(int argc, char **argv)
{
  select_blas_kernels();
  use_one_thread();
  return run_program(argv, [&](Drawing &) { return run(argc, argv); });
}
