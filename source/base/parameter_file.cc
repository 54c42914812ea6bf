// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/declared_parameters.h>
#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/base/renamed_parameters.h>
#include <geocone/base/units.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <ostream>
#include <set>
#include <sstream>

namespace geocone
{
  namespace
  {
    using dealii::ParameterAcceptor;
    using dealii::ParameterHandler;
    using dealii::Utilities::trim;

    constexpr std::uintmax_t largest_file = 16000000; ///< (bytes)
    constexpr unsigned int   most_files   = 1000;
    constexpr std::size_t    longest_name = 60;

    std::pair<std::vector<std::string>, std::string>
    sections_and_name(const std::string &path)
    {
      std::vector<std::string> parts = split_names(path, '/');
      if (parts.empty())
        return {{}, ""};
      const std::string name = parts.back();
      parts.pop_back();
      return {parts, name};
    }

    bool
    has_control_characters(const std::string &text)
    {
      return std::any_of(text.begin(), text.end(), [](const char c) {
        const auto code = static_cast<unsigned char>(c);
        return (code < 32 && c != '\t') || code == 127;
      });
    }

    /** Levenshtein distance, to suggest the name that was meant. */
    unsigned int
    edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0U);
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const unsigned int previous = row[j];
              row[j]                      = std::min(
                {row[j] + 1,
                                      row[j - 1] + 1,
                                      diagonal + (std::tolower(a[i - 1]) == std::tolower(b[j - 1])
                                                    ? 0U
                                                    : 1U)});
              diagonal = previous;
            }
        }
      return row.back();
    }

    /** The call for help on the first section of a path. */
    std::string
    help_on(const std::string &path)
    {
      const std::size_t slash = path.find('/');
      return "'geocone --help" +
             (slash == std::string::npos ? "" : " " + path.substr(0, slash)) +
             "'";
    }

    std::string
    did_you_mean(const std::string &path)
    {
      return "\n  remedy:  did you mean '" + path + "'? " + help_on(path) +
             " lists all";
    }

    /** Suggestion for an unknown name: a similar known name, or all known names
     *  if they are few. */
    std::string
    suggestion(const std::string              &name,
               const std::string              &section,
               const std::vector<std::string> &known)
    {
      const std::string best = nearest_name(name, known);
      if (!best.empty())
        return did_you_mean(section + best);
      if (known.size() > 16 || known.empty())
        return "\n  remedy:  " + help_on(section) + " lists all";
      std::string all;
      for (const std::string &candidate : known)
        all += (all.empty() ? "" : ", ") + candidate;
      return "\n  allowed: " + all + "\n  remedy:  choose one of these; " +
             help_on(section) + " describes them";
    }

    /** "SECTION/NAME" if exactly one other section has a parameter of this
     *  name. */
    std::string
    path_of_entry(const std::string &name, const Declared &declared)
    {
      std::string place;
      for (const auto &[section, part] : declared.sections)
        if (part.entries.count(name) > 0)
          {
            if (!place.empty())
              return "";
            place = section + "/" + name;
          }
      return place;
    }
  } // namespace

  std::string
  nearest_name(const std::string &name, const std::vector<std::string> &known)
  {
    std::string  best;
    unsigned int distance = std::max<std::size_t>(2, name.size() / 3) + 1;
    if (name.size() <= longest_name)
      for (const std::string &candidate : known)
        if (const unsigned int d = edit_distance(name, candidate); d < distance)
          {
            distance = d;
            best     = candidate;
          }
    // Or only its beginning.
    for (const std::string &candidate : known)
      if (best.empty() && name.size() > 2 &&
          candidate.compare(0, name.size(), name) == 0)
        best = candidate;
    return best;
  }

  std::vector<std::string>
  split_names(const std::string &list, const char separator)
  {
    std::vector<std::string> names;
    std::istringstream       in(list);
    for (std::string part; std::getline(in, part, separator);)
      if (!trim(part).empty())
        names.push_back(trim(part));
    return names;
  }

  std::string
  ParameterFile::Line::place() const
  {
    return number == 0
             ? file
             : "file '" +
                 printable(std::filesystem::path(file).filename().string()) +
                 "', line " + std::to_string(number);
  }

  ParameterFile::ParameterFile(const std::string              &file_name,
                               const std::vector<std::string> &overrides,
                               const std::string              &original)
    : path_of_file(
        std::filesystem::absolute(original.empty() ? file_name : original)
          .string())
    , folder_of_file(
        std::filesystem::path(original.empty() ? file_name : original)
          .parent_path()
          .string())
  {
    read(file_name, "'" + printable(file_name) + "'", 0);
    append(overrides);
  }

  ParameterFile
  ParameterFile::from_text(const std::string              &text,
                           const std::string              &name,
                           const std::vector<std::string> &overrides)
  {
    ParameterFile      file;
    std::istringstream in(text);
    file.has_strict_lists = false;
    file.read_lines(in, name, "'" + printable(name) + "'", -1);
    file.append(overrides);
    return file;
  }

  std::string
  ParameterFile::name() const
  {
    return std::filesystem::path(path_of_file).stem().string();
  }

  std::size_t
  ParameterFile::equals_sign(const std::string &override_text) const
  {
    const auto is_section = [&](const std::string &name) {
      return std::any_of(lines.begin(), lines.end(), [&](const Line &line) {
        return line.text == "subsection " + name;
      });
    };
    std::size_t begin = 0; // of the next name
    for (;;)
      {
        const std::size_t slash  = override_text.find('/', begin),
                          equals = override_text.find('=', begin);
        if (slash == std::string::npos ||
            (equals < slash &&
             !is_section(trim(override_text.substr(begin, slash - begin)))))
          return equals;
        begin = slash + 1;
      }
  }

  void
  ParameterFile::append(const std::vector<std::string> &overrides)
  {
    for (const std::string &override_text : overrides)
      {
        const auto        equals = equals_sign(override_text);
        const std::string where  = "--set '" + printable(override_text) + "'";
        const auto [sections, name] =
          sections_and_name(override_text.substr(0, equals));
        if (equals == std::string::npos || name.empty() ||
            has_control_characters(override_text))
          throw InputError(where +
                           " cannot be understood\n"
                           "  allowed: 'Section/Subsection/Name = "
                           "value', in one line\n"
                           "  remedy:  e.g. --set 'Mesh/Cell size = "
                           "0.1'; 'geocone --help all' lists all names");
        for (const std::string &section : sections)
          lines.push_back({"subsection " + section, where, 0});
        lines.push_back(
          {"set " + name + " = " + trim(override_text.substr(equals + 1)),
           where,
           0});
        for (std::size_t i = 0; i < sections.size(); ++i)
          lines.push_back({"end", where, 0});
      }
  }

  void
  ParameterFile::read(const std::string &file_name,
                      const std::string &shown_name,
                      const int          depth)
  {
    const auto refuse = [&](const std::string &what,
                            const std::string &remedy) {
      throw InputError("the parameter file " + shown_name + " " + what +
                       "\n  remedy:  " + remedy);
    };
    if (depth > 20)
      refuse("includes itself", "take the include out");
    if (++n_files > most_files)
      refuse("is one of more than a thousand that are included",
             "include each file once");
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_name, error))
      refuse(std::filesystem::exists(file_name, error)
               ? "is no file"
               : "cannot be read: there is none of this name",
             "check the name; the examples are in prm/");
    if (std::filesystem::file_size(file_name, error) > largest_file)
      refuse("is larger than 16 MB", "give a parameter file");
    std::ifstream in(file_name, std::ios::binary);
    if (!in)
      refuse("cannot be read", "check its permissions");
    read_lines(in, file_name, shown_name, depth);
  }

  void
  ParameterFile::read_lines(std::istream      &in,
                            const std::string &file_name,
                            const std::string &shown_name,
                            const int          depth)
  {
    int open_sections = 0;
    int number        = 0;
    // Some editors begin UTF-8 files with a byte-order mark.
    if (in.peek() == 0xEF)
      {
        char mark[3];
        in.read(mark, 3);
      }
    const auto next = [&](std::string &line) {
      if (!std::getline(in, line))
        return false;
      ++number;
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      if (has_control_characters(line))
        throw InputError(
          "the parameter file " + shown_name + ", line " +
          std::to_string(number) +
          ": it has control characters\n"
          "  allowed: plain text, UTF-8 where it needs more than "
          "ASCII\n"
          "  remedy:  open it in an editor and save it as text");
      return true;
    };
    for (std::string line; next(line);)
      {
        const int first_number = number;
        while (!line.empty() && line.back() == '\\')
          {
            line.pop_back();
            std::string continuation;
            if (!next(continuation))
              break;
            line += trim(continuation);
          }
        line = trim(line.substr(0, line.find('#')));
        if (line.empty())
          continue;
        if (line.compare(0, 8, "include ") == 0 && depth >= 0)
          {
            std::filesystem::path included(trim(line.substr(8)));
            const std::string     shown =
              "'" + printable(included.string()) + "' (included by '" +
              std::filesystem::path(file_name).filename().string() +
              "', line " + std::to_string(first_number) + ")";
            if (included.is_relative())
              included =
                std::filesystem::path(file_name).parent_path() / included;
            read(included.string(), shown, depth + 1);
            continue;
          }
        open_sections += line.compare(0, 11, "subsection ") == 0 ? 1
                         : line == "end"                         ? -1
                                                                 : 0;
        if (open_sections < 0)
          throw InputError("file " + shown_name + ", line " +
                           std::to_string(first_number) +
                           ": 'end' without a subsection\n  remedy:  take it "
                           "out, or begin the section");
        lines.push_back({line, file_name, first_number, depth > 0});
      }
    if (open_sections != 0)
      throw InputError("file " + shown_name + ": " +
                       std::to_string(open_sections) +
                       " subsection(s) without 'end'\n  remedy:  end each "
                       "subsection");
  }

  std::vector<ParameterFile::SetLine>
  ParameterFile::set_lines(const bool checks) const
  {
    Declared declared;
    if (checks)
      declared = all_declared();
    std::vector<SetLine>     all;
    std::vector<std::string> path;
    std::size_t              left_out = 0; ///< subsections of a removed one
    for (const Line &line : lines)
      {
        if (line.text.compare(0, 11, "subsection ") == 0)
          {
            const std::string name = trim(line.text.substr(11));
            const auto        list =
              path.size() == 1 ? lists.find(path[0]) : lists.end();
            if (left_out > 0 ||
                (list != lists.end() &&
                 std::count(list->second.begin(), list->second.end(), name) ==
                   0))
              ++left_out;
            if (checks && left_out == 0)
              {
                const Declared *here = declared.find(path);
                if (here->sections.count(name) == 0)
                  throw InputError(
                    line.place() + ": unknown section '" +
                    printable(joined(path, name)) + "'" +
                    suggestion(name, joined(path, ""), keys(here->sections)));
              }
            path.push_back(name);
          }
        else if (line.text == "end")
          {
            path.pop_back();
            left_out -= left_out > 0;
          }
        else if (line.text.compare(0, 4, "set ") == 0 &&
                 line.text.find('=') != std::string::npos)
          {
            const std::size_t equals = line.text.find('=');
            if (left_out == 0)
              {
                const std::string written =
                                    trim(line.text.substr(4, equals - 4)),
                                  name = present_name(path, written);
                all.push_back({path,
                               name,
                               trim(line.text.substr(equals + 1)),
                               &line,
                               name == written ? "" : written});
              }
          }
        else if (checks)
          throw InputError(line.place() + ": '" + printable(line.text) +
                           "' cannot be understood\n"
                           "  allowed: 'set NAME = VALUE', 'subsection NAME', "
                           "'end', 'include FILE'\n"
                           "  remedy:  begin comments with #; prm/ has "
                           "examples");
      }
    return all;
  }

  std::string
  ParameterFile::peek(const std::string &path,
                      const std::string &default_value) const
  {
    const auto [sections, name] = sections_and_name(path);
    std::string value           = default_value;
    for (const SetLine &set : set_lines(false))
      if (set.sections == sections && set.name == name)
        value = set.value;
    return value;
  }

  std::map<std::string, const ParameterFile::Line *>
  ParameterFile::subsections_of(const std::string &section) const
  {
    std::map<std::string, const Line *> subsections;
    unsigned int                        depth  = 0;
    bool                                inside = false;
    for (const Line &line : lines)
      if (line.text.compare(0, 11, "subsection ") == 0)
        {
          const std::string name = trim(line.text.substr(11));
          if (depth == 0)
            inside = name == section;
          else if (depth == 1 && inside)
            subsections.emplace(name, &line);
          ++depth;
        }
      else if (line.text == "end")
        --depth;
    return subsections;
  }

  std::vector<std::string>
  ParameterFile::named_sections(const std::string &section,
                                const std::string &list,
                                const std::string &default_value) const
  {
    lists.erase(section); // all subsections count here
    const std::string     path = section + "/" + list;
    std::string           value;
    bool                  is_given = false;
    std::set<std::string> ever;
    for (const SetLine &set : set_lines(false))
      if (set.sections == std::vector<std::string>{section} && set.name == list)
        {
          is_given = true;
          value    = set.value;
          for (const std::string &name : split_names(value))
            ever.insert(name);
        }
    if (!is_given)
      {
        value = default_value;
        for (const std::string &name : split_names(value))
          ever.insert(name);
      }
    const std::vector<std::string> names       = split_names(value);
    const auto                     subsections = subsections_of(section);

    const auto refuse = [&](const std::string &remedy) {
      throw InputError(path,
                       value,
                       "different names, each of a subsection of '" + section +
                         "'",
                       remedy);
    };
    for (std::size_t i = 0; i < names.size(); ++i)
      {
        const std::string &name  = names[i];
        const std::string  shown = "the name '" + printable(name) + "' ";
        if (std::count(names.begin(), names.begin() + i, name) > 0)
          refuse(shown + "stands there twice");
        if (name.size() > longest_name ||
            name.find_first_of("/'\"\\.") != std::string::npos || name == list)
          refuse(shown + "cannot be that of a section: take at most " +
                 std::to_string(longest_name) +
                 " letters, digits, blanks, underscores and hyphens; no "
                 "quotes, and none of . / \\");
        if (is_given && has_strict_lists && subsections.count(name) == 0)
          refuse(
            "there is no 'subsection " + printable(name) + "' in '" + section +
            "'" + (subsections.empty() ? ": add it" : ", but " + [&]() {
              std::string all;
              for (const auto &[there, line] : subsections)
                all += (all.empty() ? "'" : ", '") + printable(there) + "'";
              return all;
            }() + ": check the spelling"));
      }
    if (has_strict_lists)
      for (const auto &[name, line] : subsections)
        if (ever.count(name) == 0)
          throw InputError(line->place() + ": the subsection '" +
                           printable(section + "/" + name) +
                           "' is in no list\n  allowed: subsections whose "
                           "names are in '" +
                           path + "', which is '" + printable(value) +
                           "'\n  remedy:  add it to that list, check the "
                           "spelling, or take the subsection out");
    lists[section] = names;
    return names;
  }

  std::vector<ParameterFile::Setting>
  ParameterFile::parse(const ParametersOfOtherKinds &of_others) const
  {
    choose_units(peek("Analysis/Units", "SI"));
    const Declared                 declared = all_declared();
    std::map<std::string, Setting> settings;
    for (const SetLine &set : set_lines(true))
      {
        const std::string path  = joined(set.sections, set.name);
        const Declared   *here  = declared.find(set.sections);
        const auto        entry = here->entries.find(set.name);
        if (entry == here->entries.end())
          {
            const auto others = set.sections.empty()
                                  ? of_others.end()
                                  : of_others.find(set.sections[0]);
            if (set.sections.size() == 2 && others != of_others.end() &&
                others->second.count(set.name) > 0)
              {
                settings[path] = {path,
                                  set.value,
                                  "",
                                  others->second.at(set.name),
                                  set.former_name,
                                  set.line->is_included};
                continue;
              }
            if (path == "Geometry/Run gmsh script")
              {
                if (set.value ==
                    "false") // in parameters.prm of earlier versions
                  continue;
                throw InputError(set.line->place() + ": '" + path +
                                 "' is no parameter any more: no file may "
                                 "allow that a program "
                                 "is run\n  remedy:  take it out; if you trust "
                                 "the script, give "
                                 "the option --run-gmsh-script");
              }
            const std::string elsewhere =
              set.sections.size() <= 1 ? path_of_entry(set.name, declared) : "";
            throw InputError(set.line->place() + ": unknown parameter '" +
                             printable(path) + "'" +
                             (elsewhere.empty()
                                ? suggestion(set.name,
                                             joined(set.sections, ""),
                                             keys(here->entries))
                                : did_you_mean(elsewhere)));
          }
        set_value(
          set.sections, set.name, set.value, entry->second, set.line->place());
        settings[path] = {path,
                          set.value,
                          entry->second.default_value,
                          "",
                          set.former_name,
                          set.line->is_included};
      }
    if (mass_unit() != 1.)
      convert_defaults(
        [&](const std::string &path) { return settings.count(path) > 0; });
    ParameterAcceptor::parse_all_parameters();
    std::vector<Setting> all;
    for (const auto &[path, setting] : settings)
      all.push_back(setting);
    return all;
  }

  std::string
  ParameterFile::value(const std::string &path)
  {
    const auto [sections, name] = sections_and_name(path);
    try
      {
        return ParameterAcceptor::prm.get(sections, name);
      }
    catch (const ParameterHandler::ExcEntryUndeclared &)
      {
        return "";
      }
  }

  std::vector<std::string>
  ParameterFile::declared_in(const std::string &section)
  {
    const Declared  declared = all_declared();
    const Declared *here     = declared.find(split_names(section, '/'));
    return here == nullptr ? std::vector<std::string>() : keys(here->entries);
  }

  void
  ParameterFile::print(std::ostream &out)
  {
    ParameterAcceptor::prm.print_parameters(
      out,
      ParameterHandler::PRM | ParameterHandler::Short |
        ParameterHandler::KeepDeclarationOrder);
  }
} // namespace geocone
