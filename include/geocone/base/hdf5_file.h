// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_hdf5_file_h
#define geocone_base_hdf5_file_h

#include <string>
#include <vector>

namespace geocone
{
  /**
   * An HDF5 file of named arrays, of one process. It is written whole: into a
   * temporary name first, renamed by close(), so that a reader never sees a part
   * of it. Arrays are compressed.
   * @throws RunError naming the file where it cannot be written or lacks an array
   */
  class Hdf5File
  {
  public:
    enum class Access
    {
      create,
      read
    };

    Hdf5File(const std::string &file_name, const Access access);
    ~Hdf5File();
    Hdf5File(const Hdf5File &) = delete;
    Hdf5File &
    operator=(const Hdf5File &) = delete;

    /** @name The array types that files have */
    /** @{ */
    void
    write(const std::string &name, const std::vector<double> &values);
    void
    write(const std::string &name, const std::vector<int> &values);
    void
    write(const std::string &name, const std::string &text);
    std::vector<double>
    read_doubles(const std::string &name) const;
    std::vector<int>
    read_integers(const std::string &name) const;
    std::string
    read_text(const std::string &name) const;
    /** @} */

    /** Completes a file that was created. */
    void
    close();

  private:
    template <typename T>
    void
    write_array(const std::string &name, const T *values, const std::size_t n);
    template <typename T>
    std::vector<T>
    read_array(const std::string &name) const;

    [[noreturn]] void
    fail(const std::string &what) const;

    const std::string file_name;
    const bool        creates;
    long long         id = -1; ///< of the HDF5 library, < 0 if closed
  };
} // namespace geocone

#endif
