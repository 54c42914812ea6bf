// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Former name of 'Discretisation/Method = point': calls geocone, in the same folder,
// with that method and all arguments.

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <unistd.h>

int
main(int argc, char **argv)
{
  std::error_code error;
  std::string     program =
    std::filesystem::read_symlink("/proc/self/exe", error).parent_path() /
    "geocone";
  std::vector<std::string> arguments(argv + 1, argv + argc);
  arguments.insert(arguments.begin(), program);
  // A resumed run has the method among its own parameters.
  if (std::count(arguments.begin(), arguments.end(), "--resume") == 0)
    {
      arguments.push_back("--set");
      arguments.push_back("Discretisation/Method = point");
    }
  // The materials of --defaults have the law of soils.
  if (std::count(arguments.begin(), arguments.end(), "--defaults") > 0)
    {
      arguments.push_back("--set");
      arguments.push_back("Materials/soil/Type = subloading");
    }
  std::vector<char *> pointers;
  for (std::string &argument : arguments)
    pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  std::cerr << "error: '" << program << "': " << std::strerror(errno)
            << "\n  remedy:  keep geocone beside element_test" << std::endl;
  return 1;
}
