// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_choice_h
#define geocone_base_choice_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <utility>
#include <vector>

namespace geocone
{
  /**
   * Parameter with a fixed list of admissible words as values. Each word
   * represents an enumerator or a pointer. The list of words begins the
   * documentation of the parameter; any other word is rejected.
   */
  template <typename Enum>
  class Choice
  {
  public:
    using Words = std::vector<std::pair<const char *, Enum>>;

    /** Creates the parameter, with the first word as default value.
     *  @param words admissible words with their values; the first is the
     *  default */
    Choice(const Words &words)
      : words(words)
      , value(words.front().second)
    {}

    operator Enum() const
    {
      return value;
    }

    Enum
    get() const
    {
      return value;
    }

    Choice &
    operator=(const Enum other)
    {
      value = other;
      return *this;
    }

    /** Selects the value that corresponds to the word @p given. */
    void
    set(const std::string &given)
    {
      for (const auto &[word, meant] : words)
        if (given == word)
          value = meant;
    }

    /** Returns the current value as a word, as written in the parameter
     *  file. */
    std::string
    word() const
    {
      for (const auto &[word, meant] : words)
        if (meant == value)
          return word;
      return "";
    }

    /** Declares the parameter in the section of a ParameterAcceptor. */
    void
    declare(dealii::ParameterAcceptor &acceptor,
            const std::string         &entry,
            const std::string         &documentation)
    {
      std::string selection, list;
      for (const auto &[word, meant] : words)
        {
          (void)meant;
          selection += (selection.empty() ? "" : "|") + std::string(word);
          list += (list.empty() ? "" : " | ") + std::string(word);
        }
      dealii::ParameterHandler &prm = dealii::ParameterAcceptor::prm;
      acceptor.enter_my_subsection(prm);
      prm.declare_entry(entry,
                        word(),
                        dealii::Patterns::Selection(selection),
                        list + documentation);
      prm.add_action(entry, [this](const std::string &given) { set(given); });
      acceptor.leave_my_subsection(prm);
    }

  private:
    Words words;
    Enum  value;
  };
} // namespace geocone

#endif
