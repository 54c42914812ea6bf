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
   * HDF5 file of named arrays, accessed by a single process.
   *
   * A new file is built in memory and written in one piece by close(), because
   * the HDF5 library could not close a file on a full disk. This requires
   * memory of twice the size of the file.
   *
   * Files to be read are not trusted. Arrays are read only if they are stored
   * in the file itself, without filters that the library would have to load,
   * and are no larger than the file and the memory allow.
   *
   * @throws RunError with the file name if it cannot be written or is invalid
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

    /** @name Writing of compressed one-dimensional arrays */
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

    /** Writes a one-dimensional array without compression, for speed. */
    void
    write_plain(const std::string &name, const std::vector<double> &values);

    /** @name Writing of uncompressed tables in row-major order */
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

    /** Source of a virtual dataset: a table in another file in the same
     *  folder. */
    struct Part
    {
      std::string file, name;
      std::size_t n_rows;
    };

    /**
     * Writes an HDF5 virtual dataset that concatenates the rows of tables
     * stored in other files. The dataset has @p n_columns columns (0 in columns
     * missing in a part) or, for @p n_columns = 0, is one-dimensional, with the
     * rows concatenated.
     * @tparam T number type of readers: double or long long
     */
    template <typename T>
    void
    write_joined(const std::string       &name,
                 const std::vector<Part> &parts,
                 const unsigned int       n_columns_of_parts,
                 const unsigned int       n_columns);

    /** @name Writing of attributes of a group, which is created if missing */
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

    /** Writes a new file to disk and closes it. @param is_durable see
     *  write_file() */
    void
    close(const bool is_durable = false);

    /** Returns true if the file contains an object with the given name. */
    bool
    has(const std::string &name) const;

    /** Returns the number of entries of a one-dimensional array. */
    std::size_t
    length(const std::string &name) const;

    /** @name Reading of one-dimensional arrays */
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
    /** Creates an array and all HDF5 groups on its path. @return HDF5
     *  identifier */
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

    /** Opens an array for reading after safety checks, see Hdf5File.
     *  @param[out] size number of entries
     *  @return HDF5 identifier */
    long long
    open_array(const std::string &name,
               const bool         of_integers,
               std::size_t       &size) const;

    [[noreturn]] void
    fail(const std::string &what) const;

    const std::string file_name;
    const bool        creates;
    std::size_t       file_size = 0;  ///< size of the file to read (bytes)
    long long         id        = -1; ///< HDF5 identifier; < 0: closed
  };
} // namespace geocone

#endif
