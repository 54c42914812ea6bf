// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Runs one of the tests that are compiled into this program.

#include "test.h"

#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <string>

namespace
{
  using Tests = std::map<std::string, std::function<void(int, char **)>>;

  /** There before the first test registers itself, which is before main(). */
  Tests &
  all_tests()
  {
    static Tests tests;
    return tests;
  }

  std::string
  name_of(const std::filesystem::path &file)
  {
    return file.parent_path().filename() / file.stem();
  }
} // namespace

RegisteredTest::RegisteredTest(const char *file, void (*test)())
{
  all_tests()[name_of(file)] = [test](int, char **) { test(); };
}

RegisteredTest::RegisteredTest(const char *file, void (*test)(int, char **))
{
  all_tests()[name_of(file)] = test;
}

int
main(int argc, char **argv)
{
  const auto found = argc > 1 ? all_tests().find(argv[1]) : all_tests().end();
  if (found == all_tests().end())
    {
      std::cerr << "usage: " << argv[0] << " TEST [ARGUMENT...]\n";
      for (const auto &[name, test] : all_tests())
        std::cerr << "  " << name << "\n";
      return 1;
    }
  argv[1] = argv[0];
  found->second(argc - 1, argv + 1);
}
