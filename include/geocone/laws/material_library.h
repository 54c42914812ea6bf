// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_laws_material_library_h
#define geocone_laws_material_library_h

#include <geocone/base/named_list.h>
#include <geocone/materials/law_traits.h>
#include <geocone/materials/material.h>

#include <deal.II/base/exceptions.h>

#include <memory>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Type of functions that create the constitutive law of a parameter section,
   *  e.g. "Materials/soil". */
  using MakeLaw =
    std::unique_ptr<ConstitutiveLaw> (*)(const std::string &section);

  /** Registers a user-defined constitutive law for make_material()
   *  (doc/tutorials/soil.md). */
  void
  add_law(const std::string &type, const MakeLaw make);

  /**
   * Creates the constitutive law of a parameter section, e.g. "Materials/soil".
   * @param type a name of material_types()
   * @throws InputError for an unknown type, with the list of known types
   */
  std::unique_ptr<ConstitutiveLaw>
  make_material(const std::string &type, const std::string &section);

  /** Names of all registered constitutive laws. */
  std::vector<std::string>
  material_types();

  /**
   * Parameters of all constitutive laws, each with the names of the laws that
   * declare the parameter. A file can thus contain parameters of laws other
   * than the selected law. To be called before any parameter is declared.
   */
  ParameterFile::ParametersOfOtherKinds
  parameters_of_laws();

  /**
   * List of the materials of a scene, in the order of "Materials/Names". A
   * material is identified by its index in the list. A point belongs to the
   * last material whose region contains it, otherwise to the first one.
   */
  class Materials : public NamedList<ConstitutiveLaw>
  {
  public:
    explicit Materials(const ParameterFile &file);

    void
    prepare();

    /** Enables axisymmetry. @throws InputError for a law that does not support
     *  it */
    void
    set_axisymmetric();

    /** Computes the mass densities from unit weights, see
     *  ConstitutiveLaw::set_gravity(). */
    void
    set_gravity(const double g);

    /** Summary of the properties of all constitutive laws. Up to date after
     *  prepare() and later changes of parameters. */
    const LawTraits &
    traits() const
    {
      return found;
    }

    /** Warnings about undrained soil with dilatancy. */
    std::vector<std::string>
    warnings() const;

    /** Rejects undrained soil. @throws InputError @param what feature that does
     *  not support it */
    void
    refuse_undrained(const std::string &what, const std::string &remedy) const;

    unsigned int
    size() const
    {
      return list.size();
    }

    /** @name Access to a material as a ConstitutiveLaw, or as a law with a
     *  closed-form return map */
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
     * Checks that all laws have the closed-form return mapping that the
     * numerical method @p method requires. @throws InputError
     */
    void
    check_closed_form(const std::string &method) const;

    /** Rejects strengths that are formulas. @throws InputError
     *  @param where e.g. "where loads are bounded" */
    void
    refuse_strength_formulas(const std::string &where) const;

    const std::string &
    name(const unsigned int i) const
    {
      return names()[i];
    }

    /** Sets the relaxation time tau (s) of laws whose parameter 'Friction
     *  memory' is "automatic". */
    void
    set_friction_memory(const double tau);

    /** Reduces the strength of all materials by the factor F, see
     *  Material::reduce_strength(). */
    void
    reduce_strength(const double F);

    /** Parameter section of the materials as text, including values set
     *  automatically by the scene. */
    std::string
    as_parameters() const;

    /** Number of history variables stored per point: the maximum over all laws,
     *  plus one for undrained soil (excess pore pressure). */
    unsigned int
    n_history() const;

    /** Names of the output quantities of all laws. */
    std::vector<std::string>
    shown_names() const;

  private:
    /** Collects the properties of all constitutive laws from the current
     *  parameters. */
    LawTraits
    gather() const;

    using NamedList::list; // hidden: use law() or operator[]

    LawTraits                     found;
    std::vector<std::string>      types;
    std::vector<const Material *> in_closed_form; ///< null for other laws
  };
} // namespace geocone::GEOCONE_DIM

#endif
