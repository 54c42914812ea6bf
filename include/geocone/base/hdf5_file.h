// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_base_hdf5_file_h
#define geocone_base_hdf5_file_h

#include <cstddef>
#include <string>
#include <vector>

namespace geocone
{
  /**
   * An HDF5 file of named arrays, of one process.
   *
   * A new one is built in memory, and close() writes it whole (write_file()):
   * the library never has a file of the disk open for writing, which it could not
   * close where the disk is full. Needs twice the size of the file.
   *
   * One that is read may come from anywhere. Arrays are read only if they are
   * plain: in the file itself, without filters that the library would load from
   * elsewhere, and no larger than the file and the memory allow.
   *
   * @throws RunError naming the file where it cannot be written, or what is wrong
   * in it
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

    /** @name Arrays with one dimension, compressed */
    /** @{ */
    void
    write(const std::string &name, const std::vector<double> &values);
    void
    write(const std::string &name, const std::vector<int> &values);
    void
    write(const std::string &name, const std::vector<long long> &values);
    void
    write(const std::string &name, const std::vector<unsigned char> &values);
    void
    write(const std::string &name, const std::string &text);
    /** @} */

    /** An array with one dimension, not compressed: fast. */
    void
    write_plain(const std::string &name, const std::vector<double> &values);

    /** @name Tables with the rows one after another, not compressed */
    /** @{ */
    void
    write_table(const std::string         &name,
                const std::vector<double> &values,
                const unsigned int         n_columns);
    void
    write_table(const std::string               &name,
                const std::vector<unsigned int> &values,
                const unsigned int               n_columns);
    /** @} */

    /** Rows of a table in a file beside this one. */
    struct Part
    {
      std::string file, name;
      std::size_t n_rows;
    };

    /**
     * An array whose rows stand, part after part, in tables of other files: this one
     * only names them (HDF5's virtual datasets). It has @p n_columns, of which those
     * that the parts lack are 0; or, for 0, one dimension, with their rows one after
     * another. @tparam T of the numbers that readers get: double or long long
     */
    template <typename T>
    void
    write_joined(const std::string       &name,
                 const std::vector<Part> &parts,
                 const unsigned int       n_columns_of_parts,
                 const unsigned int       n_columns);

    /** @name Attributes of a group, which is made if it is not there */
    /** @{ */
    void
    write_attribute(const std::string            &group,
                    const std::string            &name,
                    const std::vector<long long> &values);
    void
    write_attribute(const std::string &group,
                    const std::string &name,
                    const std::string &text);
    /** @} */

    /** Writes a file that was created. */
    void
    close(const bool is_durable = false);

    /** Whether there is anything of this name. */
    bool
    has(const std::string &name) const;

    /** Entries of an array with one dimension. */
    std::size_t
    length(const std::string &name) const;

    /** @name Arrays with one dimension */
    /** @{ */
    std::vector<double>
    read_doubles(const std::string &name) const;
    std::vector<double>
    read_doubles(const std::string &name,
                 const std::size_t  first,
                 const std::size_t  n) const;
    std::vector<int>
    read_integers(const std::string &name) const;
    std::string
    read_text(const std::string &name) const;
    /** @} */

  private:
    template <typename T>
    void
    write_array(const std::string &name,
                const T           *values,
                const std::size_t  n,
                const std::size_t  n_columns,
                const bool         compressed = true);
    /** Makes an array, with all groups on the way to it. */
    long long
    create_array(const std::string &name,
                 const long long    type,
                 const long long    space,
                 const long long    properties);
    void
    write_attribute(const std::string &group,
                    const std::string &name,
                    const long long    type,
                    const long long    space,
                    const void        *values);

    template <typename T>
    std::vector<T>
    read_array(const std::string &name) const;

    /** Opens an array that is plain; @p size: its entries. */
    long long
    open_array(const std::string &name,
               const bool         of_integers,
               std::size_t       &size) const;

    [[noreturn]] void
    fail(const std::string &what) const;

    const std::string file_name;
    const bool        creates;
    std::size_t       file_size = 0;  ///< of a file that is read (bytes)
    long long         id        = -1; ///< of the HDF5 library, < 0 if closed
  };
} // namespace geocone

#endif
