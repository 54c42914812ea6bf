// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/boundary/contacts.h>

#include <algorithm>
#include <map>

namespace geocone
{
  BodyPair::BodyPair(const std::string &name)
    : dealii::ParameterAcceptor("/Contacts/" + name)
    , name(name)
  {
    add_parameter(
      "Body",
      first,
      "Materials of the first body, comma-separated; contact conditions hold "
      "at its nodes. FEM: choose the body with the finer cells, or else the "
      "softer or smaller one. MPM: either.");
    add_parameter("Other body",
                  other,
                  "Materials of the other body, comma-separated. FEM: the "
                  "bodies are separated along their common edges, where their "
                  "meshes need not match. MPM: each body has its own grid.");
    law.declare(*this);
  }

  void
  BodyPair::prepare(const std::vector<std::string> &materials)
  {
    const std::string section = get_section_name().substr(1) + "/";
    const auto        read    = [&](const std::string              &entry,
                          const std::vector<std::string> &names,
                          std::vector<bool>              &is_in) {
      const std::string known = dealii::Patterns::Tools::to_string(materials);
      is_in.assign(materials.size(), false);
      if (names.empty())
        throw InputError(section + entry,
                         "",
                         "one or more of the materials " + known,
                         "say which material is this body; what is one mesh "
                                   "of one material is one body");
      for (const std::string &name : names)
        {
          const auto at = std::find(materials.begin(), materials.end(), name);
          if (at == materials.end())
            throw InputError(section + entry, name, known, "choose some");
          is_in[at - materials.begin()] = true;
        }
    };
    read("Body", first, is_first);
    read("Other body", other, is_other);
    for (unsigned int m = 0; m < materials.size(); ++m)
      if (is_first[m] && is_other[m])
        throw InputError(section + "Other body",
                         materials[m],
                         "materials that are not in 'Body'",
                         "a body does not touch itself: give each body a "
                         "material of its own, with the same values if need "
                         "be");
    law.check(*this);
  }

  Contacts::Contacts(const ParameterFile &file)
    : NamedList(file,
                "Contacts",
                "Names of contacts of two bodies with friction and separation, "
                "comma-separated; each has a subsection of its name. FEM and "
                "implicit MPM.")
  {
    make();
  }

  void
  Contacts::prepare(const std::vector<std::string> &all_materials)
  {
    materials = all_materials;
    for (const auto &pair : list)
      pair->prepare(materials);
    std::map<std::vector<bool>, unsigned int> numbers;
    for (unsigned int m = 0; m < materials.size(); ++m)
      {
        std::vector<bool> is_in;
        for (const auto &pair : list)
          {
            is_in.push_back(pair->is_first[m]);
            is_in.push_back(pair->is_other[m]);
          }
        body.push_back(numbers.emplace(is_in, numbers.size()).first->second);
      }
    number = numbers.size();
  }

  void
  Contacts::check_all_pairs() const
  {
    for (unsigned int a = 0; a < body.size(); ++a)
      for (unsigned int b = a + 1; b < body.size(); ++b)
        if (body[a] != body[b] && !are_apart(a, b))
          throw InputError(parameter(),
                           dealii::Patterns::Tools::to_string(names()),
                           "a contact between each two bodies of particles: "
                           "between '" +
                             materials[a] + "' and '" + materials[b] +
                             "' there is none",
                           "add one, or name both materials in the same body");
  }

  bool
  Contacts::are_apart(const unsigned int a, const unsigned int b) const
  {
    return std::any_of(list.begin(), list.end(), [&](const auto &pair) {
      return pair->separates(a, b);
    });
  }
} // namespace geocone
