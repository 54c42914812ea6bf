// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/declared_parameters.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/laws/drucker_prager.h>
#include <geocone/laws/hardening_mohr_coulomb.h>
#include <geocone/laws/linear_elastic.h>
#include <geocone/laws/material_library.h>
#include <geocone/laws/modified_cam_clay.h>
#include <geocone/laws/mohr_coulomb.h>
#include <geocone/laws/spatial_mohr_coulomb.h>
#include <geocone/laws/subloading.h>
#include <geocone/laws/umat.h>
#include <geocone/materials/friction_memory.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    template <typename Law>
    std::unique_ptr<ConstitutiveLaw>
    make(const std::string &section)
    {
      return std::make_unique<Law>(section);
    }

    using List = std::vector<std::pair<std::string, MakeLaw>>;

    /** All laws: a new law is a new line here. In three dimensions the spatial
     *  law is the Mohr-Coulomb law, and the plane laws are missing. */
    List
    all_laws()
    {
      List list = {{"spatial Mohr-Coulomb", &make<SpatialMohrCoulomb>},
                   {"spatial Tresca", &make<SpatialTresca>},
                   {"Drucker-Prager", &make<DruckerPrager>},
                   {"von Mises", &make<VonMises>},
                   {"modified Cam-Clay", &make<ModifiedCamClay>},
                   {"linear elastic", &make<LinearElastic>},
                   {"subloading", &make<Subloading>},
                   {"umat", &make<Umat>}};
      if constexpr (dim == 2)
        list.insert(list.begin(),
                    {{"Mohr-Coulomb", &make<MohrCoulomb>},
                     {"Tresca", &make<Tresca>},
                     {"hardening Mohr-Coulomb", &make<HardeningMohrCoulomb>}});
      else
        list.insert(list.begin(),
                    {{"Mohr-Coulomb", &make<SpatialMohrCoulomb>},
                     {"Tresca", &make<SpatialTresca>}});
      return list;
    }

    List laws = all_laws();

    /** Whether a law checks the flow of a step, Material::check_flow(). */
    bool
    checks_flow(const Material &law)
    {
      const std::vector<double> history(law.n_history(), 0.);
      PointStep                 none;
      none.strain.setZero();
      none.stress_n.setZero();
      none.stress.setZero();
      none.history_n = history.data();
      return law.check_flow(none, {}).has_value();
    }
  } // namespace

  void
  add_law(const std::string &type, const MakeLaw make)
  {
    laws.emplace_back(type, make);
  }

  std::vector<std::string>
  material_types()
  {
    std::vector<std::string> names;
    for (const auto &law : laws)
      names.push_back(law.first);
    return names;
  }

  std::unique_ptr<ConstitutiveLaw>
  make_material(const std::string &type, const std::string &section)
  {
    std::string known;
    for (const auto &law : laws)
      {
        if (law.first == type)
          return law.second(section);
        known += (known.empty() ? "" : " | ") + law.first;
      }
    throw InputError(section + "/Type",
                     type,
                     known,
                     "choose one of these laws, or add one as "
                     "CONTRIBUTING.md explains");
  }

  ParameterFile::ParametersOfOtherKinds
  parameters_of_laws()
  {
    ParameterFile::ParametersOfOtherKinds all;
    for (const std::string &type : material_types())
      {
        {
          const auto law = make_material(type, "Law");
          for (const std::string &name : ParameterFile::declared_in("Law"))
            {
              std::string &laws = all["Materials"][name];
              laws += (laws.empty() ? "Type = " : " or ") + type;
            }
        }
        dealii::ParameterAcceptor::clear();
      }
    return all;
  }

  Materials::Materials(const ParameterFile &file)
    : NamedList(file,
                "Materials",
                "Names of the materials, comma-separated; each has a "
                "subsection of its name.",
                "soil")
  {
    require_one("soil");
    types.resize(names().size());
    for (unsigned int i = 0; i < types.size(); ++i)
      {
        const std::string section = "Materials/" + name(i);
        types[i] = file.peek(section + "/Type", "Mohr-Coulomb");
        std::string documentation = "Constitutive law, one of:";
        for (const std::string &type : material_types())
          documentation += " " + type + ",";
        documentation.back() = '.';
        documentation +=
          " Mohr-Coulomb is the cone of the in-plane stresses, i.e. the "
          "Drucker-Prager criterion of Guillet et al. (2025) in plane strain; "
          "Drucker-Prager is the cone of the full stress tensor.";
        enter_subsection(name(i));
        add_parameter("Type", types[i], documentation);
        leave_subsection();
        list.push_back(make_material(types[i], section));
        if (auto *const umat = dynamic_cast<Umat *>(list.back().get()))
          umat->set_folder(file.folder());
      }
  }

  void
  Materials::prepare()
  {
    in_closed_form.clear();
    for (const auto &law : list)
      {
        law->prepare();
        in_closed_form.push_back(dynamic_cast<const Material *>(law.get()));
      }
    found = gather();
  }

  void
  Materials::set_axisymmetric()
  {
    for (unsigned int i = 0; i < list.size(); ++i)
      if (!list[i]->set_axisymmetric())
        throw InputError("Materials/" + name(i) + "/Type",
                         types[i],
                         "spatial Mohr-Coulomb | spatial Tresca | "
                         "Drucker-Prager | von Mises | modified Cam-Clay | "
                         "linear elastic | subloading (explicit MPM) | umat "
                         "where strains are axisymmetric",
                         "around an axis the stress out of the plane counts: "
                         "choose one of these");
    found = gather();
  }

  void
  Materials::set_gravity(const double g)
  {
    for (const auto &law : list)
      law->set_gravity(g);
  }

  LawTraits
  Materials::gather() const
  {
    LawTraits    all;
    unsigned int n_cones = 0, n_cylinders = 0;
    for (const auto &law : list)
      all.undrained = all.undrained || law->fluid_modulus() > 0.;
    for (const Material *const law : in_closed_form)
      {
        if (law == nullptr)
          continue;
        const double flow = law->non_associativity();
        const double tau  = law->friction_memory();
        if (tau > 0.)
          all.friction_memory = std::min(all.friction_memory, tau);
        if (const auto cone = law->initial_cone())
          ++(cone->a > 0. ? n_cones : n_cylinders);
        all.symmetric       = all.symmetric && law->has_symmetric_tangent();
        all.has_natural_map = all.has_natural_map && law->has_natural_map();
        all.spatial         = all.spatial || law->is_spatial();
        all.can_yield       = all.can_yield || checks_flow(*law);
        all.dilates         = all.dilates || law->dilates();
        all.strongly_non_associated =
          all.strongly_non_associated ||
          (flow > Material::strong_non_associativity && !(tau > 0.));
        all.non_associativity = std::max(all.non_associativity, flow);
      }
    all.frictionless = n_cylinders > 0 && n_cones == 0;
    return all;
  }

  std::vector<std::string>
  Materials::warnings() const
  {
    std::vector<std::string> all;
    for (unsigned int m = 0; m < size(); ++m)
      if (in_closed_form[m] != nullptr && list[m]->fluid_modulus() > 0. &&
          in_closed_form[m]->dilates())
        all.push_back("the undrained soil '" + name(m) +
                      "' dilates, and gets stronger the more it flows: "
                      "set its Dilatancy angle = 0");
    return all;
  }

  void
  Materials::refuse_undrained(const std::string &what,
                              const std::string &remedy) const
  {
    for (unsigned int i = 0; i < list.size(); ++i)
      if (list[i]->fluid_modulus() > 0.)
        throw InputError("Materials/" + name(i) + "/Pore fluid bulk modulus",
                         list[i]->fluid_modulus(),
                         "0 with " + what,
                         remedy);
  }

  void
  Materials::check_closed_form(const std::string &method) const
  {
    for (unsigned int i = 0; i < list.size(); ++i)
      if (in_closed_form[i] == nullptr)
        throw InputError("Materials/" + name(i) + "/Type",
                         types[i],
                         "a law in closed form where Discretisation/Method = " +
                           method,
                         "set 'Discretisation/Method' to 'explicit MPM', or "
                         "choose another law");
  }

  void
  Materials::refuse_strength_formulas(const std::string &where) const
  {
    for (unsigned int i = 0; i < list.size(); ++i)
      if (const std::string formula = in_closed_form[i] != nullptr
                                        ? in_closed_form[i]->strength_formula()
                                        : "";
          !formula.empty())
        throw InputError("Materials/" + name(i) + "/" + formula,
                         ParameterFile::value("Materials/" + name(i) + "/" +
                                              formula),
                         "a 'Cohesion gradient' " + where,
                         "strength is to be linear in each cell: give a "
                         "gradient, or layers");
  }

  unsigned int
  Materials::n_history() const
  {
    unsigned int most = 0;
    for (const auto &law : list)
      most = std::max(most, law->n_history());
    return most + found.undrained;
  }

  std::vector<std::string>
  Materials::shown_names() const
  {
    std::vector<std::string> names;
    for (const auto &law : list)
      for (const ConstitutiveLaw::OutputQuantity &shown :
           law->output_quantities())
        if (std::find(names.begin(), names.end(), shown.name) == names.end())
          names.push_back(shown.name);
    return names;
  }

  void
  Materials::set_friction_memory(const double tau)
  {
    for (const auto &law : list)
      if (auto *material = dynamic_cast<Material *>(law.get()))
        material->set_friction_memory(tau);
    found = gather();
  }

  void
  Materials::reduce_strength(const double F)
  {
    for (const auto &law : list)
      if (auto *material = dynamic_cast<Material *>(law.get()))
        if (material->is_reduced())
          material->reduce_strength(F);
    found = gather();
  }

  std::string
  Materials::as_parameters() const
  {
    Declared values = all_declared().sections.at("Materials");
    for (unsigned int m = 0; m < size(); ++m)
      {
        auto      &entries = values.sections.at(name(m)).entries;
        const auto memory  = entries.find(FrictionMemory::entry);
        if (memory != entries.end())
          memory->second.value =
            format("%.17g", in_closed_form[m]->friction_memory());
      }
    return as_text("Materials", values);
  }
} // namespace geocone::GEOCONE_DIM
