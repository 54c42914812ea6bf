// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Calls geocone with all arguments and --run-gmsh-script, for tests with geo scripts.

#include <vector>

#include <unistd.h>

int
main(int argc, char **argv)
{
  char                program[] = GEOCONE_PROGRAM;
  char                option[]  = "--run-gmsh-script";
  std::vector<char *> arguments(argv, argv + argc);
  arguments[0] = program;
  arguments.push_back(option);
  arguments.push_back(nullptr);
  execv(program, arguments.data());
  return 127;
}
