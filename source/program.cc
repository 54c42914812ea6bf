// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/types.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/command_line.h>
#include <geocone/materials/material_library.h>
#include <geocone/methods.h>
#include <geocone/newton/plan.h>
#include <geocone/output/run_folder.h>
#include <geocone/program.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const char *usage =
      "geocone FILE.prm [--output FOLDER] [--set 'Section/Parameter = "
      "value']...\n"
      "        [--dry-run [--picture]] [--force] [--run-gmsh-script] "
      "[--quiet]\n"
      "mpirun -np RANKS geocone FILE.prm ...\n"
      "geocone --check FILE.prm... [--set 'Section/Parameter = value']...\n"
      "geocone --resume FOLDER [--force] [--run-gmsh-script] [--quiet]\n"
      "\n"
      "  --output FOLDER      folder of the results (default: results/NAME)\n"
      "  --set 'S/P = value'  overrides a parameter of the file; repeatable\n"
      "  --resume FOLDER      goes on with a run that was stopped or killed, "
      "from "
      "its last\n"
      "                       checkpoint (section Checkpoint), in the same "
      "folder\n"
      "  --dry-run            checks everything, prints how large the run is, "
      "and "
      "ends:\n"
      "                       nothing is computed or written\n"
      "  --picture            with --dry-run: draws the model (results/NAME-model, "
      "or\n"
      "                       --output), as each run does\n"
      "  --check FILE.prm...  the same for each of the files, with a line for "
      "each\n"
      "  --force              runs also what is too large for this machine's "
      "memory\n"
      "  --run-gmsh-script    'Geometry/File' may be a geo script, which gmsh "
      "runs: "
      "a program\n"
      "                       that can run commands and write files with your "
      "rights\n"
      "  --quiet              nothing on the screen but errors and warnings\n"
      "  --defaults NEW.prm   writes all parameters with their defaults, "
      "commented,\n"
      "                       into a new file;\n"
      "                       --set 'Materials/soil/Type = LAW' tells those of "
      "other laws\n"
      "  --help               this text, all parameters and the plans of "
      "Newton's method\n"
      "  --version            versions of geocone and its libraries\n"
      "\n"
      "The exit code is 0 if the run has finished and its expectations hold, "
      "and\n"
      "1 otherwise; 130, 143 and 129 after Ctrl-C, SIGTERM and SIGHUP.\n";

    /** Prints all parameters with an example of each kind of named section.
     *  @param overrides e.g. another law of the material 'soil' */
    void
    print_defaults(std::ostream &out, const std::vector<std::string> &overrides)
    {
      const ParameterFile file = ParameterFile::from_text(
        "subsection Boundary conditions\nset Names = footing\n"
        "subsection footing\nend\nend\n"
        "subsection Tractions\nset Names = surcharge\n"
        "subsection surcharge\nend\nend\n",
        "defaults",
        overrides);
      Log     log(MPI_COMM_WORLD, true);
      Methods methods(file, log);
      file.parse();
      ParameterFile::print(out, true);
    }

    /** @throws InputError if --resume is combined with options that change the run */
    void
    check_resume(const CommandLine &call)
    {
      if (!call.file.empty() || !call.folder.empty() || !call.overrides.empty())
        throw InputError(
          "--resume takes no parameter file, --output or --set\n"
          "  remedy:  'geocone --resume FOLDER' goes on with the "
          "parameters that the run has; start another one with "
          "'geocone FILE.prm'");
    }

    /**
     * @throws InputError if a file of that name exists: it may contain a user's work
     */
    void
    write_defaults(const CommandLine &call)
    {
      std::error_code ignored;
      if (std::filesystem::exists(
            std::filesystem::symlink_status(call.defaults_file, ignored)))
        throw InputError("--defaults",
                         call.defaults_file,
                         "a file that is not there yet",
                         "name another one, or delete it yourself");
      write_file(call.defaults_file, [&](std::ostream &out) {
        print_defaults(out, call.overrides);
      });
    }

    bool
    on_first_rank()
    {
      return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    void
    print_help(const std::vector<std::string> &overrides)
    {
      // Lists that are empty by default get an example name.
      std::vector<std::string> with_names = {
        "Absorbing boundaries/Names = base",
        "Obstacles/Names = wall",
        "Contacts/Names = joint"};
      with_names.insert(with_names.end(), overrides.begin(), overrides.end());
      // In one piece, since the reader of a pipe may close it early.
      std::ostringstream text;
      print_defaults(text, with_names);
      std::cout
        << usage
        << "\nAll parameters, with their defaults; absorbing boundaries, "
           "obstacles and contacts are\nnamed to show theirs, and there "
           "are none by default:\n\n"
        << text.str()
        << "\nAttempts of Newton's method at a step, by its properties, until "
           "one "
           "is solved:\n\n"
        << text_of_plans() << std::flush;
      if (!std::cout)
        std::_Exit(0); // else libraries report the closed pipe
    }

    /** Runs or resumes a scene. @return whether its expectations hold */
    bool
    run_scene(const CommandLine &call, Drawing &drawing)
    {
      const ParameterFile::OfOthers of_others = parameters_of_laws();
      const ParameterFile           file      = call.resumed
                                                  ? parameters_of_run(*call.resumed)
                                                  : ParameterFile(call.file, call.overrides);
      Log                           log(MPI_COMM_WORLD, call.quiet);
      Methods                       methods(file, log);
      const std::vector<ParameterFile::Setting> settings =
        file.parse(of_others);
      RunOptions options = run_options(call, file);
      if (call.resumed)
        {
          options.resumes = true;
          options.folder  = *call.resumed;
        }
      if (const std::string unused = unused_parameters(settings);
          !unused.empty() && !call.resumed)
        log.warn(unused);
      Simulation &simulation = methods.chosen();
      bool        ok         = false;
      const auto  draw_later = [&]() {
        const OutputBase &output = simulation.output();
        if (on_first_rank() && !output.folder().empty() &&
            (call.picture || output.wants_pictures()))
          drawing = {output.folder(), call.quiet, call.picture};
      };
      try
        {
          ok = simulation.run(options);
        }
      catch (const StepFailure &)
        {
          draw_later(); // shows the cause
          end_if_alone();
          throw;
        }
      catch (...)
        {
          end_if_alone();
          throw;
        }
      draw_later();
      return ok;
    }

    int
    run(const int argc, char **argv, Drawing &drawing)
    {
      const bool        first = on_first_rank();
      const CommandLine call  = parse_command_line(argc, argv, "geocone");
      if (call.version || call.help || !call.defaults_file.empty())
        {
          if (first && call.version)
            print_version("geocone");
          else if (first && call.help)
            print_help(call.overrides);
          else if (first)
            write_defaults(call);
          return 0;
        }
      if (call.resumed)
        check_resume(call);
      else if (call.file.empty())
        {
          if (first)
            std::cerr << "error: no parameter file\n" << usage;
          return 1;
        }
      return run_scene(call, drawing) ? 0 : 1;
    }
  } // namespace

  void
  check_file(const std::string &file, const CommandLine &call)
  {
    dealii::ParameterAcceptor::clear(); // of an earlier file
    CommandLine one = call;
    one.file        = file;
    one.quiet       = true;
    Drawing nothing;
    run_scene(one, nothing);
  }

  int
  run_geocone(int argc, char **argv)
  {
    return run_program(
      argv, [&](Drawing &drawing) { return run(argc, argv, drawing); });
  }
} // namespace geocone::GEOCONE_DIM
