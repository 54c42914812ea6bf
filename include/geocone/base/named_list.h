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
   * List of named objects, declared in the parameter file as "SECTION/Names =
   * a, b". Each object declares a subsection of its own name.
   */
  template <typename Member>
  class NamedList : public dealii::ParameterAcceptor
  {
  public:
    /** List members, in the order of their names in the parameter file. */
    std::vector<std::unique_ptr<Member>> list;

    const std::vector<std::string> &
    names() const
    {
      return all_names;
    }

    /** Calls prepare() on each member of the list. */
    void
    prepare()
    {
      for (const auto &member : list)
        member->prepare();
    }

    /** Throws InputError if the list of objects is not empty.
     *  @param what method or option that does not support the list
     *  @throws InputError if the list is not empty */
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
    /** Declares the parameter @p entry, which contains the list of names.
     *  @param otherwise default list of names */
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

    /** Constructs each list member from its name and @p arguments. */
    template <typename... Arguments>
    void
    make(const Arguments &...arguments)
    {
      for (const std::string &name : all_names)
        list.push_back(std::make_unique<Member>(name, arguments...));
    }

    /** Throws InputError if the list of objects is empty.
     *  @param example name suggested in the error message
     *  @throws InputError if the list is empty */
    void
    require_one(const std::string &example) const
    {
      if (all_names.empty())
        throw InputError(parameter(),
                         "",
                         "at least one name",
                         "set " + entry + " = " + example);
    }

    /** Full path of the parameter that contains the list of names, e.g.
     *  "Materials/Names". */
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
