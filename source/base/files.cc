// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/base/units.h>

#include <deal.II/base/exceptions.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

#include <fcntl.h>
#include <unistd.h>

namespace geocone
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Folder of the run, and its files in the list. */
    struct ListOfFiles
    {
      fs::path              folder;
      std::set<std::string> names;
    };

    ListOfFiles &
    list()
    {
      static ListOfFiles list;
      return list;
    }

    void
    refuse_link(const fs::path &path)
    {
      std::error_code ignored;
      if (fs::is_symlink(fs::symlink_status(path, ignored)))
        throw RunError("the file '" + path.string() +
                       "' is a symbolic link: nothing is written through it" +
                       "\n  remedy:  take it away");
    }

    /** Creates a new file. @param is_ours an existing file is left over from
     *  this run. @return its descriptor, or -1 */
    int
    make_file(const std::string &name, const bool is_ours)
    {
      constexpr int flags =
        O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
      const int file = ::open(name.c_str(), flags, 0666);
      if (file >= 0 || errno != EEXIST || !is_ours ||
          ::unlink(name.c_str()) != 0)
        return file;
      return ::open(name.c_str(), flags, 0666);
    }

    /** @return errno, or 0 */
    int
    sync_descriptor(const int file)
    {
      // Files that cannot be synchronised, e.g. pipes, are not persistent.
      return ::fsync(file) == 0 || errno == EINVAL ? 0 : errno;
    }
  } // namespace

  void
  keep_list_of_files(const std::string &folder)
  {
    list().folder = fs::path(folder).lexically_normal();
    list().names  = {list_of_files};
    // Resumed runs have a list already.
    std::ifstream in(list().folder / list_of_files);
    for (std::string name; std::getline(in, name);)
      list().names.insert(name);
  }

  bool
  is_in_list(const std::string &name)
  {
    return list().names.count(name) > 0;
  }

  bool
  enter_in_list(const std::string &file_name)
  {
    const fs::path path = fs::path(file_name).lexically_normal();
    if (list().folder.empty() ||
        path.parent_path() != (list().folder / "x").parent_path())
      return false;
    refuse_link(path);
    if (is_in_list(path.filename().string()))
      return true;
    if (std::error_code ignored; fs::exists(path, ignored))
      throw RunError("the file '" + file_name +
                     "' is there and none of this "
                     "run (" +
                     list_of_files +
                     "): it is kept\n"
                     "  remedy:  move it away, and go on with --resume or "
                     "run it anew");
    list().names.insert(path.filename().string());
    // Appended by a single write, because all ranks write into it.
    const std::string line = path.filename().string() + "\n";
    const std::string name = (list().folder / list_of_files).string();
    const int         file =
      ::open(name.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW, 0666);
    const bool ok = file >= 0 && ::write(file, line.data(), line.size()) ==
                                   ssize_t(line.size());
    const int cause = errno;
    if (file >= 0)
      ::close(file);
    if (!ok)
      throw RunError("the file '" + name + "' cannot be written" +
                     cause_and_remedy(cause));
    return false;
  }

  void
  sync_to_disk(const std::string &path)
  {
    const int file  = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const int cause = file < 0 ? errno : sync_descriptor(file);
    if (file >= 0)
      ::close(file);
    if (cause != 0)
      throw RunError("'" + path + "' cannot be brought to the disk" +
                     cause_and_remedy(cause));
  }

  std::string
  cause_and_remedy(const int error)
  {
    const std::string remedy =
      error == EFBIG    ? "raise the limit of the size of files (ulimit -f)"
      : error == ENOENT ? "the folder is not there (any more): keep it until "
                          "the run has ended"
      : error == EACCES || error == EROFS || error == EPERM
        ? "name a folder that you may write into"
      : error == EEXIST
        ? "take the file of that name with the ending .part away"
      : error == ENOSPC || error == EDQUOT || error == 0
        ? "free some space, write fields less often "
          "('Loading/.../Output every'), or name a folder on "
          "another disk with --output"
        : "check the folder and its disk";
    return (error == 0 ? ": is the disk full?"
                       : std::string(": ") +
                           (error == ENOSPC ? "is the disk full? (" : "(") +
                           std::strerror(error) + ")") +
           "\n  remedy:  " + remedy;
  }

  void
  write_file(const std::string                         &file_name,
             const std::function<void(std::ostream &)> &write,
             const bool                                 is_durable)
  {
    const bool        is_ours   = enter_in_list(file_name);
    const std::string temporary = file_name + ".part";
    const int         file      = make_file(temporary, is_ours);
    if (file < 0)
      throw RunError("the file '" + file_name + "' cannot be written" +
                     cause_and_remedy(errno));
    errno = 0;
    std::ofstream out(temporary);
    try
      {
        if (out)
          write(out);
      }
    catch (const dealii::ExceptionBase &)
      {
        // The library's writers throw if a stream fails.
        out.setstate(std::ios::failbit);
      }
    catch (...)
      {
        // Possibly out of memory: nothing here may allocate.
        ::close(file);
        ::unlink(temporary.c_str());
        throw;
      }
    const int cause_of_writing = out ? 0 : errno;
    errno                      = 0;
    out.close();
    int  cause = cause_of_writing != 0 ? cause_of_writing : errno;
    bool ok    = static_cast<bool>(out);
    if (ok && is_durable)
      {
        cause = sync_descriptor(file);
        ok    = cause == 0;
      }
    ::close(file);
    if (std::error_code error; ok)
      {
        fs::rename(temporary, file_name, error);
        if (error)
          cause = error.value();
        ok = !error;
      }
    if (!ok)
      {
        ::unlink(temporary.c_str());
        throw RunError("the file '" + file_name + "' cannot be written" +
                       cause_and_remedy(cause));
      }
    if (const fs::path folder = fs::path(file_name).parent_path(); is_durable)
      sync_to_disk(folder.empty() ? "." : folder.string());
  }

  void
  CsvFile::open(const std::string              &file_name,
                const std::vector<std::string> &columns,
                const bool                      goes_on)
  {
    name      = file_name;
    n_columns = columns.size();
    size      = 0;
    if (goes_on)
      return;
    enter_in_list(name);
    errno = 0;
    file.open(name);
    std::string line;
    for (const std::string &column : columns)
      {
        std::string text = in_units(column);
        if (text.find_first_of(",\"\r\n") != std::string::npos)
          {
            for (std::size_t i = text.find('"'); i != std::string::npos;
                 i             = text.find('"', i + 2))
              text.insert(i, 1, '"');
            text = '"' + text + '"';
          }
        line += (line.empty() ? "" : ",") + text;
      }
    add_text(line + "\n");
  }

  void
  CsvFile::state(StateRow &row)
  {
    row(size);
    if (name.empty())
      return;
    if (!row.is_read())
      return sync_to_disk(name);
    refuse_link(name);
    file.close(); // where an earlier checkpoint is tried
    std::error_code      error;
    const std::uintmax_t present = fs::file_size(name, error);
    if (error || present < size)
      throw RunError("the table '" + name +
                     "' is shorter than when the checkpoint was written: "
                     "lines of it are missing");
    fs::resize_file(name, size, error);
    errno = error.value();
    if (!error)
      file.open(name, std::ios::app);
    if (error || !file)
      throw RunError("the table '" + name + "' cannot be written" +
                     cause_and_remedy(errno));
  }

  void
  CsvFile::add_line(const std::vector<double> &values)
  {
    AssertDimension(values.size(), n_columns);
    std::string line;
    for (const double value : values)
      line += (line.empty() ? "" : ",") + format("%.12g", value);
    add_text(line + "\n");
  }

  void
  CsvFile::add_text(const std::string &line)
  {
    errno = 0;
    file << line << std::flush;
    if (file)
      {
        size += line.size();
        return;
      }
    const int cause = errno;
    file.close();
    std::error_code ignored;
    fs::resize_file(name, size, ignored);
    throw RunError("the table '" + name + "' cannot be written" +
                   cause_and_remedy(cause));
  }

  std::string
  existing_file(const std::string &name,
                const std::string &folder_of_parameters,
                const std::string &parameter,
                const std::string &allowed)
  {
    const std::filesystem::path beside =
      std::filesystem::path(folder_of_parameters) / name;
    std::error_code error; // inaccessible names count as absent
    for (const std::filesystem::path &path :
         {beside, std::filesystem::path(name)})
      if (std::filesystem::is_regular_file(path, error))
        return path.string();
    throw InputError(parameter,
                     name,
                     allowed,
                     "check the name; it is relative to the folder of the "
                     "parameter file, or else to that of the call");
  }
} // namespace geocone
