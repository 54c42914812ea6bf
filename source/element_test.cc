// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/version.h>
#include <geocone/command_line.h>
#include <geocone/element/element_test.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>

namespace
{
  using namespace geocone;

  const char *usage =
    "element_test FILE.prm [--output FOLDER] [--set 'Section/Parameter = "
    "value']...\n"
    "             [--quiet]\n"
    "\n"
    "Drives one material point along a path in stages (doc/element_test.md).\n"
    "\n"
    "  --output FOLDER      folder of the results (default: results/NAME)\n"
    "  --set 'S/P = value'  overrides a parameter of the file; repeatable\n"
    "  --quiet              nothing on the screen but errors and warnings\n"
    "  --defaults NEW.prm   writes all parameters with their defaults, "
    "commented\n"
    "  --help               this text and all parameters\n"
    "  --version            version of geocone\n"
    "\n"
    "The exit code is 0 if the path has been followed and its expectations "
    "hold,\n"
    "and 1 otherwise.\n";

  /** All parameters, with those of one law as an example. */
  void
  print_defaults(std::ostream &out)
  {
    const ParameterFile file = ParameterFile::from_text(
      "subsection Materials\nset Names = soil\nsubsection soil\n"
      "set Type = subloading\nend\nend\n",
      "defaults",
      {});
    Log         log(MPI_COMM_WORLD, true);
    ElementTest test(MPI_COMM_WORLD, file, log);
    file.parse();
    ParameterFile::print(out, true);
  }

  int
  run(const int argc, char **argv, std::string &drawing)
  {
    const CommandLine call = parse_command_line(argc, argv, "element_test");
    if (call.version)
      std::cout << "element_test " << version << std::endl;
    else if (call.help)
      {
        std::cout << usage << "\nAll parameters, with their defaults:\n\n";
        print_defaults(std::cout);
      }
    else if (!call.defaults_file.empty())
      write_file(call.defaults_file, &print_defaults);
    else if (call.file.empty())
      {
        std::cerr << "error: no parameter file\n" << usage;
        return 1;
      }
    else
      {
        const ParameterFile file(call.file, call.overrides);
        Log                 log(MPI_COMM_WORLD, call.quiet);
        ElementTest         test(MPI_COMM_WORLD, file, log);
        file.parse();
        const bool ok = test.run(
          std::filesystem::path(call.file).stem().string(), call.folder);
        if (test.output().wants_pictures())
          drawing = drawing_command(test.output().folder(), call.quiet);
        return ok ? 0 : 1;
      }
    return 0;
  }
} // namespace

int
main(int argc, char **argv)
{
  std::string drawing;
  int         status = 1;
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    try
      {
        status = run(argc, argv, drawing);
      }
    catch (const std::exception &error)
      {
        std::cerr << "error: " << error.what() << std::endl;
      }
  }
  draw(drawing);
  return status;
}
