// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_contacts_h
#define geocone_scene_contacts_h

#include <geocone/base/named_list.h>
#include <geocone/scene/interface_law.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Two bodies, each of some materials, that touch, rub and part: their meshes are
   * not joined, and their particles move nodes of their own. Where they touch, the force
   * of the other body on the nodes of the first and the relative velocity obey
   * Signorini's and Coulomb's laws.
   */
  class BodyPair : public dealii::ParameterAcceptor
  {
  public:
    explicit BodyPair(const std::string &name);

    /** @param materials names of all. @throws InputError */
    void
    prepare(const std::vector<std::string> &materials);

    /** Whether one material is of the first body and one of the other. */
    bool
    separates(const unsigned int a, const unsigned int b) const
    {
      return (is_first[a] && is_other[b]) || (is_first[b] && is_other[a]);
    }

    const std::string name;
    InterfaceLaw      law;

    /** Which materials, by number, are the first body, and the other one. */
    std::vector<bool> is_first, is_other;

  private:
    std::vector<std::string> first, other;
  };

  /** The contacts of a scene, named in the list "Contacts/Names". */
  class Contacts : public NamedList<BodyPair>
  {
  public:
    explicit Contacts(const ParameterFile &file);

    void
    prepare(const std::vector<std::string> &materials);

    /** Whether two materials belong to bodies that only touch. */
    bool
    are_apart(const unsigned int a, const unsigned int b) const;

    /** The body of a material, counted from 0: materials that are in the same bodies of
     *  all contacts are one. Without contacts all are. */
    unsigned int
    body_of(const unsigned int material) const
    {
      return body[material];
    }

    /** 1 without contacts. */
    unsigned int
    n_bodies() const
    {
      return number;
    }

    /** For bodies that could pass through each other where they have no contact.
     *  @throws InputError if two of them have none */
    void
    check_all_pairs() const;

  private:
    std::vector<std::string>  materials;
    std::vector<unsigned int> body;       ///< by material
    unsigned int              number = 1; ///< of bodies
  };
} // namespace geocone

#endif
