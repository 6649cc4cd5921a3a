#!/usr/bin/env bash
# ./run programs: the plug-ins in the programs that they are for, without a screen. Called in the project's folder with the
# Python that has brushfire. What cannot be installed or is not there is left out, and said so.
set -euo pipefail
python=$1 tests=programs/tests failed=0 tried=0
# Brushfire alone: what lies beside it (another VTK) would disturb the programs.
packages=$PWD/build/programs/packages
mkdir -p "$packages"
ln -sfn "$($python -c 'import brushfire, pathlib; print(pathlib.Path(brushfire.__file__).parent)')" "$packages/brushfire"
left_out() { echo "left out: $*"; }
try() {
  tried=$((tried + 1))
  "$@" || failed=$((failed + 1))
}

# Each in an environment of its own: they want different numpys. Brushfire itself comes from where it is installed.
environment() {
  local folder=build/programs/$1
  shift
  [ -x "$folder/bin/pip" ] || $python -m venv "$folder" >&2
  "$folder/bin/pip" install -q --disable-pip-version-check --only-binary :all: pytest "$@" >&2 || return 1
  echo "$packages" >"$("$folder/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/zz-brushfire.pth"
  echo "$folder/bin/python"
}

for program in pyvista:pyvista blender:bpy napari:napari; do
  name=${program%:*} package=${program#*:}
  if there=$(environment "$name" "$package"); then
    echo "$name: $("$there" -m pip list --disable-pip-version-check 2>/dev/null | awk -v p="$package" '$1 == p')"
    try env QT_QPA_PLATFORM=offscreen "$there" -m pytest -q -W ignore -p no:cacheprovider "$tests/test_$name.py"
  else
    left_out "$name: no wheel of $package for this Python"
  fi
done

# ParaView and QGIS bring a Python of their own; it has to be of the version that brushfire was built for.
if command -v pvpython >/dev/null; then
  try env PYTHONPATH="$packages" QT_QPA_PLATFORM=offscreen pvpython "$tests/paraview_test.py"
else
  left_out "paraview: no pvpython (Debian: python3-paraview)"
fi
if command -v qgis_process >/dev/null; then
  try env PYTHONPATH="$packages" QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR="$packages" /usr/bin/python3 "$tests/qgis_test.py"
else
  left_out "qgis: no qgis_process (Debian: qgis)"
fi
echo "$tried programs tried, $failed failed"
[ "$tried" -gt 0 ] && [ "$failed" = 0 ]
