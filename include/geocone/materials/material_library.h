// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_material_library_h
#define geocone_materials_material_library_h

#include <geocone/base/named_list.h>
#include <geocone/materials/law_traits.h>
#include <geocone/materials/material.h>

#include <deal.II/base/exceptions.h>

#include <memory>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Creates the law of a section. */
  using MakeLaw =
    std::unique_ptr<ConstitutiveLaw> (*)(const std::string &section);

  /** Adds a law of another program, built on this library (doc/tutorials/soil.md), to
   *  those that make_material() knows. */
  void
  add_law(const std::string &type, const MakeLaw make);

  /**
   * Creates the material of a section, e.g. "Materials/soil".
   * @param type a name of material_types()
   * @throws InputError for an unknown type, with the list of known types
   */
  std::unique_ptr<ConstitutiveLaw>
  make_material(const std::string &type, const std::string &section);

  /** Names known to make_material(). */
  std::vector<std::string>
  material_types();

  /**
   * Parameters of all laws with the names of these laws, so that a file can
   * keep parameters of laws other than the selected one. To be called before
   * anything is declared.
   */
  ParameterFile::OfOthers
  parameters_of_laws();

  /**
   * Materials of a scene, in the order of "Materials/Names"; a material is
   * identified by its index in the list. A point belongs to the last material
   * whose region contains it, otherwise to the first one.
   */
  class Materials : public NamedList<ConstitutiveLaw>
  {
  public:
    explicit Materials(const ParameterFile &file);

    void
    prepare();

    /** Enables axisymmetry. @throws InputError if a law is not spatial */
    void
    set_axisymmetric();

    /** See ConstitutiveLaw::set_gravity(). */
    void
    set_gravity(const double g);

    /** Properties of the laws, after prepare() and later changes. */
    const LawTraits &
    traits() const
    {
      return found;
    }

    /** Warnings about undrained soil with dilatancy. */
    std::vector<std::string>
    warnings() const;

    /** @throws InputError for undrained soil. @param what does not support
     *  it */
    void
    refuse_undrained(const std::string &what, const std::string &remedy) const;

    unsigned int
    size() const
    {
      return list.size();
    }

    /** @name Access to a material as any law, or as a law in closed form */
    /** @{ */
    const ConstitutiveLaw &
    law(const unsigned int i) const
    {
      return *list[i];
    }
    const Material &
    operator[](const unsigned int i) const
    {
      Assert(in_closed_form[i] != nullptr, dealii::ExcInternalError());
      return *in_closed_form[i];
    }
    /** @} */

    /**
     * @throws InputError if a law is not in closed form, which the method
     * @p method needs
     */
    void
    check_closed_form(const std::string &method) const;

    const std::string &
    name(const unsigned int i) const
    {
      return names()[i];
    }

    /** Sets tau (s) of the laws for which it is automatic. */
    void
    set_friction_memory(const double tau);

    /** See Material::reduce_strength(). */
    void
    reduce_strength(const double F);

    /** Section of the materials as text, with the values chosen by the
     *  scene. */
    std::string
    as_parameters() const;

    /** Largest number of history variables of a law, plus one for the excess
     *  pore pressure if there is undrained soil. */
    unsigned int
    n_history() const;

    /** Names of the output quantities of all laws. */
    std::vector<std::string>
    shown_names() const;

  private:
    /** Present traits of the laws. */
    LawTraits
    gather() const;

    using NamedList::list; // hidden: use law() or operator[]

    LawTraits                     found;
    std::vector<std::string>      types;
    std::vector<const Material *> in_closed_form; ///< or null
  };
} // namespace geocone::GEOCONE_DIM

#endif
