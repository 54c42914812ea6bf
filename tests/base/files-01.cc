// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// A file that cannot be written to its end: the one before it stays as it was,
// and nothing temporary is left, whatever the writer throws.

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>

#include <deal.II/base/exceptions.h>

#include "../test.h"

#include <cstdio>
#include <filesystem>
#include <new>
#include <sstream>

namespace base_files_01
{
  using namespace geocone;

  const std::string name = "files-01.txt";

  std::string
  content()
  {
    std::ifstream      in(name);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  template <typename Thrown>
  void
  check(const char *what, const std::function<void(std::ostream &)> &write)
  {
    bool thrown = false;
    try
      {
        write_file(name, write);
      }
    catch (const Thrown &)
      {
        thrown = true;
      }
    std::printf(
      "%s: thrown %s, the file before it is kept %s, nothing else %s\n",
      what,
      thrown ? "yes" : "NO",
      content() == "whole\n" ? "yes" : "NO",
      std::filesystem::exists(name + ".part") ? "NO" : "yes");
  }

  void
  test()
  {
    write_file(name, [](std::ostream &out) { out << "whole\n"; });
    std::printf("written: %s", content().c_str());
    check<std::bad_alloc>("no memory", [](std::ostream &out) {
      out << "a part";
      throw std::bad_alloc();
    });
    check<RunError>("stream has failed", [](std::ostream &out) {
      out << "a part";
      out.setstate(std::ios::failbit);
    });
    check<RunError>("an error of the library", [](std::ostream &out) {
      out << "a part";
      AssertThrow(false, dealii::ExcIO());
    });
    std::filesystem::remove(name);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace base_files_01
