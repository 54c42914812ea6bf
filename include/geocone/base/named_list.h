// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_named_list_h
#define geocone_base_named_list_h

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Named members of a section, "SECTION/Names = a, b". Each declares a
   * subsection of its own name.
   */
  template <typename Member>
  class NamedList : public dealii::ParameterAcceptor
  {
  public:
    /** Members in the order of their names in the file. */
    std::vector<std::unique_ptr<Member>> list;

    const std::vector<std::string> &
    names() const
    {
      return all_names;
    }

    /** Prepares all members. */
    void
    prepare()
    {
      for (const auto &member : list)
        member->prepare();
    }

    /** @throws InputError if the list is not empty. @param what does not
     *  support it */
    void
    refuse(const std::string &what, const std::string &remedy) const
    {
      if (!list.empty())
        throw InputError(parameter(),
                         dealii::Patterns::Tools::to_string(all_names),
                         "none with " + what,
                         remedy);
    }

  protected:
    /** Declares the list @p entry.
     *  @param otherwise the names if the file has no list */
    NamedList(const ParameterFile &file,
              const std::string   &section,
              const std::string   &documentation,
              const std::string   &otherwise = "",
              const std::string   &entry     = "Names")
      : dealii::ParameterAcceptor("/" + section)
      , entry(entry)
      , all_names(file.named_sections(section, entry, otherwise))
    {
      add_parameter(entry, all_names, documentation);
    }

    /** Creates the members, each from its name and @p arguments. */
    template <typename... Arguments>
    void
    make(const Arguments &...arguments)
    {
      for (const std::string &name : all_names)
        list.push_back(std::make_unique<Member>(name, arguments...));
    }

    /** @throws InputError if the list is empty. @param example of a name */
    void
    require_one(const std::string &example) const
    {
      if (all_names.empty())
        throw InputError(parameter(),
                         "",
                         "at least one name",
                         "set " + entry + " = " + example);
    }

    /** Full parameter name of the list. */
    std::string
    parameter() const
    {
      return get_section_name().substr(1) + "/" + entry;
    }

  private:
    const std::string        entry;
    std::vector<std::string> all_names;
  };
} // namespace geocone

#endif
