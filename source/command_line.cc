// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/version.h>
#include <geocone/command_line.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace geocone
{
  CommandLine
  parse_command_line(const int                       argc,
                     char                          **argv,
                     const std::string              &program,
                     const std::vector<std::string> &own)
  {
    CommandLine call;
    const auto  value = [&](int &i) {
      if (i + 1 >= argc)
        throw InputError(std::string("the option ") + argv[i] +
                         " needs a value\n  remedy:  see " + program +
                         " --help");
      return std::string(argv[++i]);
    };
    for (int i = 1; i < argc; ++i)
      {
        const std::string argument = argv[i];
        if (argument == "--output")
          call.folder = value(i);
        else if (argument == "--set")
          call.overrides.push_back(value(i));
        else if (argument == "--quiet")
          call.quiet = true;
        else if (argument == "--help" || argument == "-h")
          call.help = true;
        else if (argument == "--version")
          call.version = true;
        else if (argument == "--defaults")
          call.defaults_file = value(i);
        else if (std::count(own.begin(), own.end(), argument) > 0)
          call.own[argument] = value(i);
        else if (!argument.empty() && argument[0] == '-')
          throw InputError("unknown option '" + argument +
                           "'\n  remedy:  see " + program + " --help");
        else if (call.file.empty())
          call.file = argument;
        else
          throw InputError("a second parameter file '" + argument +
                           "'\n  remedy:  give one; overrides go into --set");
      }
    return call;
  }

  std::string
  drawing_command(const std::string &folder, const bool quiet)
  {
    return "'" GEOCONE_SOURCE_DIR "/scripts/plot' '" + folder + "'" +
           (quiet ? " >/dev/null" : "");
  }

  void
  draw(const std::string &drawing_command)
  {
    if (!drawing_command.empty() && std::system(drawing_command.c_str()) != 0)
      std::cerr << "warning: no pictures: " << drawing_command << " failed"
                << std::endl;
  }
} // namespace geocone
