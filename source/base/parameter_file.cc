// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <ostream>
#include <regex>
#include <sstream>

namespace geocone
{
  namespace
  {
    using dealii::ParameterAcceptor;
    using dealii::ParameterHandler;
    using dealii::Utilities::trim;

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

    std::string
    nearest(const std::string &name, const std::vector<std::string> &known)
    {
      std::string  best;
      unsigned int distance = 1000;
      for (const std::string &candidate : known)
        if (const unsigned int d = edit_distance(name, candidate); d < distance)
          {
            distance = d;
            best     = candidate;
          }
      return best;
    }

    /** The declared names, as the tree that ParameterHandler prints. */
    struct DeclaredNames
    {
      std::vector<std::string>                           entries;
      std::vector<std::pair<std::string, DeclaredNames>> sections;

      const DeclaredNames *
      find(const std::string &name) const
      {
        for (const auto &section : sections)
          if (section.first == name)
            return &section.second;
        return nullptr;
      }
    };

    DeclaredNames
    declared_names()
    {
      std::ostringstream out;
      ParameterAcceptor::prm.print_parameters(
        out, ParameterHandler::Short | ParameterHandler::PRM);
      std::istringstream           in(out.str());
      DeclaredNames                root;
      std::vector<DeclaredNames *> stack = {&root};
      for (std::string line; std::getline(in, line);)
        {
          line = trim(line);
          if (line.compare(0, 11, "subsection ") == 0)
            {
              stack.back()->sections.emplace_back(trim(line.substr(11)),
                                                  DeclaredNames());
              stack.push_back(&stack.back()->sections.back().second);
            }
          else if (line == "end")
            stack.pop_back();
          else if (line.compare(0, 4, "set ") == 0)
            stack.back()->entries.push_back(
              trim(line.substr(4, line.find('=') - 4)));
        }
      return root;
    }

    std::string
    joined(const std::vector<std::string> &sections, const std::string &name)
    {
      std::string path;
      for (const std::string &section : sections)
        path += section + "/";
      return path + name;
    }
  } // namespace

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

  ParameterFile::ParameterFile(const std::string              &file_name,
                               const std::vector<std::string> &overrides)
    : folder_of_file(std::filesystem::path(file_name).parent_path().string())
  {
    read(file_name, "'" + file_name + "'", 0);
    append(overrides);
  }

  ParameterFile
  ParameterFile::from_text(const std::string              &text,
                           const std::string              &name,
                           const std::vector<std::string> &overrides)
  {
    ParameterFile      file;
    std::istringstream in(text);
    int                number = 0;
    for (std::string line; std::getline(in, line);)
      file.lines.push_back(
        {trim(line), "the materials of '" + name + "'", ++number});
    file.append(overrides);
    return file;
  }

  void
  ParameterFile::append(const std::vector<std::string> &overrides)
  {
    for (const std::string &override_text : overrides)
      {
        const auto        equals = override_text.find('=');
        const std::string where =
          "--set '" + override_text.substr(0, 200) + "'";
        const auto [sections, name] =
          sections_and_name(override_text.substr(0, equals));
        if (equals == std::string::npos || name.empty())
          throw InputError(where + " is not of the form\n"
                                   "  'Section/Subsection/Name = value'");
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
    if (depth > 20)
      throw InputError("the parameter file " + shown_name + " includes itself");
    std::ifstream in(file_name);
    if (!in || std::filesystem::is_directory(file_name))
      throw InputError("the parameter file " + shown_name +
                       " cannot be read\n"
                       "  remedy:  check the name; the examples are in prm/");
    int open_sections = 0;
    int number        = 0;
    for (std::string line; std::getline(in, line);)
      {
        ++number;
        const int first_number = number;
        while (!line.empty() && line.back() == '\\')
          {
            line.pop_back();
            std::string continuation;
            if (!std::getline(in, continuation))
              break;
            ++number;
            line += trim(continuation);
          }
        line = trim(line.substr(0, line.find('#')));
        if (line.empty())
          continue;
        if (line.compare(0, 8, "include ") == 0)
          {
            std::filesystem::path included(trim(line.substr(8)));
            const std::string     shown =
              "'" + included.string() + "' (included by '" +
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
          throw InputError("file '" + file_name + "', line " +
                           std::to_string(first_number) +
                           ": 'end' without a subsection");
        lines.push_back({line, file_name, first_number});
      }
    if (open_sections != 0)
      throw InputError("file '" + file_name +
                       "': " + std::to_string(open_sections) +
                       " subsection(s) without 'end'");
  }

  std::string
  ParameterFile::text() const
  {
    std::string all;
    for (const Line &line : lines)
      all += line.text + "\n";
    return all;
  }

  std::string
  ParameterFile::peek(const std::string &path,
                      const std::string &default_value) const
  {
    const auto [sections, name] = sections_and_name(path);
    std::vector<std::string> stack;
    std::string              value = default_value;
    for (const Line &line : lines)
      if (line.text.compare(0, 11, "subsection ") == 0)
        stack.push_back(trim(line.text.substr(11)));
      else if (line.text == "end")
        stack.pop_back();
      else if (line.text.compare(0, 4, "set ") == 0 && stack == sections)
        {
          const auto equals = line.text.find('=');
          if (equals != std::string::npos &&
              trim(line.text.substr(4, equals - 4)) == name)
            value = trim(line.text.substr(equals + 1));
        }
    return value;
  }

  std::vector<std::string>
  ParameterFile::peek_list(const std::string &path,
                           const std::string &default_value) const
  {
    const std::vector<std::string> names =
      split_names(peek(path, default_value));
    for (std::size_t i = 0; i < names.size(); ++i)
      if (std::find(names.begin(), names.begin() + i, names[i]) !=
          names.begin() + i)
        throw InputError(path,
                         peek(path, default_value),
                         "a comma-separated list of different names",
                         "the name '" + names[i] + "' stands there twice");
    return names;
  }

  std::vector<std::string>
  ParameterFile::named_sections(const std::string &section,
                                const std::string &list,
                                const std::string &default_value,
                                std::size_t       &n_listed) const
  {
    std::vector<std::string> names =
      peek_list(section + "/" + list, default_value);
    n_listed = names.size();
    std::vector<std::string> stack;
    for (const Line &line : lines)
      if (line.text.compare(0, 11, "subsection ") == 0)
        {
          const std::string name = trim(line.text.substr(11));
          if (stack.size() == 1 && stack[0] == section &&
              std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
          stack.push_back(name);
        }
      else if (line.text == "end")
        stack.pop_back();
    return names;
  }

  void
  ParameterFile::check_names() const
  {
    const DeclaredNames                root  = declared_names();
    std::vector<const DeclaredNames *> stack = {&root};
    std::vector<std::string>           path;
    for (const Line &line : lines)
      {
        const std::string where =
          line.number == 0
            ? line.file + ": "
            : "file '" + std::filesystem::path(line.file).filename().string() +
                "', line " + std::to_string(line.number) + ": ";
        if (line.text.compare(0, 11, "subsection ") == 0)
          {
            const std::string    name  = trim(line.text.substr(11));
            const DeclaredNames *below = stack.back()->find(name);
            if (below == nullptr)
              {
                std::vector<std::string> known;
                for (const auto &section : stack.back()->sections)
                  known.push_back(section.first);
                throw InputError(
                  where + "unknown section '" + joined(path, name) + "'" +
                  (known.empty()
                     ? "\n  remedy:  this section has no subsections"
                     : "\n  remedy:  did you mean '" +
                         joined(path, nearest(name, known)) + "'?"));
              }
            stack.push_back(below);
            path.push_back(name);
          }
        else if (line.text == "end")
          {
            stack.pop_back();
            path.pop_back();
          }
        else if (line.text.compare(0, 4, "set ") == 0 &&
                 line.text.find('=') != std::string::npos)
          {
            const std::string name =
              trim(line.text.substr(4, line.text.find('=') - 4));
            const auto &known = stack.back()->entries;
            if (std::find(known.begin(), known.end(), name) == known.end())
              throw InputError(
                where + "unknown parameter '" + joined(path, name) + "'" +
                (known.empty() ? "\n  remedy:  this section has no entries"
                               : "\n  remedy:  did you mean '" +
                                   joined(path, nearest(name, known)) +
                                   "'? 'geocone --help' lists all"));
          }
        else
          throw InputError(where + "cannot be understood: '" + line.text +
                           "'\n  allowed: 'set NAME = VALUE', 'subsection "
                           "NAME', 'end', 'include FILE'");
      }
  }

  void
  ParameterFile::parse() const
  {
    check_names();
    try
      {
        ParameterAcceptor::prm.parse_input_from_string(text());
      }
    catch (const dealii::ExceptionBase &exception)
      {
        // The library's message holds the line, the value and the pattern.
        std::ostringstream out;
        exception.print_info(out);
        std::string      message = trim(out.str());
        std::smatch      match;
        const std::regex line_number("[Ll]ine <?(\\d+)>?( of|, | in)");
        if (std::regex_search(message, match, line_number))
          {
            const int i = std::stoi(match[1]) - 1;
            if (i >= 0 && i < static_cast<int>(lines.size()))
              message =
                (lines[i].number == 0
                   ? lines[i].file
                   : "file '" +
                       std::filesystem::path(lines[i].file)
                         .filename()
                         .string() +
                       "', line " + std::to_string(lines[i].number)) +
                ": '" + lines[i].text + "'\n  " +
                std::regex_replace(message,
                                   std::regex("^[^:]*:\\s*"),
                                   "",
                                   std::regex_constants::format_first_only);
          }
        throw InputError(
          std::regex_replace(message, std::regex("\\s*\n\\s+"), " "));
      }
    ParameterAcceptor::parse_all_parameters();
  }

  std::string
  ParameterFile::section(const std::string &name)
  {
    std::ostringstream out;
    print(out, false);
    std::istringstream in(out.str());
    std::string        text;
    bool               inside = false;
    for (std::string line; std::getline(in, line);)
      {
        inside = inside || line == "subsection " + name;
        if (inside)
          text += line + "\n";
        inside = inside && line != "end"; // those inside of it are indented
      }
    return text;
  }

  void
  ParameterFile::print(std::ostream &out, const bool with_documentation)
  {
    ParameterAcceptor::prm.print_parameters(
      out,
      (with_documentation ? ParameterHandler::PRM
                          : ParameterHandler::PRM | ParameterHandler::Short) |
        ParameterHandler::KeepDeclarationOrder);
  }
} // namespace geocone
