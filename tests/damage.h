// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Damaged files, the same on every machine: a reader must either read them or refuse
// them by InputError or RunError.

#ifndef tests_damage_h
#define tests_damage_h

#include <geocone/base/exceptions.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

namespace damage
{
  inline std::string
  content(const std::string &file_name)
  {
    std::ifstream in(file_name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }

  /** Changes one to four places of a file, or cuts off or duplicates a part of it. */
  inline std::string
  damaged(std::string bytes, std::mt19937 &engine)
  {
    const auto place = [&]() { return engine() % bytes.size(); };
    const auto write = [&](const void *value, const std::size_t size) {
      if (bytes.size() >= size)
        std::memcpy(&bytes[engine() % (bytes.size() - size + 1)], value, size);
    };
    for (unsigned int n = 1 + engine() % 4; n > 0 && !bytes.empty(); --n)
      switch (engine() % 9)
        {
          case 0:
            bytes[place()] ^= 1 << engine() % 8;
            break;
          case 1:
            bytes[place()] = engine();
            break;
          case 2:
            bytes.resize(place());
            break;
          case 3:
            {
              const std::size_t first = place(), size = 1 + engine() % 64;
              bytes.insert(place(), bytes.substr(first, size));
              break;
            }
          case 4:
            bytes.erase(place(), 1 + engine() % 64);
            break;
          case 5:
            {
              const std::size_t first = place(), size = 1 + engine() % 64;
              bytes.replace(
                first, size, std::min(size, bytes.size() - first), 0);
              break;
            }
          case 6:
            {
              const double values[] = {std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::infinity(),
                                       1e300,
                                       -1.};
              write(&values[engine() % 4], sizeof(double));
              break;
            }
          case 7:
            {
              const std::uint64_t values[] = {~0ULL, 1ULL << 62, 0x7fffffffULL};
              write(&values[engine() % 3], sizeof(values[0]));
              break;
            }
          default:
            {
              const char *words[] = {
                "nan", "-1", "1e999", ",,,,", "\n", "\"", "2147483647"};
              const std::string word = words[engine() % 7];
              write(word.data(), word.size());
            }
        }
    return bytes;
  }

  /** Reads this many damaged copies of a file and prints the outcome. */
  inline void
  check(const std::string           &what,
        const std::string           &original,
        const std::string           &copy,
        const unsigned int           n,
        const std::function<void()> &read)
  {
    std::mt19937      engine(20261122);
    unsigned int      n_refused = 0;
    bool              good      = true;
    const std::string bytes     = content(original);
    for (unsigned int i = 0; i < n; ++i)
      {
        std::ofstream(copy, std::ios::binary) << damaged(bytes, engine);
        try
          {
            read();
          }
        catch (const geocone::InputError &)
          {
            ++n_refused;
          }
        catch (const geocone::RunError &)
          {
            ++n_refused;
          }
        catch (const std::exception &error)
          {
            std::cout << "  " << i << ": " << error.what() << std::endl;
            good = false;
          }
      }
    std::cout << what << ": " << n << " damaged files, read or refused: "
              << (good && !bytes.empty() ? "yes" : "no")
              << ", some of them refused: "
              << (n_refused > n / 10 ? "yes" : "no") << std::endl;
  }
} // namespace damage

#endif
