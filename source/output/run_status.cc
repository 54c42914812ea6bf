// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/files.h>
#include <geocone/output/run_status.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace geocone
{
  namespace
  {
    /** The program's end of the pipe to its watcher. */
    int to_watcher = -1;

    /** When a process of this machine began, in ticks since the machine did; numbers of
     *  processes come again. Empty where that is not known. */
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

    /** Writes over a file without asking the disk for space: blanks fill what the
     *  text leaves of it. */
    bool
    write_in_place(const std::string &file_name, const std::string &text)
    {
      std::error_code      error;
      const std::uintmax_t size = std::filesystem::file_size(file_name, error);
      const int            file = ::open(file_name.c_str(), O_WRONLY);
      if (file < 0)
        return false;
      std::string padded = text;
      if (!error && size > text.size())
        padded.append(size - text.size() - 1, ' ').push_back('\n');
      const bool ok = ::write(file, padded.data(), padded.size()) ==
                      static_cast<ssize_t>(padded.size());
      return ::close(file) == 0 && ok;
    }

    /** What the watching process does until the program has gone. */
    [[noreturn]] void
    stay_and_watch(const int from_program, const pid_t program)
    {
      // Signals to the program's group are not meant for it.
      setsid();
      for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        std::signal(signal, SIG_IGN);
      const int nothing = ::open("/dev/null", O_RDWR);
      for (const int standard : {0, 1, 2})
        dup2(nothing, standard);
      std::string folder, part;
      char        buffer[4096];
      for (;;)
        {
          const ssize_t n = ::read(from_program, buffer, sizeof(buffer));
          if (n < 0 && errno == EINTR)
            continue;
          if (n <= 0)
            break;
          part.append(buffer, n);
          for (std::size_t end; (end = part.find('\0')) != std::string::npos;)
            {
              folder = part.substr(0, end);
              part.erase(0, end + 1);
            }
        }
      if (!folder.empty())
        end_status(folder,
                   "killed: the process " + std::to_string(program) + " on " +
                     host_name() + " ended without a word, by " + time_now() +
                     " (killed by a signal, out of memory, or a crash)");
      _exit(0);
    }
  } // namespace

  Watcher::Watcher()
  {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      return;
    const pid_t program = getpid();
    watcher             = fork();
    if (watcher == 0)
      {
        ::close(ends[1]);
        stay_and_watch(ends[0], program);
      }
    ::close(ends[0]);
    if (watcher > 0)
      to_watcher = ends[1];
    else
      ::close(ends[1]);
  }

  Watcher::~Watcher()
  {
    if (watcher <= 0)
      return;
    ::close(to_watcher);
    to_watcher = -1;
    waitpid(watcher, nullptr, 0);
  }

  void
  Watcher::watch(const std::string &folder)
  {
    if (to_watcher < 0)
      return;
    std::error_code   error;
    const std::string path =
      std::filesystem::absolute(folder, error).string() + '\0';
    if (::write(to_watcher, path.data(), path.size()) < 0)
      to_watcher = -1; // it is gone: the sign of life is what is left
  }

  Json
  read_summary(const std::string &file_name)
  {
    // A folder may hold anything; no summary is that large.
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

  double
  cpu_time_of_rank()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }

  void
  end_status(const std::string &folder, const std::string &status) noexcept
  {
    try
      {
        const std::string file_name = folder + "/summary.json";
        std::string       text;
        {
          Json summary = read_summary(file_name);
          if (!is_running(summary))
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
        // No space for another one: a short one into the place of the old.
        const Json short_one = {{"status", status.substr(0, 400)},
                                {"run", run_topic()}};
        write_in_place(
          file_name,
          short_one.dump(2, ' ', false, Json::error_handler_t::replace));
      }
    catch (...)
      {}
  }

  std::string
  running_in(const std::string &folder)
  {
    const Json summary = read_summary(folder + "/summary.json");
    if (!is_running(summary) || !summary.contains("run") ||
        !summary["run"].is_object() ||
        summary["run"].value("host", Json()) != Json(host_name()))
      return "";
    const Json pid = summary["run"].value("pid", Json());
    if (!pid.is_number_integer() || pid.get<long>() <= 0 ||
        kill(pid.get<pid_t>(), 0) != 0 ||
        summary["run"].value("pid_start", Json()) !=
          Json(start_of(pid.get<long>())))
      return "";
    return "the run of process " + std::to_string(pid.get<long>()) +
           " goes on in it";
  }
} // namespace geocone
