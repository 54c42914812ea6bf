// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/laws/umat_library.h>

#include <filesystem>

#include <dlfcn.h>

namespace geocone
{
  bool &
  may_load_libraries()
  {
    static bool allowed = false;
    return allowed;
  }

  UmatFunction
  load_umat(const std::string &path,
            const std::string &function,
            const std::string &parameters)
  {
    // A name without a slash would be looked up in the folders of the system.
    void *const library =
      dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
      throw InputError(parameters + "/Library",
                       path,
                       "a shared object that the system can load",
                       std::string("make it with 'gfortran -shared -fPIC' or "
                                   "'cc -shared -fPIC', with all that it "
                                   "calls; the system says: ") +
                         printable(dlerror()));
    for (const std::string &name : {function, function + "_"})
      if (void *const symbol = dlsym(library, name.c_str()))
        // dlsym() also finds functions of what the library depends on.
        if (Dl_info of_symbol;
            dladdr(symbol, &of_symbol) != 0 &&
            std::filesystem::equivalent(of_symbol.dli_fname, path))
          return reinterpret_cast<UmatFunction>(symbol);
    throw InputError(parameters + "/Function",
                     function,
                     "a function of the library '" + printable(path) +
                       "', with or without a trailing underscore",
                     "'nm -D FILE' lists its functions");
  }
} // namespace geocone
