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
  /** Makes a law of a section. */
  using MakeLaw =
    std::unique_ptr<ConstitutiveLaw> (*)(const std::string &section);

  /** Adds a law of another program, built on this library (doc/tutorials/soil.md), to
   *  those that make_material() knows. */
  void
  add_law(const std::string &type, const MakeLaw make);

  /**
   * Makes the material of a section, e.g. "Materials/soil".
   * @param type a name of material_types()
   * @throws InputError for an unknown type, with the list of those known
   */
  std::unique_ptr<ConstitutiveLaw>
  make_material(const std::string &type, const std::string &section);

  /** The names that make_material() knows. */
  std::vector<std::string>
  material_types();

  /**
   * The parameters of all laws, with the laws that have them, so that a file may
   * keep those of another law than the one that it asks for. To be called before
   * anything is declared.
   */
  ParameterFile::OfOthers
  parameters_of_laws();

  /**
   * The materials of a scene, in the order of "Materials/Names"; a material is
   * known by its place in the list. A point belongs to the last material whose
   * region contains it, or else to the first one.
   */
  class Materials : public NamedList<ConstitutiveLaw>
  {
  public:
    explicit Materials(const ParameterFile &file);

    void
    prepare();

    /** That scenes are around an axis. @throws InputError if a law is not spatial */
    void
    set_axisymmetric();

    /** See ConstitutiveLaw::set_gravity(). */
    void
    set_gravity(const double g);

    /** Properties of the laws, of prepare() and later changes. */
    const LawTraits &
    traits() const
    {
      return found;
    }

    /** Warnings about undrained soil that dilates. */
    std::vector<std::string>
    warnings() const;

    /** @throws InputError if there is undrained soil, with what knows none */
    void
    refuse_undrained(const std::string &what, const std::string &remedy) const;

    unsigned int
    size() const
    {
      return list.size();
    }

    /** @name One of them, as any law, or as one in closed form */
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

    /** Gives tau (s) to those that leave it to the scene. */
    void
    set_friction_memory(const double tau);

    /** See Material::reduce_strength(). */
    void
    reduce_strength(const double F);

    /** Its section as text, with numbers in place of what the scene has decided. */
    std::string
    as_parameters() const;

    /** Most history variables of a law, and after those, where there is undrained
     *  soil, the excess pore pressure. */
    unsigned int
    n_history() const;

    /** Names of all that any of the laws can show. */
    std::vector<std::string>
    shown_names() const;

  private:
    /** The traits of the laws as they are now. */
    LawTraits
    gather() const;

    using NamedList::list; // others take law() and operator[]

    LawTraits                     found;
    std::vector<std::string>      types;
    std::vector<const Material *> in_closed_form; ///< or null
  };
} // namespace geocone::GEOCONE_DIM

#endif
