// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_scene_structures_h
#define geocone_scene_structures_h

#include <geocone/base/choice.h>
#include <geocone/base/named_list.h>
#include <geocone/base/types.h>
#include <geocone/boundary/acting_stages.h>
#include <geocone/geometry/geometry.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /** Structural element: anchor, strut, geogrid or plate. Anchors, struts and
   *  geogrids are straight bars along a polyline, tied to the body at the
   *  vertices of the polyline; a plate is tied to the body along the polyline
   *  and has bending stiffness. Forces and stiffness are per metre of
   *  thickness, tension positive. */
  class Structure : public dealii::ParameterAcceptor
  {
  public:
    enum class Type
    {
      anchor,
      strut,
      geogrid,
      plate
    };

    enum class Ends
    {
      none,
      first,
      last,
      both
    };

    /** Strength of a plate under an axial force N and a moment M. */
    enum class Interaction
    {
      none,     ///< |N| <= N_p and |M| <= M_p
      parabolic ///< |M|/M_p + (N/N_p)^2 <= 1
    };

    explicit Structure(const std::string &name);

    /** Checks the parameters. @param stages names of all stages
     *  @param is_rigid whether the structure is rigid-plastic, without
     *  stiffness, as in limit analysis */
    void
    prepare(const std::vector<std::string> &stages, const bool is_rigid);

    /** Returns the full parameter name "Structures/NAME/ENTRY", for error
     *  messages. */
    std::string
    parameter(const std::string &entry) const
    {
      return "Structures/" + name + "/" + entry;
    }

    /** Returns the names of the bars of the structure, as used in the results.
     *  Empty for a plate, whose results are written separately. */
    std::vector<std::string>
    names_of_bars() const;

    bool
    is_plate() const
    {
      return type == Type::plate;
    }

    /** Returns true if the structure is a plate with a closed polyline. */
    bool
    is_closed() const
    {
      return is_plate() && points.front() == points.back();
    }

    /** Returns true if the rotation of a plate is fixed at the first end, or at
     *  the last end if @p at_last. */
    bool
    is_clamped(const bool at_last) const
    {
      return clamped == Ends::both ||
             clamped == (at_last ? Ends::last : Ends::first);
    }

    /** Returns true if the axial force reduces the moment capacity. The axial
     *  strengths N_t = N_c = N_p and the moment capacity are then finite. */
    bool
    interacts() const
    {
      return is_plate() && interaction == Interaction::parabolic;
    }

    /** Returns the type of the structure as a word, e.g. "anchor". */
    std::string
    kind() const
    {
      return type.word();
    }

    /** Projects a trial axial force onto the admissible interval [-N_c, N_t]
     *  (N/m). */
    double
    admissible(const double trial) const
    {
      return std::clamp(trial, -compressive, tensile);
    }

    /** Projects a trial bending moment onto the admissible interval [-M_p, M_p]
     *  (N). */
    double
    admissible_moment(const double trial) const
    {
      return std::clamp(trial, -capacity, capacity);
    }

    /** Returns true if one end of the structure may be a fixed point outside
     *  the body, as for anchors and struts. */
    bool
    may_be_fixed() const
    {
      return type == Type::anchor || type == Type::strut;
    }

    /** Returns true if the structure is a chain of bars, each of which couples
     *  only neighbouring cells. */
    bool
    is_chain() const
    {
      return !may_be_fixed();
    }

    /** Interval [-N_c, N_t] of admissible axial forces (N/m). Its ends may be
     *  infinite. */
    std::array<double, 2>
    axial_strength() const
    {
      return {{-compressive, tensile}};
    }

    /** Plastic moment M_p (N), which may be infinite. */
    double
    moment_capacity() const
    {
      return capacity;
    }

    const std::string               name;
    ActingStages                    stages;
    std::vector<dealii::Point<dim>> points;
    double                          stiffness  = 0.; ///< stiffness EA (N/m)
    double                          pre_stress = 0.; ///< initial force (N/m)
    double                          bending    = 0.; ///< stiffness EI (N m)

    /** Maximum distance between the points at which a plate is tied to the body
     *  (m). If infinite, the plate is tied to the body only where it crosses
     *  cell faces. */
    double spacing = 0.;

    /** Strength of the interfaces to the soil, relative to that of the soil. */
    double interface_strength = 1.;

  private:
    Choice<Type>             type    = {{{"anchor", Type::anchor},
                                         {"strut", Type::strut},
                                         {"geogrid", Type::geogrid},
                                         {"plate", Type::plate}}};
    Choice<Ends>             clamped = {{{"none", Ends::none},
                                         {"first", Ends::first},
                                         {"last", Ends::last},
                                         {"both", Ends::both}}};
    Choice<Interaction>      interaction = {
           {{"none", Interaction::none}, {"parabolic", Interaction::parabolic}}};
    std::string tensile_text = "unlimited", compressive_text = "automatic";
    double      tensile = 0., compressive = 0.; ///< strengths N_t, N_c (N/m)
    std::string capacity_text = "unlimited", spacing_text = "automatic";
    double      capacity = 0.; ///< plastic moment M_p (N)

    /** Checks the parameters of a plate. @throws InputError */
    void
    prepare_plate(const bool is_rigid);
  };

  /** List of all structures of a scene, from the parameter
   *  "Structures/Names". */
  class Structures : public NamedList<Structure>
  {
  public:
    explicit Structures(const ParameterFile &file);

    /** Checks the parameters. @param stages names of all stages */
    void
    prepare(const Geometry &geometry, const std::vector<std::string> &stages);

    /** Checks the parameters of rigid-plastic structures. Geogrids are then tied
     *  to the body all along their polylines. @param analysis name of the
     *  analysis, for messages */
    void
    prepare_rigid(const Geometry &geometry, const std::string &analysis);

    /** Returns the segments of the structures that are tied to the body all
     *  along their polylines. These are edges of unstructured meshes. */
    std::vector<std::array<dealii::Point<dim>, 2>>
    lines() const;

    /** Returns the names of the bars of all structures except plates, in the
     *  order of the list. */
    std::vector<std::string>
    names_of_bars() const;

    /** Plates, in order. */
    std::vector<const Structure *>
    plates() const;

    /** Replaces the blanks in the name of a structure with underscores, for use
     *  as a key of summary.json. */
    static std::string
    key_of(std::string name);

  private:
    bool is_rigid = false; ///< see prepare_rigid()

    /** Checks the parameters. @param stages names of all stages */
    void
    check(const Geometry &geometry, const std::vector<std::string> &stages);
  };
} // namespace geocone::GEOCONE_DIM

#endif
