// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_lab_replay_h
#define geocone_lab_replay_h

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/base/types.h>
#include <geocone/folder/run_folder.h>

#include <deal.II/base/parameter_acceptor.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Repeats the solution of a problem stored in a file, on one MPI rank and without the
   * scene. The file contains an incremental problem in HDF5 (FrozenProblem), or a
   * reduced problem in the format of Siconos or FCLib (ReducedProblem).
   *
   * @param overrides parameters of the sections Newton, Linear solver, Time stepping
   * (friction), Materials and Output ('If folder exists', as for runs), as on the
   * command line
   * @param folder for summary.json, stress.csv and the parameters; empty: no output
   * @return whether the problem was solved
   * @throws InputError, RunError
   */
  bool
  replay(const std::string              &file_name,
         const std::vector<std::string> &overrides,
         const std::string              &folder,
         Log                            &log);

  // Common parts of replays of incremental and of reduced problems.

  /** Output folder of a replay (repeated solution of a stored problem). */
  class ResultFolder : public dealii::ParameterAcceptor
  {
  public:
    explicit ResultFolder(const std::string &path)
      : dealii::ParameterAcceptor("/Output")
      , path(path)
    {
      if_exists.declare(*this,
                        "If folder exists",
                        ". How to treat a folder that is not empty.");
    }

    /** Creates the output folder unless the path is empty.
     *  @throws InputError */
    void
    make()
    {
      if (!path.empty())
        path = make_run_folder(MPI_COMM_SELF, path, true, if_exists);
    }

    std::string path; ///< empty: no output

  private:
    Choice<IfExists> if_exists = if_exists_choice();
  };

  /** Calls a function that reads a file, and appends a suggested remedy to its
   *  error messages. Messages that already contain a remedy are not changed. */
  template <typename Read>
  auto
  read_with_remedy(const Read &read, const std::string &remedy)
  {
    try
      {
        return read();
      }
    catch (const RunError &error)
      {
        const std::string text = error.what();
        if (text.find("\n  remedy:") != std::string::npos)
          throw;
        throw RunError(text + "\n  remedy:  " + remedy);
      }
  }

  /** Result of a replay (repeated solution): summary for comparisons, and stresses
   *  (Pa). */
  struct ReplayResult
  {
    nlohmann::json      summary;
    std::vector<Mandel> stress;
  };

  /** Returns true if a file contains a reduced problem in the format of Siconos or
   *  FCLib. Available in two dimensions only. */
  bool
  is_reduced_problem(const std::string &file_name);

  /** Reads a reduced problem (cone complementarity problem) from a file and solves
   *  it. */
  ReplayResult
  replay_reduced(const std::string              &file_name,
                 const std::vector<std::string> &overrides,
                 ResultFolder                   &folder);
} // namespace geocone::GEOCONE_DIM

#endif
