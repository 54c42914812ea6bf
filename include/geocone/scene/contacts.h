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
   * Frictional contact between two bodies, each of one or several materials:
   * their meshes are not connected, and their particles move nodes of their
   * own. In contact, the force of the other body on the nodes of the first and
   * the relative velocity satisfy the Signorini and Coulomb laws.
   */
  class BodyPair : public dealii::ParameterAcceptor
  {
  public:
    explicit BodyPair(const std::string &name);

    /** @param materials names of all materials. @throws InputError */
    void
    prepare(const std::vector<std::string> &materials);

    /** Whether one material belongs to the first body and one to the other. */
    bool
    separates(const unsigned int a, const unsigned int b) const
    {
      return (is_first[a] && is_other[b]) || (is_first[b] && is_other[a]);
    }

    const std::string name;
    InterfaceLaw      law;

    /** Materials of the first body and of the other, by number. */
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

    /** Whether two materials belong to different bodies in contact. */
    bool
    are_apart(const unsigned int a, const unsigned int b) const;

    /** Body of a material, counted from 0: materials that are in the same body
     *  in all contacts belong together. Without contacts there is one body. */
    unsigned int
    body_of(const unsigned int material) const
    {
      return body[material];
    }

    /** Number of bodies, 1 without contacts. */
    unsigned int
    n_bodies() const
    {
      return number;
    }

    /** Requires a contact for each pair of bodies, in methods in which bodies
     *  without a contact could penetrate each other. @throws InputError if a
     *  pair has none */
    void
    check_all_pairs() const;

  private:
    std::vector<std::string>  materials;
    std::vector<unsigned int> body;       ///< by material
    unsigned int              number = 1; ///< of bodies
  };
} // namespace geocone

#endif
