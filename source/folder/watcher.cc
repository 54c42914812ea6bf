// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/folder/run_status.h>
#include <geocone/folder/watcher.h>

#include <cerrno>
#include <csignal>
#include <filesystem>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace geocone
{
  namespace
  {
    /** The program's end of the pipe to its watcher. */
    int to_watcher = -1;

    /** Time between the signs of life of a run (s); take_folder() waits longer. */
    constexpr int between_signs = 10;

    /** Main loop of the watcher, which ends after the program. */
    [[noreturn]] void
    stay_and_watch(const int from_program, const pid_t program)
    {
      // Signals to the program's process group do not concern it.
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
          pollfd said = {from_program, POLLIN, 0};
          if (::poll(&said, 1, 1000 * between_signs) == 0)
            {
              if (!folder.empty()) // sets the file server's time
                utimensat(AT_FDCWD,
                          (folder + "/" + lock_file).c_str(),
                          nullptr,
                          AT_SYMLINK_NOFOLLOW);
              continue;
            }
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
        {
          const Json here = run_topic();
          end_status(folder,
                     "killed: the process " + std::to_string(program) + " on " +
                       here["host"].get<std::string>() +
                       " ended without a word, by " +
                       here["last_sign_of_life"].get<std::string>() +
                       " (killed by a signal, out of memory, or a crash)",
                     program);
        }
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
      to_watcher = -1; // it has ended: only the sign of life remains
  }
} // namespace geocone
