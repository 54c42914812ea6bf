# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The version of the Python package, which is that of the programs; all else is in
pyproject.toml."""

import re
from pathlib import Path

from setuptools import setup

CMAKE = Path(__file__).resolve().parents[1] / "CMakeLists.txt"
setup(version=re.search(r"project\(geocone VERSION ([\d.]+)", CMAKE.read_text()).group(1))
