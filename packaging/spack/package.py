# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Spack's package of geocone: a folder geocone/package.py of an own repository of packages
(packaging/README.md). It builds the source that `spack develop` names."""

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *


class Geocone(CMakePackage):
    """Elastoplastic soil by finite elements and material points: one nonsmooth Newton
    method for non-associated plasticity, certified bounds of limit loads and factors of
    safety, and an explicit material point method."""

    license("LGPL-2.1-or-later")

    version("0.2.0")

    generator("ninja")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.16:", type="build")

    # Of deal.II's many variants only these are used.
    depends_on("dealii@9.4.1:9.6 +mpi+p4est+metis+muparser+hdf5+simplex+trilinos"
               "~adol-c~arborx~arpack~assimp~cgal~examples~ginkgo~gmsh~gsl~opencascade"
               "~petsc~scalapack~slepc~sundials~symengine build_type=Release")
    depends_on("trilinos+mpi+epetra+ml")  # multigrid of three dimensions
    depends_on("mpi")
    depends_on("hdf5")
    depends_on("suite-sparse")
    depends_on("mumps+mpi+double+shared")
    depends_on("gmsh~fltk")
    depends_on("eigen@3.3:3")
    depends_on("nlohmann-json@3:")
    depends_on("xsimd")
    depends_on("zlib-api")

    # Pictures, reports and the Python package.
    depends_on("python@3.11:", type=("build", "run"))
    for package in ("numpy", "matplotlib", "pillow", "jinja2", "h5py", "meshio"):
        depends_on(f"py-{package}", type="run")

    def cmake_args(self):
        """Where modules belong is asked of this interpreter."""
        return [self.define("PYTHON3_EXECUTABLE", self["python"].command.path)]

    def setup_run_environment(self, env):
        """So that "import geocone" finds the package."""
        env.prepend_path("PYTHONPATH", self.prefix.share.geocone.python)
