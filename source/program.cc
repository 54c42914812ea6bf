// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_reference.h>
#include <geocone/base/renamed_parameters.h>
#include <geocone/base/types.h>
#include <geocone/base/unused_parameters.h>
#include <geocone/command_line.h>
#include <geocone/folder/run_folder.h>
#include <geocone/laws/material_library.h>
#include <geocone/methods.h>
#include <geocone/newton/plan.h>
#include <geocone/program.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <utility>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    const char *usage =
      "geocone FILE.prm [--output FOLDER] [--set 'Section/Parameter = "
      "value']...\n"
      "        [--dry-run [--picture]] [--force] [--run-gmsh-script] "
      "[--load-library]\n"
      "        [--quiet]\n"
      "mpirun -np RANKS geocone FILE.prm ...\n"
      "geocone --check FILE.prm... [--set 'Section/Parameter = value']...\n"
      "geocone --resume FOLDER [--force] [--run-gmsh-script] "
      "[--load-library] [--quiet]\n"
      "geocone --help [SECTION | PARAMETER | all]\n"
      "\n"
      "  --output FOLDER      folder of the results (default: results/NAME)\n"
      "  --set 'S/P = value'  overrides a parameter of the file; repeatable\n"
      "  --resume FOLDER      continues a run that was stopped or killed, from "
      "its last\n"
      "                       checkpoint (section Checkpoint), in the same "
      "folder\n"
      "  --dry-run            checks the file and prints the size of the run, "
      "without\n"
      "                       computing or writing anything\n"
      "  --picture            with --dry-run: draws the model "
      "(results/NAME-model, or\n"
      "                       --output), as each run does\n"
      "  --check FILE.prm...  --dry-run of several files, with a line for "
      "each\n"
      "  --force              also runs models too large for the memory of "
      "this machine\n"
      "  --run-gmsh-script    allows 'Geometry/File' to be a geo script, which "
      "gmsh runs:\n"
      "                       it can run commands and write files with your "
      "rights\n"
      "  --load-library       allows 'Materials/NAME/Library', a shared object "
      "with a law\n"
      "                       (Type = umat): it is a program with your rights\n"
      "  --quiet              prints only errors and warnings\n"
      "  --defaults NEW.prm   writes all parameters with their defaults and "
      "comments into\n"
      "                       a new file; with --set 'Materials/soil/Type = "
      "LAW' those of\n"
      "                       another constitutive law\n"
      "  --help               this text\n"
      "  --help SECTION       the parameters of a section, e.g. Materials\n"
      "  --help PARAMETER     those of a name, e.g. Cohesion or 'Time "
      "stepping/Friction'\n"
      "  --help all           all parameters, and the strategies of Newton's "
      "method\n"
      "  --schema             JSON Schema of all parameters; of "
      "three-dimensional models\n"
      "                       (also --help) with --set 'Geometry/Dimension = "
      "3'\n"
      "  --version            versions of geocone and its libraries\n"
      "\n"
      "The exit code is 0 if the run has finished and its expectations hold, "
      "and\n"
      "1 otherwise; 130, 143 and 129 after Ctrl-C, SIGTERM and SIGHUP.\n";

    /** Declares the parameters of all methods, as for the run of a text. */
    std::vector<DocumentedParameter>
    declared(const std::string &text, const std::vector<std::string> &overrides)
    {
      dealii::ParameterAcceptor::clear();
      const ParameterFile file =
        ParameterFile::from_text(text, "defaults", overrides);
      Log     log(MPI_COMM_WORLD, true);
      Methods methods(file, log);
      file.parse();
      return documented_parameters();
    }

    /** All parameters with their defaults: of members of lists once, with any_name for
     *  theirs, and of materials those of all laws. */
    std::vector<DocumentedParameter>
    all_parameters()
    {
      const std::vector<std::string> dimension = {"Geometry/Dimension = " +
                                                  std::to_string(dim)};
      const std::vector<std::string> laws      = material_types();
      std::string                    names, text; // materials named after laws
      for (const std::string &law : laws)
        {
          names += (names.empty() ? "" : ", ") + law;
          text += "subsection " + law + "\nset Type = " + law + "\nend\n";
        }
      text =
        "subsection Materials\nset Names = " + names + "\n" + text + "end\n";
      std::vector<const char *> lists = {"Boundary conditions",
                                         "Tractions",
                                         "Absorbing boundaries",
                                         "Seepage",
                                         "Obstacles",
                                         "Contacts",
                                         "Structures"};
      if (dim == 2)
        lists.push_back("Random fields");
      for (const char *list : lists)
        text += std::string("subsection ") + list +
                "\nset Names = " + any_name + "\nend\n";
      std::map<std::string, std::string> defaults;
      for (const DocumentedParameter &parameter : declared("", dimension))
        defaults[parameter.path()] = parameter.value;
      std::vector<DocumentedParameter>                all;
      std::map<std::string, std::vector<std::string>> members;
      for (DocumentedParameter &parameter : declared(text, dimension))
        {
          std::string member;
          if (parameter.sections.size() > 1)
            member = std::exchange(parameter.sections[1], any_name);
          else
            parameter.value = defaults.at(parameter.path());
          members[parameter.path()].push_back(member);
          if (members[parameter.path()].size() == 1)
            all.push_back(parameter);
        }
      for (DocumentedParameter &parameter : all)
        {
          parameter.conditions = conditions_of_use(parameter.path());
          const auto &having   = members[parameter.path()];
          if (parameter.sections[0] == "Materials" &&
              parameter.sections.size() > 1 && having.size() < laws.size())
            {
              const bool  is_of_most = having.size() > laws.size() / 2;
              std::string types;
              for (const std::string &law : laws)
                if ((std::count(having.begin(), having.end(), law) > 0) !=
                    is_of_most)
                  types += (types.empty() ? "" : " or ") + law;
              parameter.conditions.own.push_back(
                "Materials/NAME/Type = " +
                std::string(is_of_most ? "any but " : "") + types);
            }
        }
      return all;
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
      const std::vector<DocumentedParameter> parameters =
        declared("subsection Boundary conditions\nset Names = footing\nend\n"
                 "subsection Tractions\nset Names = surcharge\nend\n",
                 call.overrides);
      write_file(call.defaults_file,
                 [&](std::ostream &out) { print(out, parameters); });
    }

    bool
    on_first_rank()
    {
      return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    /** @param topic empty: options and sections */
    void
    print_help(const std::string &topic)
    {
      if (topic.empty())
        {
          std::cout << usage << "\nSections of parameters (--help SECTION):\n\n"
                    << list_of_sections();
          return;
        }
      const std::vector<DocumentedParameter> found =
        on_topic(all_parameters(), topic);
      print(std::cout, found);
      if (std::any_of(found.begin(), found.end(), [](const auto &parameter) {
            return parameter.path() == "Newton/Maximum iterations";
          }))
        std::cout << "\nStrategies of Newton's method in a step, by its "
                     "properties, tried in turn until one\nconverges:\n\n"
                  << text_of_plans();
    }

    /** Prints what an option asks for in place of a run. */
    void
    print_asked(const CommandLine &call)
    {
      if (call.version)
        print_version("geocone");
      else if (call.help)
        print_help(*call.help);
      else
        std::cout << json_schema(all_parameters()) << "\n";
      std::cout << std::flush;
      if (!std::cout)  // the reader of a pipe may close it early
        std::_Exit(0); // else libraries report the closed pipe
    }

    /** Runs or resumes a scene. @return whether its expectations hold */
    bool
    run_scene(const CommandLine &call, Drawing &drawing)
    {
      const ParameterFile::ParametersOfOtherKinds of_others =
        parameters_of_laws();
      const ParameterFile                       file = call.resumed
                                                         ? parameters_of_run(*call.resumed)
                                                         : ParameterFile(call.file, call.overrides);
      Log                                       log(MPI_COMM_WORLD, call.quiet);
      Methods                                   methods(file, log);
      const std::vector<ParameterFile::Setting> settings =
        file.parse(of_others);
      RunOptions options = run_options(call, file);
      if (call.resumed)
        {
          options.resumes = true;
          options.folder  = *call.resumed;
        }
      for (const std::string &warning :
           {former_names(settings), unused_parameters(settings)})
        if (!warning.empty() && !call.resumed)
          log.warn(warning);
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
      if (call.version || call.help || call.schema)
        {
          if (first)
            print_asked(call);
          return 0;
        }
      if (!call.defaults_file.empty())
        {
          if (first)
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
