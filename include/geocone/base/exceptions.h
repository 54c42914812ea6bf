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
  /** Converts untrusted text to printable form. Control characters are
   *  replaced by \xNN, and the text is truncated after 200 bytes. */
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

  /** Returns the message of an exception. For `std::bad_alloc`, the message
   *  includes a remedy. */
  inline std::string
  text_of(const std::exception &error)
  {
    if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr)
      return "out of memory\n  remedy:  a smaller run; 'geocone --dry-run "
             "FILE.prm' reports its size and the parameter that causes it";
    return error.what();
  }

  /**
   * Exception for invalid input, thrown before anything is computed or written.
   * The text states the parameter (with its sections), the value, the
   * admissible values and the remedy. The programs print the text and exit with
   * code 1.
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

  /** Rejects the value of a parameter unless a condition holds. @throws
   *  InputError */
  template <typename Value>
  void
  require(const bool         holds,
          const std::string &parameter,
          const Value       &value,
          const std::string &allowed,
          const std::string &remedy)
  {
    if (!holds)
      throw InputError(parameter, value, allowed, remedy);
  }

  /**
   * Exception for a computation that cannot continue. Examples are a step that
   * fails at the smallest step size, a file that cannot be written, and a value
   * that is not a number. Results written before the error are kept.
   */
  class RunError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** Exception thrown by all ranks at the same point of the program, so that
   *  all ranks terminate normally. */
  class StepFailure : public RunError
  {
  public:
    using RunError::RunError;
  };
} // namespace geocone

#endif
