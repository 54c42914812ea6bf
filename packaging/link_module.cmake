# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# While it is installed: a link to the Python package, in the folder below the prefix in
# which the interpreter ${python} looks for modules, so that "import geocone" finds it.
# Where it looks in none, as of a prefix like /opt/geocone, the link is where a virtual
# environment would have it.
execute_process(COMMAND ${python} -c "
import os, site, sys
prefix = os.path.join(os.path.normpath(sys.argv[1]), '')
places = [*site.getsitepackages(), site.getusersitepackages()]
known = [place for place in places if place.startswith(os.path.join(prefix, 'lib'))]
print(known[0] if known else
      f'{prefix}lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages')
" ${CMAKE_INSTALL_PREFIX}
  OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "python3 does not tell where its modules are")
endif()

set(link ${folder}/geocone)
if(IS_DIRECTORY $ENV{DESTDIR}${link} AND NOT IS_SYMLINK $ENV{DESTDIR}${link})
  message(FATAL_ERROR "${link} is a folder, and not a link of a former installation: "
    "remove it, or choose another prefix")
endif()
file(RELATIVE_PATH package ${folder} ${CMAKE_INSTALL_PREFIX}/share/geocone/python/geocone)
file(MAKE_DIRECTORY $ENV{DESTDIR}${folder})
file(CREATE_LINK ${package} $ENV{DESTDIR}${link} SYMBOLIC)
list(APPEND CMAKE_INSTALL_MANIFEST_FILES ${link})
message(STATUS "Installing: $ENV{DESTDIR}${link}")
