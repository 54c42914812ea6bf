#!/usr/bin/env bash
# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# conda build calls this, with meta.yaml: deal.II with what geocone needs of it, then geocone.
set -euo pipefail
library=$PREFIX/lib/geocone

cmake -S dealii -B build-dealii -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_INSTALL_PREFIX="$library" -DCMAKE_PREFIX_PATH="$PREFIX" \
  -DDEAL_II_ALLOW_AUTODETECTION=OFF -DDEAL_II_ALLOW_BUNDLED=ON \
  -DDEAL_II_COMPONENT_EXAMPLES=OFF -DDEAL_II_COMPONENT_DOCUMENTATION=OFF \
  -DDEAL_II_WITH_MPI=ON -DDEAL_II_WITH_P4EST=ON -DDEAL_II_WITH_METIS=ON \
  -DDEAL_II_WITH_HDF5=ON -DDEAL_II_WITH_MUPARSER=ON -DDEAL_II_WITH_TRILINOS=ON -DDEAL_II_WITH_LAPACK=ON \
  -DDEAL_II_WITH_UMFPACK=ON -DDEAL_II_WITH_ZLIB=ON
cmake --build build-dealii --parallel "${CPU_COUNT:-2}"
cmake --install build-dealii

cmake -S geocone -B build-geocone -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_INSTALL_PREFIX="$PREFIX" -DCMAKE_PREFIX_PATH="$library;$PREFIX" \
  -DCMAKE_INSTALL_RPATH="$library/lib;$PREFIX/lib" -DPYTHON3_EXECUTABLE="$PYTHON"
cmake --build build-geocone --target geocone geocone-lab element_test --parallel "${CPU_COUNT:-2}"
cmake --install build-geocone

# Only the library itself is needed from here on.
rm -rf "$library/include" "$library/lib/cmake" "$library/share"
