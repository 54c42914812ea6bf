// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/stop_request.h>
#include <geocone/base/version.h>
#include <geocone/command_line.h>
#include <geocone/laws/umat_library.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>
#include <new>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace geocone
{
  namespace
  {
    /** Path of the plotting program, next to this one in the build or installation;
     *  empty if not there. */
    std::string
    plot_program()
    {
      std::error_code             error;
      const std::filesystem::path folder =
        std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
      for (const char *place :
           {"scripts/plot", "../share/geocone/scripts/plot"})
        if (std::filesystem::exists(folder / place, error))
          return (folder / place).lexically_normal().string();
      return "";
    }

    /** Whether this program was started without mpirun (or similar). */
    bool
    is_started_alone()
    {
      for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
        if (std::getenv(name))
          return false;
      return true;
    }

    /** Keeps hwloc, started by MPI, from querying X servers for graphics cards, unless
     *  the user has asked for that. */
    void
    leave_displays_alone()
    {
      const char *const present = std::getenv("HWLOC_COMPONENTS");
      const std::string asked   = present == nullptr ? "" : present;
      if (("," + asked + ",").find(",gl,") == std::string::npos)
        setenv("HWLOC_COMPONENTS",
               (asked + (asked.empty() ? "" : ",") + "-gl").c_str(),
               1);
    }

    /** Runs the plotting program with the folder as its argument, without a shell. */
    void
    draw(const Drawing &drawing)
    {
      const auto fail = [](const std::string &why) {
        std::cerr << "warning: no pictures: " << why << std::endl;
      };
      std::string plot = plot_program();
      if (plot.empty())
        return fail("scripts/plot is not beside the program");
      // An absolute name cannot be mistaken for an option.
      std::string folder = std::filesystem::absolute(drawing.folder).string();
      std::string only_model  = "--model";
      char *const arguments[] = {plot.data(),
                                 folder.data(),
                                 drawing.only_model ? only_model.data()
                                                    : nullptr,
                                 nullptr};
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      if (drawing.quiet)
        posix_spawn_file_actions_addopen(
          &actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
      pid_t     child = -1;
      const int error = posix_spawn(
        &child, plot.c_str(), &actions, nullptr, arguments, environ);
      posix_spawn_file_actions_destroy(&actions);
      int status = 0;
      if (error != 0)
        return fail(plot + ": " + std::strerror(error));
      while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
      if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail(plot + " '" + folder + "' failed");
    }

    /** Rejects options that exclude each other. @throws InputError */
    void
    check_combination(const CommandLine &call,
                      const bool         checks,
                      const std::string &program)
    {
      if (checks && (call.files.empty() || !call.file.empty()))
        throw InputError("--check needs parameter files, after it\n"
                         "  remedy:  see " +
                         program + " --help");
      if (call.picture && (!call.dry_run || checks))
        throw InputError(
          "--picture goes with --dry-run: a run draws its model "
          "always\n  remedy:  geocone --dry-run FILE.prm --picture");
    }
  } // namespace

  CommandLine
  parse_command_line(const int                       argc,
                     char                          **argv,
                     const std::string              &program,
                     const std::vector<std::string> &lacking,
                     const bool                      many)
  {
    CommandLine call;
    const auto  value = [&](int &i) {
      if (i + 1 >= argc)
        throw InputError(std::string("the option ") + argv[i] +
                         " needs a value\n  remedy:  see " + program +
                         " --help");
      return std::string(argv[++i]);
    };
    const auto unknown = [&](const std::string &argument) {
      return InputError("unknown option '" + printable(argument) +
                        "'\n  remedy:  see " + program + " --help");
    };
    bool checks = false;
    const std::map<std::string, bool *> flags  = {
       {"--quiet", &call.quiet},
       {"--dry-run", &call.dry_run},
       {"--picture", &call.picture},
       {"--check", &checks},
       {"--force", &call.force},
       {"--run-gmsh-script", &call.may_run_scripts},
       {option_for_libraries, &may_load_libraries()},
       {"--schema", &call.schema},
       {"--version", &call.version}};
    for (int i = 1; i < argc; ++i)
      {
        const std::string argument = argv[i];
        if (std::count(lacking.begin(), lacking.end(), argument) > 0)
          throw unknown(argument);
        else if (argument == "--output")
          {
            call.folder = value(i);
            if (call.folder.empty())
              throw InputError("the option --output needs the name of a folder"
                               "\n  remedy:  leave it out for results/NAME");
          }
        else if (argument == "--set")
          call.overrides.push_back(value(i));
        else if (const auto flag = flags.find(argument); flag != flags.end())
          *flag->second = true;
        else if (argument == "--help" || argument == "-h")
          {
            // The names of sections have blanks: all words up to the next option.
            call.help = "";
            while (i + 1 < argc && argv[i + 1][0] != '-')
              *call.help +=
                (call.help->empty() ? "" : " ") + std::string(argv[++i]);
          }
        else if (argument == "--defaults")
          call.defaults_file = value(i);
        else if (argument == "--resume")
          call.resumed = value(i);
        else if (argument == "--replay")
          throw InputError("the option --replay is now a program\n"
                           "  remedy:  geocone-lab FILE, with the same "
                           "--output and --set");
        else if (!argument.empty() && argument[0] == '-')
          throw unknown(argument);
        else if (checks || many)
          call.files.push_back(argument);
        else if (call.file.empty())
          call.file = argument;
        else
          throw InputError("a second parameter file '" + printable(argument) +
                           "'\n  remedy:  give one; overrides go into --set");
      }
    if (checks)
      call.dry_run = true;
    check_combination(call, checks, program);
    return call;
  }

  void
  print_version(const std::string &program)
  {
    std::cout << program << " " << version << " (deal.II "
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
  }

  RunOptions
  run_options(const CommandLine &call, const ParameterFile &file)
  {
    RunOptions options;
    options.name            = file.name();
    options.parameter_file  = file.path();
    options.folder          = call.folder;
    options.dry_run         = call.dry_run;
    options.picture         = call.picture;
    options.force           = call.force;
    options.may_run_scripts = call.may_run_scripts;
    return options;
  }

  namespace
  {
    /** Message of the present exception. */
    std::string
    text_of_present_error()
    {
      try
        {
          throw;
        }
      catch (const std::exception &error)
        {
          return text_of(error);
        }
      catch (...)
        {
          return "of a kind that is not known\n  remedy:  report it to the "
                 "authors, "
                 "with the parameter file";
        }
    }

    /** Whether all ranks have thrown the present exception together. */
    bool
    present_error_is_of_all_ranks()
    {
      try
        {
          throw;
        }
      catch (const std::exception &error)
        {
          return dynamic_cast<const InputError *>(&error) != nullptr ||
                 dynamic_cast<const StepFailure *>(&error) != nullptr ||
                 dynamic_cast<const Stopped *>(&error) != nullptr;
        }
      catch (...)
        {
          return false;
        }
    }
  } // namespace

  void
  end_if_alone()
  {
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1 &&
        !present_error_is_of_all_ranks())
      end_all_ranks(text_of_present_error());
  }

  int
  run_program(char **argv, const std::function<int(Drawing &)> &run)
  {
    // MPI would end without a message.
    if (std::error_code error; std::filesystem::current_path(error).empty())
      {
        say_error("the folder in which the program is called cannot be read (" +
                  error.message() +
                  ")\n  remedy:  it was deleted or closed: change into another "
                  "one");
        return 1;
      }
    // PETSc and Kokkos, which deal.II may start, would interpret our options as theirs.
    int     n_arguments_for_libraries = 1;
    Drawing drawing;
    int     status = 1;
    leave_displays_alone();
    if (is_started_alone())
      {
        // Open MPI would start a daemon, only needed to start further processes, and
        // make a folder shared by all such runs. A run that ends may remove it while
        // another makes its own in it, which then fails.
        setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
        setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
        // A single process needs no communication, and initialising network libraries
        // takes 40 % of the startup time.
        setenv("OMPI_MCA_pml", "ob1", 0);
        setenv("OMPI_MCA_btl", "self", 0);
      }
    {
      dealii::Utilities::MPI::MPI_InitFinalize mpi(
        n_arguments_for_libraries, argv, 1);
      watch_for_signals();
      const bool first =
        dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      try
        {
          status = run(drawing);
        }
      catch (const Stopped &stopped)
        {
          if (first)
            std::cerr << stopped.what() << std::endl;
          status = 128 + stopped.signal;
        }
      catch (...)
        {
          end_if_alone();
          if (first)
            say_error(text_of_present_error());
        }
    }
    if (!drawing.folder.empty())
      draw(drawing);
    return status;
  }
} // namespace geocone
