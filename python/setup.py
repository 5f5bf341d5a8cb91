"""Builds the wheel: CMake compiles the library and the extension module (CMakeLists.txt beside this file), setuptools packs them.

Needs a C compiler, CMake, Ninja or make, and libjansson; no network:
    python3 -m venv --system-site-packages V && V/bin/pip install --no-build-isolation --no-index ./python
CMAKE_ARGS in the environment goes to CMake, for instance -DPIA_WITH_CAIRO=OFF.
"""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = Path(__file__).resolve().parent
VERSION = re.search(r"project\(pia VERSION ([0-9.]+)", (HERE.parent / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        folder = Path(self.build_temp).resolve() / "cmake"
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        configure = ["cmake", "-S", str(HERE), "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release", f"-DPython3_EXECUTABLE={sys.executable}"]
        subprocess.run(configure + shlex.split(os.environ.get("CMAKE_ARGS", "")), check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "pia_python", "--parallel"], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(folder / "pia" / "_pia.abi3.so"), str(target))


setup(version=VERSION, ext_modules=[Extension("pia._pia", [], py_limited_api=True)], cmdclass={"build_ext": CMakeBuild})
