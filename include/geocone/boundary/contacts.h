// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_boundary_contacts_h
#define geocone_boundary_contacts_h

#include <geocone/base/named_list.h>
#include <geocone/boundary/interface_law.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * Frictional contact between two bodies, each consisting of one or more
   * materials. The bodies share no nodes: their meshes are not connected, or
   * their particles have separate nodal velocities. The contact force on nodes
   * of the first body and the relative velocity satisfy the Signorini and
   * Coulomb laws.
   */
  class BodyPair : public dealii::ParameterAcceptor
  {
  public:
    explicit BodyPair(const std::string &name);

    /** Assigns each material to the first or the second body, or to neither.
     *  @param materials names of all materials @throws InputError */
    void
    prepare(const std::vector<std::string> &materials);

    /** Returns true if two materials belong to the two different bodies of the
     *  contact. */
    bool
    separates(const unsigned int a, const unsigned int b) const
    {
      return (is_first[a] && is_other[b]) || (is_first[b] && is_other[a]);
    }

    const std::string name;
    InterfaceLaw      law;

    /** For each material, true if the material belongs to the first (second)
     *  body. */
    std::vector<bool> is_first, is_other;

  private:
    std::vector<std::string> first, other;
  };

  /** List of all contacts between bodies of a scene, from the parameter
   *  "Contacts/Names". */
  class Contacts : public NamedList<BodyPair>
  {
  public:
    explicit Contacts(const ParameterFile &file);

    void
    prepare(const std::vector<std::string> &materials);

    /** Returns true if two materials belong to different bodies in contact. */
    bool
    are_apart(const unsigned int a, const unsigned int b) const;

    /** Returns the index of the body that contains a material, counted from 0.
     *  Materials that are on the same side of all contacts form one body;
     *  without contacts there is one body. */
    unsigned int
    body_of(const unsigned int material) const
    {
      return body[material];
    }

    /** Returns the number of bodies: 1 without contacts. */
    unsigned int
    n_bodies() const
    {
      return number;
    }

    /** Checks that a contact is defined for each pair of bodies. For methods in
     *  which bodies without a contact could penetrate each other.
     *  @throws InputError for a pair without a contact */
    void
    check_all_pairs() const;

  private:
    std::vector<std::string>  materials;
    std::vector<unsigned int> body;       ///< index of each material's body
    unsigned int              number = 1; ///< number of bodies
  };
} // namespace geocone

#endif
