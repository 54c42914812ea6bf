// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_exceptions_h
#define geocone_base_exceptions_h

#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

namespace geocone
{
  /** A text from outside as it may be shown: control characters as \xNN, and no
   *  more than 200 of its bytes. */
  inline std::string
  printable(const std::string &text)
  {
    static const char *const digits = "0123456789abcdef";
    std::string              shown;
    for (const char c : text.substr(0, 200))
      if (const auto code = static_cast<unsigned char>(c);
          code < 32 || code == 127)
        shown += std::string("\\x") + digits[code / 16] + digits[code % 16];
      else
        shown += c;
    return text.size() > 200 ? shown + "..." : shown;
  }

  /** What an error says; of memory that is not there, with a remedy. */
  inline std::string
  text_of(const std::exception &error)
  {
    if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr)
      return "out of memory\n  remedy:  a smaller run; 'geocone --dry-run "
             "FILE.prm' tells how large it is and by which parameter";
    return error.what();
  }

  /**
   * Wrong input, found before anything is computed or written. The text names
   * the parameter (with its sections), the value, what is allowed, and how to
   * mend it. The programs print it and end with exit code 1.
   */
  class InputError : public std::runtime_error
  {
  public:
    template <typename Value>
    InputError(const std::string &parameter,
               const Value       &value,
               const std::string &allowed,
               const std::string &remedy)
      : std::runtime_error(text(parameter, value, allowed, remedy))
    {}

    explicit InputError(const std::string &message)
      : std::runtime_error(message)
    {}

  private:
    template <typename Value>
    static std::string
    text(const std::string &parameter,
         const Value       &value,
         const std::string &allowed,
         const std::string &remedy)
    {
      std::ostringstream shown, out;
      shown << value;
      out << "parameter '" << parameter << "' = '" << printable(shown.str())
          << "'\n"
          << "  allowed: " << allowed << "\n"
          << "  remedy:  " << remedy;
      return out.str();
    }
  };

  /**
   * A computation that cannot go on: steps that fail at the smallest step
   * size, a file that cannot be written, a value that is not a number.
   * Results written before stay as they are.
   */
  class RunError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** A RunError that all ranks find together, so that they can end together. */
  class StepFailure : public RunError
  {
  public:
    using RunError::RunError;
  };
} // namespace geocone

#endif
