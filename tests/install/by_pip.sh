#!/bin/sh
# by_pip.sh PYTHON SOURCE PACKAGE: the wheel, built against the moved package without network, installed into an environment of its own,
# used from there. The extension must be one for all later Pythons and give away nothing but its init function.
set -eu
python=$1 source=$2 package=$3
tree=$package/by_pip
rm -rf "$tree"
mkdir -p "$tree"
cp -r "$source/python" "$source/CMakeLists.txt" "$tree"
rm -rf "$tree/python/build"
"$python" -m venv --system-site-packages "$tree/V"
CMAKE_ARGS="-G Ninja -DPIA_PYTHON_INSTALLED=ON -DCMAKE_PREFIX_PATH=$package/moved" \
    "$tree/V/bin/pip" wheel --no-build-isolation --no-index --no-deps -w "$tree" "$tree/python"
ls "$tree"/libpia-*-cp311-abi3-linux_*.whl
"$tree/V/bin/pip" install --no-index "$tree"/libpia-*.whl
cd "$tree/V"
# What memory does over many fits and at its end is tested here, where no sanitizer counts.
PIA_DATA=$source/data PIA_SOURCE=$source bin/python "$source/tests/python/test_memory.py"
bin/python - <<'END'
import glob, pathlib, pia, subprocess
folder = pathlib.Path(pia.__file__).parent
assert "site-packages" in str(folder), folder
assert (folder / "py.typed").exists() and (folder / "__init__.pyi").exists()
assert pia.fit_curve([[0, 0], [1, 1], [2, 0], [3, 1], [4, 0]]).report.max_error < 1e-12
symbols = subprocess.run(["nm", "-D", "--defined-only", folder / "_pia.abi3.so"], capture_output=True, text=True, check=True).stdout
assert [line.split()[-1] for line in symbols.splitlines()] == ["PyInit__pia"], symbols
END
