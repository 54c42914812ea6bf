// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_boundary_acting_stages_h
#define geocone_boundary_acting_stages_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace geocone
{
  /** Stages of the loading programme in which a structure or condition is
   *  active, from the parameter 'Active in'. */
  class ActingStages
  {
  public:
    /** Declares the parameter 'Active in' in a section of the parameter file.
     *  @param rest second part of the documentation of the parameter */
    void
    declare(dealii::ParameterAcceptor &section, const std::string &rest);

    /** Checks that all selected stages exist in the loading programme.
     *  @param parameter full name of the parameter, for error messages
     *  @param all names of all stages
     *  @throws InputError for an unknown stage */
    void
    check(const std::string              &parameter,
          const std::vector<std::string> &all) const;

    bool
    are_all() const
    {
      return list.empty();
    }

    bool
    include(const std::string &stage) const;

    /** Names of the selected stages. If empty, all stages are selected. */
    const std::vector<std::string> &
    names() const
    {
      return list;
    }

    /** Name of the parameter that selects the stages. */
    static constexpr const char *entry = "Active in";

  private:
    std::vector<std::string> list;
  };
} // namespace geocone

#endif
