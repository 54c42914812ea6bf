// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_state_row_h
#define geocone_base_state_row_h

#include <geocone/base/exceptions.h>

#include <array>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace geocone
{
  /**
   * Serialises variables into an array of numbers and restores them from the
   * array, e.g. for a checkpoint. The same list of variables is used for
   * writing and reading:
   *   void state(StateRow &row) { row(time, step, records); }
   * Supported are numbers that a double represents exactly, texts, arrays,
   * vectors and tensors of numbers, and classes with a function state(StateRow
   * &).
   */
  class StateRow
  {
  public:
    /** Creates a serialiser with an empty array. */
    StateRow()
      : reads(false)
    {}

    /** Creates a deserialiser that reads an array. */
    explicit StateRow(std::vector<double> values)
      : reads(true)
      , row(std::move(values))
    {}

    bool
    is_read() const
    {
      return reads;
    }

    const std::vector<double> &
    values() const
    {
      return row;
    }

    /** Returns true if all numbers of the array have been read. */
    bool
    at_end() const
    {
      return next == row.size();
    }

    template <typename... T>
    void
    operator()(T &...variables)
    {
      (item(variables), ...);
    }

  private:
    template <typename T>
    using HasState =
      decltype(std::declval<T &>().state(std::declval<StateRow &>()));

    template <typename T, typename = void>
    struct IsClass : std::false_type
    {};
    template <typename T>
    struct IsClass<T, std::void_t<HasState<T>>> : std::true_type
    {};

    /** Number of components of a tensor, point or Mandel vector. */
    template <typename T>
    static constexpr auto
    n_components() -> decltype(int(T::dimension))
    {
      return T::dimension;
    }
    template <typename T>
    static constexpr auto
    n_components() -> decltype(int(T::SizeAtCompileTime))
    {
      return T::SizeAtCompileTime;
    }

    template <typename T>
    void
    item(T &x)
    {
      if constexpr (std::is_arithmetic_v<T>)
        {
          double value = static_cast<double>(x);
          number(value);
          x = static_cast<T>(value);
        }
      else if constexpr (IsClass<T>::value)
        x.state(*this);
      else
        for (int d = 0; d < n_components<T>(); ++d)
          item(x[d]);
    }

    template <typename T>
    void
    item(std::vector<T> &list)
    {
      resize(list);
      for (T &x : list)
        item(x);
    }

    void
    item(std::string &text)
    {
      resize(text);
      for (char &c : text)
        item(c);
    }

    template <typename T, std::size_t n>
    void
    item(std::array<T, n> &list)
    {
      for (T &x : list)
        item(x);
    }

    template <typename A, typename B>
    void
    item(std::pair<A, B> &two)
    {
      item(two.first);
      item(two.second);
    }

    template <typename List>
    void
    resize(List &list)
    {
      double n = list.size();
      number(n);
      if (reads)
        {
          if (!(n >= 0. && n <= static_cast<double>(row.size())))
            fail();
          list.resize(static_cast<std::size_t>(n));
        }
    }

    void
    number(double &x)
    {
      if (!reads)
        row.push_back(x);
      else if (next < row.size())
        x = row[next++];
      else
        fail();
    }

    [[noreturn]] static void
    fail()
    {
      throw RunError("a row of its numbers is of another length");
    }

    const bool          reads;
    std::vector<double> row;
    std::size_t         next = 0;
  };
} // namespace geocone

#endif
