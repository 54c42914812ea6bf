// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/hdf5_file.h>

#include <hdf5.h>

#include <filesystem>
#include <type_traits>

namespace geocone
{
  namespace
  {
    const std::string format_name = "geocone-1";

    template <typename T>
    hid_t
    type_id()
    {
      if constexpr (std::is_same_v<T, double>)
        return H5T_NATIVE_DOUBLE;
      else if constexpr (std::is_same_v<T, int>)
        return H5T_NATIVE_INT;
      else
        return H5T_NATIVE_CHAR;
    }
  } // namespace

  Hdf5File::Hdf5File(const std::string &file_name, const Access access)
    : file_name(file_name)
    , creates(access == Access::create)
  {
    H5Eset_auto(H5E_DEFAULT, nullptr, nullptr); // errors are named here
    if (creates)
      {
        id = H5Fcreate((file_name + ".part").c_str(),
                       H5F_ACC_TRUNC,
                       H5P_DEFAULT,
                       H5P_DEFAULT);
        if (id < 0)
          fail("cannot be written: does its folder exist, and is it writable?");
        write("format", format_name);
      }
    else
      {
        if (!std::filesystem::exists(file_name))
          fail("does not exist");
        id = H5Fopen(file_name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
        if (id < 0)
          fail("is no HDF5 file, or is truncated");
        if (read_text("format") != format_name)
          fail("has another format than '" + format_name + "'");
      }
  }

  Hdf5File::~Hdf5File()
  {
    if (id >= 0)
      H5Fclose(id);
  }

  void
  Hdf5File::close()
  {
    const hid_t open = id;
    id               = -1;
    if (H5Fclose(open) < 0)
      fail("cannot be completed: is the disk full?");
    std::error_code error;
    std::filesystem::rename(file_name + ".part", file_name, error);
    if (error)
      fail("cannot be completed: " + error.message());
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
                        const std::size_t  n)
  {
    const hsize_t size       = n;
    const hid_t   space      = H5Screate_simple(1, &size, nullptr);
    const hid_t   properties = H5Pcreate(H5P_DATASET_CREATE);
    if (n > 0)
      {
        H5Pset_chunk(properties, 1, &size);
        H5Pset_shuffle(properties);
        H5Pset_deflate(properties, 9);
      }
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t data = H5Dcreate2(
      id, name.c_str(), type_id<T>(), space, links, properties, H5P_DEFAULT);
    const bool ok =
      data >= 0 &&
      H5Dwrite(data, type_id<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    if (data >= 0)
      H5Dclose(data);
    H5Pclose(properties);
    H5Pclose(links);
    H5Sclose(space);
    if (!ok)
      fail("cannot take the array '" + name + "': is the disk full?");
  }

  template <typename T>
  std::vector<T>
  Hdf5File::read_array(const std::string &name) const
  {
    const hid_t data = H5Dopen2(id, name.c_str(), H5P_DEFAULT);
    if (data < 0)
      fail("lacks the array '" + name + "'");
    const hid_t    space = H5Dget_space(data);
    std::vector<T> values(H5Sget_simple_extent_npoints(space));
    const bool     ok =
      H5Dread(
        data, type_id<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
    H5Sclose(space);
    H5Dclose(data);
    if (!ok)
      fail("has an array '" + name + "' that cannot be read");
    return values;
  }

  void
  Hdf5File::write(const std::string &name, const std::vector<double> &values)
  {
    write_array(name, values.data(), values.size());
  }

  void
  Hdf5File::write(const std::string &name, const std::vector<int> &values)
  {
    write_array(name, values.data(), values.size());
  }

  void
  Hdf5File::write(const std::string &name, const std::string &text)
  {
    write_array(name, text.data(), text.size());
  }

  std::vector<double>
  Hdf5File::read_doubles(const std::string &name) const
  {
    return read_array<double>(name);
  }

  std::vector<int>
  Hdf5File::read_integers(const std::string &name) const
  {
    return read_array<int>(name);
  }

  std::string
  Hdf5File::read_text(const std::string &name) const
  {
    const std::vector<char> text = read_array<char>(name);
    return std::string(text.begin(), text.end());
  }
} // namespace geocone
