// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/files.h>
#include <geocone/base/log.h>
#include <geocone/folder/run_status.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace geocone
{
  namespace
  {
    /** Start time of a process of this machine in ticks since boot, as process ids are
     *  reused. Empty if unknown. */
    std::string
    start_of(const long pid)
    {
      std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
      std::string   text;
      std::getline(file, text);
      // The second field is a name in parentheses, this is the twenty-second.
      const std::size_t after_name = text.rfind(')');
      if (after_name == std::string::npos)
        return "";
      std::istringstream fields(text.substr(after_name + 1));
      std::string        field;
      for (unsigned int i = 3; i <= 22; ++i)
        if (!(fields >> field))
          return "";
      return field;
    }

    std::string
    time_now()
    {
      const std::time_t now = std::time(nullptr);
      std::tm           utc;
      gmtime_r(&now, &utc);
      char text[32];
      std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &utc);
      return text;
    }

    std::string
    host_name()
    {
      char name[256] = "";
      gethostname(name, sizeof(name) - 1);
      return name;
    }

    bool
    is_running(const Json &summary)
    {
      return summary.contains("status") && summary["status"] == "running";
    }

    /** Overwrites a file without requesting disk space: the remainder is filled with
     *  blanks. */
    bool
    write_in_place(const std::string &file_name, const std::string &text)
    {
      std::error_code      error;
      const std::uintmax_t size = std::filesystem::file_size(file_name, error);
      const int file = ::open(file_name.c_str(), O_WRONLY | O_NOFOLLOW);
      if (file < 0)
        return false;
      std::string padded = text;
      if (!error && size > text.size())
        padded.append(size - text.size() - 1, ' ').push_back('\n');
      const bool ok = ::write(file, padded.data(), padded.size()) ==
                      static_cast<ssize_t>(padded.size());
      return ::close(file) == 0 && ok;
    }
  } // namespace

  Json
  read_summary(const std::string &file_name)
  {
    // The folder may contain anything; no summary is that large.
    constexpr std::uintmax_t largest = 64 << 20;
    std::error_code          error;
    if (!std::filesystem::is_regular_file(file_name, error) ||
        std::filesystem::file_size(file_name, error) > largest)
      return Json();
    std::ifstream in(file_name);
    const Json    summary = Json::parse(in, nullptr, false);
    return summary.is_object() ? summary : Json();
  }

  Json
  run_topic()
  {
    static const std::string started = time_now();
    return {{"pid", getpid()},
            {"pid_start", start_of(getpid())},
            {"host", host_name()},
            {"started", started},
            {"last_sign_of_life", time_now()}};
  }

  void
  end_status(const std::string &folder,
             const std::string &status,
             const pid_t        pid) noexcept
  {
    try
      {
        const std::string file_name = folder + "/summary.json";
        std::string       text;
        {
          Json summary = read_summary(file_name);
          if (!is_running(summary) || !summary.contains("run") ||
              !summary["run"].is_object() ||
              summary["run"].value("pid", Json()) != Json(pid) ||
              summary["run"].value("host", Json()) != Json(host_name()))
            return;
          summary["status"]                   = status;
          summary["run"]["last_sign_of_life"] = time_now();
          text =
            summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
        }
        try
          {
            write_file(file_name, [&](std::ostream &out) { out << text; });
            return;
          }
        catch (const std::exception &)
          {}
        // No space for another file: a short text overwrites the old one.
        const Json short_one = {{"status", status.substr(0, 400)},
                                {"run", run_topic()}};
        write_in_place(
          file_name,
          short_one.dump(2, ' ', false, Json::error_handler_t::replace));
      }
    catch (...)
      {}
  }

  namespace
  {
    /** Boot id of this machine's kernel, also the same in containers. */
    std::string
    start_of_machine()
    {
      std::ifstream file("/proc/sys/kernel/random/boot_id");
      std::string   id;
      std::getline(file, id);
      return id;
    }

    /** Lock of this process. */
    struct FolderLock
    {
      ~FolderLock()
      {
        release_folder();
      }

      std::string name;
      int         file = -1;
    };

    FolderLock &
    own_lock()
    {
      static FolderLock lock;
      return lock;
    }

    /** Whether a name refers to an open file; nothing if no such file exists. */
    std::optional<bool>
    is_name_of(const std::string &name, const int file)
    {
      struct stat named, opened;
      if (::lstat(name.c_str(), &named) != 0 || ::fstat(file, &opened) != 0)
        return {};
      return named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
    }

    /** Content of a lock of any owner; empty if it is invalid. */
    Json
    content_of(const int file)
    {
      char          text[4096];
      const ssize_t n = ::pread(file, text, sizeof(text), 0);
      const Json    content =
        Json::parse(text, text + std::max<ssize_t>(n, 0), nullptr, false);
      return content.is_object() ? content : Json::object();
    }

    std::string
    who_holds(const Json &lock)
    {
      const auto word = [&](const char *name) {
        const Json value = lock.value(name, Json());
        return value.is_string()           ? printable(value.get<std::string>())
               : value.is_number_integer() ? std::to_string(value.get<long>())
                                           : std::string("?");
      };
      return "the run of process " + word("pid") + " on " + word("host") +
             " goes on in it";
    }

    /** Time without a sign of life after which a lock is abandoned (s). */
    constexpr double longest_silence = 120.;

    enum class TakenOver
    {
      yes,
      no,
      look_again
    };

    /**
     * Replaces an abandoned lock by this process's own, which is complete and locked.
     * @param own_name its temporary name
     * @param has_locks whether files can be locked there
     */
    TakenOver
    take_over(const std::string &name,
              const std::string &own_name,
              const int          own_file,
              const bool         has_locks,
              std::string       &why_not)
    {
      const int other =
        ::open(name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
      if (other < 0)
        {
          const int cause = errno;
          why_not = std::string("its ") + lock_file + " cannot be opened (" +
                    std::strerror(cause) + ")";
          return cause == ENOENT ? TakenOver::look_again : TakenOver::no;
        }
      struct Closed
      {
        ~Closed()
        {
          ::close(file);
        }
        const int file;
      } closed{other};
      const bool is_held =
        ::flock(other, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
      const Json lock = content_of(other);
      if (is_name_of(name, other) != true)
        return TakenOver::look_again;
      why_not = who_holds(lock);
      if (is_held)
        return TakenOver::no;
      // The kernel reports locks of its own processes; others are judged by time.
      const bool is_known =
        has_locks && lock.value("machine", Json()) == Json(start_of_machine());
      struct stat now, last;
      if (::fstat(own_file, &now) != 0 || ::fstat(other, &last) != 0)
        return TakenOver::no;
      const double silence = std::difftime(now.st_mtime, last.st_mtime);
      if (!is_known && silence < longest_silence)
        {
          why_not += format(", seen %.0f s ago; its folder can be taken if it "
                            "is silent for %.0f s, or, if you know that it has "
                            "ended, delete %s",
                            silence,
                            longest_silence,
                            lock_file);
          return TakenOver::no;
        }
      if (::rename(own_name.c_str(), name.c_str()) != 0)
        {
          why_not =
            std::string("it cannot be written (") + std::strerror(errno) + ")";
          return TakenOver::no;
        }
      if (!is_known)
        ::sleep(2);
      why_not = "another run has just taken it";
      return is_known || is_name_of(name, own_file) == true ? TakenOver::yes
                                                            : TakenOver::no;
    }
  } // namespace

  std::string
  take_folder(const std::string &folder)
  {
    release_folder();
    std::error_code   error;
    const std::string name =
      (std::filesystem::absolute(folder, error) / lock_file).string();
    // It gets its final name when it is complete and locked.
    std::string own_name = name + ".XXXXXX";
    const int   file     = ::mkostemp(own_name.data(), O_CLOEXEC);
    if (file < 0)
      return std::string("it cannot be written (") + std::strerror(errno) + ")";
    ::fchmod(file, 0644);
    const Json        content = {{"host", host_name()},
                                 {"machine", start_of_machine()},
                                 {"pid", getpid()},
                                 {"pid_start", start_of(getpid())},
                                 {"taken", time_now()}};
    const std::string text =
      content.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    const bool  has_locks = ::flock(file, LOCK_EX | LOCK_NB) == 0;
    std::string why_not;
    TakenOver   taken = TakenOver::look_again;
    if (::write(file, text.data(), text.size()) != ssize_t(text.size()))
      {
        why_not =
          std::string("it cannot be written (") + std::strerror(errno) + ")";
        taken = TakenOver::no;
      }
    for (int i = 0; i < 1000 && taken == TakenOver::look_again; ++i)
      {
        // Some file systems have no links.
        if (::link(own_name.c_str(), name.c_str()) == 0 ||
            ((errno == EPERM || errno == EOPNOTSUPP || errno == ENOSYS) &&
             ::renameat2(AT_FDCWD,
                         own_name.c_str(),
                         AT_FDCWD,
                         name.c_str(),
                         RENAME_NOREPLACE) == 0))
          taken = TakenOver::yes;
        else if (errno == EEXIST)
          taken = take_over(name, own_name, file, has_locks, why_not);
        else
          {
            why_not =
              std::string("it cannot be locked (") + std::strerror(errno) + ")";
            taken = TakenOver::no;
          }
      }
    ::unlink(own_name.c_str());
    if (taken == TakenOver::yes)
      {
        own_lock().name = name;
        own_lock().file = file;
        return "";
      }
    ::close(file);
    return why_not;
  }

  void
  release_folder()
  {
    FolderLock &lock = own_lock();
    if (lock.file < 0)
      return;
    if (is_name_of(lock.name, lock.file) == true)
      ::unlink(lock.name.c_str());
    ::close(lock.file);
    lock.file = -1;
  }

  void
  check_folder()
  {
    const FolderLock &lock = own_lock();
    if (lock.file >= 0 && is_name_of(lock.name, lock.file) == false)
      throw RunError("another run has taken the folder over (" + lock.name +
                     ")\n  remedy:  name another folder for one of them");
  }
} // namespace geocone
