// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/version.h>
#include <geocone/command_line.h>
#include <geocone/element/element_test.h>
#include <geocone/unused_parameters.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace
{
  using namespace geocone;

  const char *usage =
    "element_test FILE.prm [--output FOLDER] [--set 'Section/Parameter = "
    "value']...\n"
    "             [--dry-run] [--quiet]\n"
    "\n"
    "Drives one material point along a path in stages (doc/element_test.md).\n"
    "\n"
    "  --output FOLDER      folder of the results (default: results/NAME)\n"
    "  --set 'S/P = value'  overrides a parameter of the file; repeatable\n"
    "  --dry-run            checks everything and ends: nothing is written\n"
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
  run(const int argc, char **argv, Drawing &drawing)
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
        const ParameterFile::OfOthers of_others = parameters_of_laws();
        const ParameterFile           file(call.file, call.overrides);
        Log                           log(MPI_COMM_WORLD, call.quiet);
        ElementTest                   test(MPI_COMM_WORLD, file, log);
        const std::string unused = unused_parameters(file.parse(of_others));
        if (!unused.empty())
          log.warn(unused);
        const bool ok = test.run(run_options(call, file));
        if (!call.dry_run && test.output().wants_pictures())
          drawing = {test.output().folder(), call.quiet};
        return ok ? 0 : 1;
      }
    return 0;
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_program(
    argc, argv, [&](Drawing &drawing) { return run(argc, argv, drawing); });
}
