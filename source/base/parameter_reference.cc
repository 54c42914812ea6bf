// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/declared_parameters.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/base/parameter_reference.h>
#include <geocone/base/units.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <ostream>
#include <regex>
#include <sstream>

namespace geocone
{
  using Json = nlohmann::ordered_json;
  using dealii::ParameterHandler;

  const char *const any_name = "NAME";

  namespace
  {
    struct Section
    {
      const char *name, *description;
    };

    /** The sections in the order in which a model is built. */
    constexpr Section sections_in_order[] = {
      {"Analysis",
       "time steps, or bounds of a limit load or a factor of safety"},
      {"Discretisation", "method (FEM, MPM, explicit MPM, point) and elements"},
      {"Geometry", "shape of the body, plane strain or axisymmetry"},
      {"Mesh", "type, cell sizes and refinement"},
      {"Materials", "constitutive laws, their parameters and regions"},
      {"Initial stress", "stress before the first step"},
      {"Initial velocity", "velocity before the first step"},
      {"Boundary conditions",
       "prescribed velocities: supports, footings, walls"},
      {"Gravity", "acceleration of gravity"},
      {"Tractions", "pressures and shear stresses on the boundary"},
      {"Water", "pore pressures: piezometric line, or a file"},
      {"Seepage", "steady flow of water with a free surface"},
      {"Obstacles", "rigid bodies in contact with the soil"},
      {"Contacts", "contact between deformable bodies"},
      {"Structures", "anchors, struts, geogrids and plates"},
      {"Random fields", "random strengths and unit weights of soils"},
      {"Shakedown", "loads that vary, and their limits"},
      {"Absorbing boundaries", "boundaries that transmit waves"},
      {"Loading", "stages: duration, steps, excavation, fill, strength"},
      {"Path", "stages of a single material point"},
      {"Element", "options of a single material point"},
      {"Time stepping", "implicit steps: inertia, integration, substeps, consolidation"},
      {"Newton", "formulation and convergence of Newton's method"},
      {"Linear solver", "direct and multigrid solvers"},
      {"Material point method", "transfer, mass and stabilisation of the MPM"},
      {"Particles", "layout of material points"},
      {"Explicit", "steps of the explicit MPM"},
      {"Observation", "reactions, points and limit load to be reported"},
      {"Exact solution", "errors against a known solution"},
      {"Reference", "known result of a case"},
      {"Checkpoint", "files from which a run can be resumed"},
      {"Output", "result folder, fields, pictures, expectations"}};

    /** The place of a section in this order; those not listed come last. */
    std::size_t
    rank_of(const std::string &section)
    {
      return std::find_if(
               std::begin(sections_in_order),
               std::end(sections_in_order),
               [&](const Section &listed) { return listed.name == section; }) -
             std::begin(sections_in_order);
    }

    std::string
    description_of(const std::string &section)
    {
      const std::size_t rank = rank_of(section);
      return rank < std::size(sections_in_order)
               ? sections_in_order[rank].description
               : "";
    }

    /** A sentence on the conditions under which parameters have an effect. */
    std::string
    in_words(const std::vector<std::string> &conditions)
    {
      std::string text;
      for (const std::string &condition : conditions)
        text += (text.empty() ? " Used with " : ", and ") + condition;
      return text + (text.empty() ? "" : ".");
    }

    void
    collect(const Json                       &tree,
            const std::vector<std::string>   &sections,
            std::vector<DocumentedParameter> &all)
    {
      for (const auto &[key, value] : tree.items())
        if (const auto pattern = value.find("pattern_description");
            pattern != value.end() && pattern->is_string())
          all.push_back({sections,
                         key,
                         value.at("value").get<std::string>(),
                         pattern->get<std::string>(),
                         value.at("documentation").get<std::string>(),
                         conditions_of_use(joined(sections, key))});
        else
          {
            std::vector<std::string> below = sections;
            below.push_back(key);
            collect(value, below, all);
          }
    }

    std::string
    lower_case(std::string text)
    {
      for (char &c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      return text;
    }

    /** Whether a path ends with the parts of a topic, which may leave out the name of a
     *  member, or, from the first section on, give one. */
    bool
    is_called(const std::vector<std::string> &path,
              const std::vector<std::string> &topic)
    {
      std::vector<std::string> parts; // without names of members
      for (const std::string &name : path)
        if (name != any_name || &name == &path.back())
          parts.push_back(lower_case(name));
      if (topic.size() <= parts.size() &&
          std::equal(topic.rbegin(), topic.rend(), parts.rbegin()))
        return true;
      return topic.size() == path.size() && topic.size() > parts.size() &&
             topic.front() == parts.front() && topic.back() == parts.back();
    }

    /** Whether a topic names a parameter or a section that it is in. */
    bool
    is_on(const DocumentedParameter      &parameter,
          const std::vector<std::string> &topic)
    {
      std::vector<std::string> path;
      for (const std::string &section : parameter.sections)
        {
          path.push_back(section);
          if (is_called(path, topic))
            return true;
        }
      path.push_back(parameter.name);
      return is_called(path, topic);
    }

    /** Type and allowed values of a pattern. */
    Json
    schema_of(const std::string &pattern)
    {
      const auto begins = [&](const std::string &text) {
        return pattern.compare(0, text.size(), text) == 0;
      };
      Json schema;
      if (begins("[Selection "))
        {
          schema["type"] = "string";
          schema["enum"] =
            split_names(pattern.substr(11, pattern.size() - 12), '|');
        }
      else if (begins("[Bool"))
        schema["type"] = "boolean";
      else if (begins("[Integer") || begins("[Double"))
        {
          const auto [from, to] = bounds_of(pattern);
          schema["type"]        = begins("[Double") ? "number" : "integer";
          if (from || pattern == "[Integer]") // the latter is without sign
            schema["minimum"] =
              std::strtod(from.value_or("0").c_str(), nullptr);
          if (to)
            schema["maximum"] = std::strtod(to->c_str(), nullptr);
        }
      else if (begins("[List of <"))
        {
          const std::size_t end = pattern.rfind("> of length ");
          schema["type"]        = "array";
          schema["items"]       = schema_of(pattern.substr(10, end - 10));
          std::smatch       length;
          const std::string rest = pattern.substr(end);
          if (std::regex_search(
                rest, length, std::regex("(\\d+)\\.\\.\\.(\\d+)")))
            {
              if (length.str(1) != "0")
                schema["minItems"] = std::stoul(length.str(1));
              if (length.str(2) != "4294967295")
                schema["maxItems"] = std::stoul(length.str(2));
            }
        }
      else // a number may stand for the text of a formula
        schema["type"] = {"string", "number"};
      return schema;
    }

    /** The value that a text is by a schema. */
    Json
    value_of(const std::string &text, const Json &schema, const char separator)
    {
      const Json &type = schema.at("type");
      if (type == "boolean")
        return text == "true";
      if (type == "integer")
        return std::strtoll(text.c_str(), nullptr, 10);
      if (type == "number")
        return std::strtod(text.c_str(), nullptr);
      if (type != "array")
        return text;
      Json list = Json::array();
      for (const std::string &item : split_names(text, separator))
        list.push_back(value_of(item, schema.at("items"), ','));
      return list;
    }

    Json
    empty_object(const std::string &description)
    {
      Json schema = {{"type", "object"}};
      if (!description.empty())
        schema["description"] = description;
      schema["properties"]           = Json::object();
      schema["additionalProperties"] = false;
      return schema;
    }

    Json
    schema_of(const DocumentedParameter &parameter)
    {
      Json       schema = schema_of(parameter.pattern);
      const bool nested =
        schema.contains("items") && schema["items"].at("type") == "array";
      schema["default"] = value_of(parameter.value, schema, nested ? ';' : ',');
      schema["description"] = parameter.documentation;
      if (const std::string unit = unit_in(parameter.documentation);
          !unit.empty())
        schema["x-unit"] = unit;
      schema["x-allowed"] = allowed_by(parameter.pattern);
      schema["x-default"] = parameter.value; // as in a parameter file
      std::vector<std::string> conditions = parameter.conditions.of_section;
      conditions.insert(conditions.end(),
                        parameter.conditions.own.begin(),
                        parameter.conditions.own.end());
      if (!conditions.empty())
        schema["x-used-with"] = conditions;
      return schema;
    }
  } // namespace

  std::string
  DocumentedParameter::path() const
  {
    return joined(sections, name);
  }

  std::vector<DocumentedParameter>
  documented_parameters()
  {
    std::ostringstream out;
    dealii::ParameterAcceptor::prm.print_parameters(
      out, ParameterHandler::JSON | ParameterHandler::KeepDeclarationOrder);
    std::vector<DocumentedParameter> all;
    collect(Json::parse(out.str()), {}, all);
    std::stable_sort(all.begin(), all.end(), [](const auto &a, const auto &b) {
      return rank_of(a.sections.at(0)) < rank_of(b.sections.at(0));
    });
    return all;
  }

  std::string
  list_of_sections()
  {
    std::string list;
    for (const Section &section : sections_in_order)
      list += std::string("  ") + section.name +
              std::string(23 - std::string(section.name).size(), ' ') +
              section.description + "\n";
    return list;
  }

  std::vector<DocumentedParameter>
  on_topic(const std::vector<DocumentedParameter> &all,
           const std::string                      &topic)
  {
    if (topic == "all")
      return all;
    const std::vector<std::string> parts = split_names(lower_case(topic), '/');
    std::vector<DocumentedParameter> found;
    std::vector<std::string>         names, sections;
    for (const DocumentedParameter &parameter : all)
      {
        if (is_on(parameter, parts))
          found.push_back(parameter);
        const std::string &section = parameter.sections.at(0);
        if (sections.empty() || sections.back() != section)
          sections.push_back(section);
        names.push_back(parameter.name);
        names.push_back(section + "/" + parameter.name);
      }
    if (!found.empty())
      return found;
    names.insert(names.begin(), sections.begin(), sections.end());
    const std::string nearest = nearest_name(topic, names);
    std::string       list;
    for (const std::string &section : sections)
      list += (list.empty() ? "" : ", ") + section;
    throw InputError("--help",
                     topic,
                     "a parameter, 'all', or one of the sections " + list,
                     nearest.empty() ? "'geocone --help' describes the sections"
                                     : "did you mean '" + nearest + "'?");
  }

  void
  print(std::ostream &out, const std::vector<DocumentedParameter> &parameters)
  {
    for (auto first = parameters.begin(); first != parameters.end();)
      {
        const std::string section = first->sections.at(0);
        const auto        end =
          std::find_if(first, parameters.end(), [&](const auto &p) {
            return p.sections.at(0) != section;
          });
        std::string about = section + ": " + description_of(section) + "." +
                            in_words(first->conditions.of_section);
        out << (first == parameters.begin() ? "" : "\n");
        for (const std::string &line :
             dealii::Utilities::break_text_into_lines(about, 76))
          out << "# " << line << "\n";
        ParameterHandler prm; // for its layout
        for (; first != end; ++first)
          {
            for (const std::string &below : first->sections)
              prm.enter_subsection(below);
            prm.declare_entry(first->name,
                              first->value,
                              dealii::Patterns::Anything(),
                              first->documentation +
                                in_words(first->conditions.own));
            for (std::size_t i = 0; i < first->sections.size(); ++i)
              prm.leave_subsection();
          }
        std::ostringstream text;
        prm.print_parameters(
          text, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
        // Without the library's title, and blank lines at the end.
        std::string lines = text.str().substr(text.str().find("subsection"));
        out << lines.erase(lines.find_last_not_of('\n') + 1) << "\n";
      }
  }

  std::string
  json_schema(const std::vector<DocumentedParameter> &parameters)
  {
    Json root = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "Parameters of geocone"}};
    root.update(empty_object(""));
    for (const DocumentedParameter &parameter : parameters)
      {
        Json *here = &root;
        for (const std::string &section : parameter.sections)
          {
            Json &next = section == any_name ? (*here)["additionalProperties"]
                                             : (*here)["properties"][section];
            if (!next.is_object())
              next = empty_object(description_of(section));
            here = &next;
          }
        (*here)["properties"][parameter.name] = schema_of(parameter);
      }
    return root.dump(1);
  }
} // namespace geocone
