// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/hdf5_file.h>

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <type_traits>

#include <unistd.h>

namespace geocone
{
  namespace
  {
    template <typename T>
    hid_t
    type_id()
    {
      if constexpr (std::is_same_v<T, double>)
        return H5T_NATIVE_DOUBLE;
      else if constexpr (std::is_same_v<T, int>)
        return H5T_NATIVE_INT;
      else if constexpr (std::is_same_v<T, unsigned int>)
        return H5T_NATIVE_UINT;
      else if constexpr (std::is_same_v<T, long long>)
        return H5T_NATIVE_LLONG;
      else if constexpr (std::is_same_v<T, unsigned char>)
        return H5T_NATIVE_UCHAR;
      else
        return H5T_NATIVE_CHAR;
    }

    /** An object of the HDF5 library, closed with its scope. */
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*close)(hid_t))
        : id(id)
        , close(close)
      {}
      Handle(const Handle &) = delete;
      ~Handle()
      {
        if (id >= 0)
          close(id);
      }
      operator hid_t() const
      {
        return id;
      }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };

    /** Entries per chunk of a compressed array; HDF5 limits chunks to 4 GB. */
    constexpr hsize_t chunk_size = 1 << 20;

    /** Largest expansion of a byte compressed by deflate, a limit of the
     *  format. */
    constexpr std::size_t largest_expansion = 1032;

    /** Physical memory of this machine (bytes). */
    std::size_t
    physical_memory()
    {
      const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
      return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) * size
                                   : std::numeric_limits<std::size_t>::max();
    }
  } // namespace

  Hdf5File::Hdf5File(const std::string &file_name, const Access access)
    : file_name(file_name)
    , creates(access == Access::create)
  {
    // Errors are reported here, and a file must not make the library load code.
    H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
    H5PLset_loading_state(0);
    if (creates)
      {
        const Handle in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        H5Pset_fapl_core(in_memory, 1 << 20, false);
        id =
          H5Fcreate(file_name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory);
        if (id < 0)
          fail("cannot be made in memory");
        return;
      }
    std::error_code error;
    if (!std::filesystem::exists(file_name, error))
      fail("does not exist");
    if (!std::filesystem::is_regular_file(file_name, error))
      fail("is no regular file");
    file_size = std::filesystem::file_size(file_name, error);
    id        = H5Fopen(file_name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (id < 0)
      fail("is no HDF5 file, or is truncated");
  }

  Hdf5File::~Hdf5File()
  {
    if (id >= 0)
      H5Fclose(id);
  }

  void
  Hdf5File::close(const bool is_durable)
  {
    if (H5Fflush(id, H5F_SCOPE_GLOBAL) < 0)
      fail("cannot be completed in memory");
    const ssize_t     size = H5Fget_file_image(id, nullptr, 0);
    std::vector<char> image(std::max<ssize_t>(size, 0));
    if (size < 0 || H5Fget_file_image(id, image.data(), image.size()) < 0)
      fail("cannot be completed in memory");
    H5Fclose(id);
    id = -1;
    write_file(
      file_name,
      [&](std::ostream &out) { out.write(image.data(), image.size()); },
      is_durable);
  }

  void
  Hdf5File::fail(const std::string &what) const
  {
    throw RunError("the file '" + file_name + "' " + what);
  }

  template <typename T>
  void
  Hdf5File::write_array(const std::string &name,
                        const T           *values,
                        const std::size_t  n,
                        const std::size_t  n_columns,
                        const bool         compressed)
  {
    // Without columns, the array is one-dimensional.
    const std::array<hsize_t, 2> size = {
      {n_columns > 0 ? n / n_columns : n, n_columns}};
    const Handle space(
      H5Screate_simple(n_columns > 0 ? 2 : 1, size.data(), nullptr), H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (n_columns == 0 && n > 0 && compressed)
      {
        const hsize_t chunk = std::min<hsize_t>(n, chunk_size);
        H5Pset_chunk(properties, 1, &chunk);
        H5Pset_shuffle(properties);
        H5Pset_deflate(properties, 9);
      }
    const Handle data(create_array(name, type_id<T>(), space, properties),
                      H5Dclose);
    if (data < 0 ||
        H5Dwrite(data, type_id<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      fail("cannot take the array '" + name + "': is there too little memory?");
  }

  long long
  Hdf5File::create_array(const std::string &name,
                         const long long    type,
                         const long long    space,
                         const long long    properties)
  {
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    return H5Dcreate2(
      id, name.c_str(), type, space, links, properties, H5P_DEFAULT);
  }

  template <typename T>
  void
  Hdf5File::write_joined(const std::string       &name,
                         const std::vector<Part> &parts,
                         const unsigned int       n_columns_of_parts,
                         const unsigned int       n_columns)
  {
    // Entries of a one-dimensional array, or rows.
    const hsize_t per_row = n_columns > 0 ? 1 : n_columns_of_parts;
    hsize_t       n       = 0;
    for (const Part &part : parts)
      n += part.n_rows * per_row;
    const int                    n_dims = n_columns > 0 ? 2 : 1;
    const std::array<hsize_t, 2> size   = {{n, n_columns}};
    const Handle space(H5Screate_simple(n_dims, size.data(), nullptr),
                       H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    const T      zero = 0;
    H5Pset_fill_value(properties, type_id<T>(), &zero);
    bool    joined = true;
    hsize_t first  = 0;
    for (const Part &part : parts)
      {
        const std::array<hsize_t, 2> table = {
          {part.n_rows, n_columns_of_parts}};
        const std::array<hsize_t, 2> begin = {{first, 0}};
        const std::array<hsize_t, 2> count = {
          {part.n_rows * per_row, n_columns_of_parts}};
        const Handle there(H5Screate_simple(2, table.data(), nullptr),
                           H5Sclose);
        joined =
          joined &&
          H5Sselect_hyperslab(space,
                              H5S_SELECT_SET,
                              begin.data(),
                              nullptr,
                              count.data(),
                              nullptr) >= 0 &&
          H5Pset_virtual(
            properties, space, part.file.c_str(), part.name.c_str(), there) >=
            0;
        first += count[0];
      }
    const Handle data(create_array(name, type_id<T>(), space, properties),
                      H5Dclose);
    if (!joined || data < 0)
      fail("cannot take the joined array '" + name + "'");
  }

  template void
  Hdf5File::write_joined<double>(const std::string &,
                                 const std::vector<Part> &,
                                 const unsigned int,
                                 const unsigned int);
  template void
  Hdf5File::write_joined<long long>(const std::string &,
                                    const std::vector<Part> &,
                                    const unsigned int,
                                    const unsigned int);

  void
  Hdf5File::write_attribute(const std::string            &group,
                            const std::string            &name,
                            const std::vector<long long> &values)
  {
    const hsize_t n = values.size();
    const Handle  space(H5Screate_simple(1, &n, nullptr), H5Sclose);
    write_attribute(group, name, H5T_NATIVE_LLONG, space, values.data());
  }

  void
  Hdf5File::write_attribute(const std::string &group,
                            const std::string &name,
                            const std::string &text)
  {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, text.size());
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    write_attribute(group, name, type, space, text.data());
  }

  void
  Hdf5File::write_attribute(const std::string &group,
                            const std::string &name,
                            const long long    type,
                            const long long    space,
                            const void        *values)
  {
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    const Handle place(
      has(group)
        ? H5Gopen2(id, group.c_str(), H5P_DEFAULT)
        : H5Gcreate2(id, group.c_str(), links, H5P_DEFAULT, H5P_DEFAULT),
      H5Gclose);
    const Handle data(
      H5Acreate2(place, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
    if (place < 0 || data < 0 || H5Awrite(data, type, values) < 0)
      fail("cannot take the attribute '" + name + "' of '" + group + "'");
  }

  bool
  Hdf5File::has(const std::string &name) const
  {
    // H5Lexists() requires that all parent groups exist.
    for (std::size_t end = name.find('/');; end = name.find('/', end + 1))
      {
        if (H5Lexists(id, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
          return false;
        if (end == std::string::npos)
          return true;
      }
  }

  long long
  Hdf5File::open_array(const std::string &name,
                       const bool         of_integers,
                       std::size_t       &size) const
  {
    const std::string array = "has an array '" + name + "' that ";
    if (!has(name))
      fail("lacks the array '" + name + "'");
    for (std::size_t end = name.find('/');; end = name.find('/', end + 1))
      {
        H5L_info_t link;
        if (H5Lget_info(id, name.substr(0, end).c_str(), &link, H5P_DEFAULT) <
              0 ||
            link.type != H5L_TYPE_HARD)
          fail(array + "is a link to another place");
        if (end == std::string::npos)
          break;
      }
    const hid_t object = H5Oopen(id, name.c_str(), H5P_DEFAULT);
    if (object < 0)
      fail(array + "cannot be opened");
    if (H5Iget_type(object) != H5I_DATASET)
      {
        H5Oclose(object);
        fail("has a group or a type where the array '" + name + "' must be");
      }
    const Handle data(object, H5Oclose);

    const Handle      type(H5Dget_type(data), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    const std::size_t item = H5Tget_size(type);
    if (!(kind == H5T_INTEGER || (kind == H5T_FLOAT && !of_integers)) ||
        item < 1 || item > 8)
      fail(array + "does not hold " + (of_integers ? "integers" : "numbers"));

    const Handle space(H5Dget_space(data), H5Sclose);
    hsize_t      n = 0;
    if (H5Sget_simple_extent_type(space) != H5S_SIMPLE ||
        H5Sget_simple_extent_ndims(space) != 1 ||
        H5Sget_simple_extent_dims(space, &n, nullptr) != 1)
      fail(array + "has not one dimension");

    const Handle       properties(H5Dget_create_plist(data), H5Pclose);
    const H5D_layout_t layout = H5Pget_layout(properties);
    if ((layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED &&
         layout != H5D_COMPACT) ||
        H5Pget_external_count(properties) != 0)
      fail(array + "lies in another file");
    for (int i = 0; i < H5Pget_nfilters(properties); ++i)
      {
        unsigned int flags, setting;
        std::size_t  n_values = 0;
        const auto   filter   = H5Pget_filter2(
          properties, i, &flags, &n_values, nullptr, 0, nullptr, &setting);
        if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
            filter != H5Z_FILTER_FLETCHER32)
          fail(array + "is packed by another filter than gzip, shuffle or "
                       "fletcher32");
      }

    // The size claimed by a damaged file is never allocated.
    const auto fits = [&](const hsize_t n_items) {
      return n_items <= (largest_expansion * file_size + chunk_size) / item &&
             n_items <= physical_memory() / sizeof(double);
    };
    hsize_t chunk = 0;
    if (!fits(n) ||
        (layout == H5D_CHUNKED &&
         (H5Pget_chunk(properties, 1, &chunk) != 1 || !fits(chunk))))
      fail(array + "claims " + std::to_string(std::max(n, chunk)) +
           " entries, more than the file or the memory can hold");
    // If less is stored, the library would read beyond it.
    if (layout != H5D_CHUNKED && n > 0 && H5Dget_storage_size(data) < n * item)
      fail(array + "holds less than it announces");
    size = n;
    H5Iinc_ref(object);
    return object;
  }

  std::size_t
  Hdf5File::length(const std::string &name) const
  {
    std::size_t n = 0;
    H5Oclose(open_array(name, false, n));
    return n;
  }

  template <typename T>
  std::vector<T>
  Hdf5File::read_array(const std::string &name) const
  {
    std::size_t    n = 0;
    const Handle   data(open_array(name, !std::is_same_v<T, double>, n),
                      H5Oclose);
    std::vector<T> values(n);
    if (H5Dread(
          data, type_id<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      fail("has an array '" + name + "' that cannot be read");
    return values;
  }

  void
  Hdf5File::write(const std::string &name, const std::vector<double> &values)
  {
    write_array(name, values.data(), values.size(), 0);
  }

  void
  Hdf5File::write(const std::string &name, const std::vector<int> &values)
  {
    write_array(name, values.data(), values.size(), 0);
  }

  void
  Hdf5File::write(const std::string &name, const std::vector<long long> &values)
  {
    write_array(name, values.data(), values.size(), 0);
  }

  void
  Hdf5File::write(const std::string                &name,
                  const std::vector<unsigned char> &values)
  {
    write_array(name, values.data(), values.size(), 0);
  }

  void
  Hdf5File::write(const std::string &name, const std::string &text)
  {
    write_array(name, text.data(), text.size(), 0);
  }

  void
  Hdf5File::write_plain(const std::string         &name,
                        const std::vector<double> &values)
  {
    write_array(name, values.data(), values.size(), 0, false);
  }

  void
  Hdf5File::write_table(const std::string         &name,
                        const std::vector<double> &values,
                        const unsigned int         n_columns)
  {
    write_array(name, values.data(), values.size(), n_columns);
  }

  void
  Hdf5File::write_table(const std::string               &name,
                        const std::vector<unsigned int> &values,
                        const unsigned int               n_columns)
  {
    write_array(name, values.data(), values.size(), n_columns);
  }

  std::vector<double>
  Hdf5File::read_doubles(const std::string &name) const
  {
    return read_array<double>(name);
  }

  std::vector<double>
  Hdf5File::read_doubles(const std::string &name,
                         const std::size_t  first,
                         const std::size_t  n) const
  {
    std::size_t         size = 0;
    const Handle        data(open_array(name, false, size), H5Oclose);
    std::vector<double> values(n);
    const hsize_t       begin = first, count = n;
    const Handle        there(H5Dget_space(data), H5Sclose);
    const Handle        here(H5Screate_simple(1, &count, nullptr), H5Sclose);
    if (first > size || n > size - first ||
        H5Sselect_hyperslab(
          there, H5S_SELECT_SET, &begin, nullptr, &count, nullptr) < 0 ||
        H5Dread(
          data, type_id<double>(), here, there, H5P_DEFAULT, values.data()) < 0)
      fail("has an array '" + name + "' that cannot be read");
    return values;
  }

  std::vector<int>
  Hdf5File::read_integers(const std::string &name) const
  {
    // Through a wider type, because the library would clip larger values.
    const std::vector<long long> values = read_array<long long>(name);
    for (const long long value : values)
      if (value < std::numeric_limits<int>::min() ||
          value > std::numeric_limits<int>::max())
        fail("has an array '" + name + "' with the number " +
             std::to_string(value) + ", which is no int");
    return std::vector<int>(values.begin(), values.end());
  }

  std::string
  Hdf5File::read_text(const std::string &name) const
  {
    const std::vector<char> text = read_array<char>(name);
    return std::string(text.begin(), text.end());
  }
} // namespace geocone
