// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/command_line.h>
#include <geocone/folder/run_folder.h>
#include <geocone/folder/watcher.h>
#include <geocone/linear/blas_kernels.h>
#include <geocone/linear/one_thread.h>
#include <geocone/program.h>

#include <iostream>

// Three-dimensional counterpart of program.h.
namespace geocone::dim3
{
  int
  run_geocone(int argc, char **argv);
  void
  check_file(const std::string &file, const CommandLine &call);
} // namespace geocone::dim3

namespace
{
  using namespace geocone;

  /** Dimension of a scene by its parameter file, or by that of the run to be resumed.
   *  Errors in these are reported by the program of plane scenes. */
  unsigned int
  dimension_of(const std::string &file, const CommandLine &call)
  {
    try
      {
        const ParameterFile parameters =
          call.resumed   ? parameters_of_run(*call.resumed)
          : file.empty() ? ParameterFile::from_text("", "call", call.overrides)
                         : ParameterFile(file, call.overrides);
        return parameters.peek("Geometry/Dimension", "2") == "3" ? 3 : 2;
      }
    catch (const std::exception &)
      {
        return 2;
      }
  }

  /** Checks each of the files and prints the valid ones. @return the exit code */
  int
  check_files(const CommandLine &call)
  {
    int status = 0;
    for (const std::string &file : call.files)
      {
        std::cout << printable(file) << ": " << std::flush;
        try
          {
            if (dimension_of(file, call) == 3)
              dim3::check_file(file, call);
            else
              dim2::check_file(file, call);
            std::cout << "right" << std::endl;
          }
        catch (const std::exception &error)
          {
            status = 1;
            std::cout << "refused\nerror: " << text_of(error) << std::endl;
          }
      }
    return status;
  }

} // namespace

int
main(int argc, char **argv)
{
  select_blas_kernels();
  use_one_thread();
  const Watcher watcher;
  CommandLine   call; // the program of plane scenes reports errors
  try
    {
      call = parse_command_line(argc, argv, "geocone");
    }
  catch (const std::exception &)
    {}
  if (!call.files.empty())
    return run_program(argv, [&](Drawing &) { return check_files(call); });
  return dimension_of(call.file, call) == 3 ? dim3::run_geocone(argc, argv)
                                            : dim2::run_geocone(argc, argv);
}
