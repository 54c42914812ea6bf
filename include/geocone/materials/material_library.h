// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_materials_material_library_h
#define geocone_materials_material_library_h

#include <geocone/base/parameter_file.h>
#include <geocone/materials/material.h>

#include <deal.II/base/exceptions.h>

#include <memory>
#include <vector>

namespace geocone
{
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
  class Materials : public dealii::ParameterAcceptor
  {
  public:
    explicit Materials(const ParameterFile &file);

    void
    prepare();

    /** That scenes are around an axis. @throws InputError if a law is not spatial */
    void
    set_axisymmetric();

    /** Whether a law is spatial. */
    bool
    are_spatial() const;

    /** Whether all laws have a natural map, see Material::has_natural_map(). */
    bool
    have_natural_map() const;

    /** Whether a law checks the flow of a step, which Quality tells of. */
    bool
    have_flow_check() const;

    /** Whether there is undrained soil (ConstitutiveLaw::fluid_modulus()). */
    bool
    are_undrained() const;

    /** Whether a law has a cone along which soil dilates. */
    bool
    dilate() const;

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
      return names[i];
    }

    /** Largest non-associativity of all materials, 0 to 1. */
    double
    non_associativity() const;

    /** Whether the exact law of one of them is hard (Material::hard_flow) and its friction
     *  has no memory. */
    bool
    have_hard_flow() const;

    /** Whether some of them yield, and all of those by cylinders (a = 0). */
    bool
    yield_without_friction() const;

    /** The least relaxation time of friction with memory of all materials (s);
     *  infinite if none has a memory. */
    double
    least_friction_memory() const;

    /** Gives tau (s) to those that leave it to the scene. */
    void
    set_friction_memory(const double tau);

    /** See Material::reduce_strength(). */
    void
    reduce_strength(const double F);

    /** Its section as text, with numbers in place of what the scene has decided. */
    std::string
    as_parameters() const;

    /** Whether all tangents are symmetric. */
    bool
    symmetric() const;

    /** Most history variables of a law, and after those, where there is undrained
     *  soil, the excess pore pressure. */
    unsigned int
    n_history() const;

    /** Names of all that any of the laws can show. */
    std::vector<std::string>
    shown_names() const;

  private:
    std::vector<std::string>                      names;
    std::vector<std::string>                      types;
    std::vector<std::unique_ptr<ConstitutiveLaw>> list;
    std::vector<const Material *>                 in_closed_form; ///< or null
  };
} // namespace geocone

#endif
