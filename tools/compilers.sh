#!/usr/bin/env bash
# ./run compilers [COMPILER...]: every source under every compiler that is here, for warnings. One table.
#
# Each compiler is asked with the options of its own build, for the language only (-fsyntax-only): what GCC sees while it
# optimises is told by builds, those of .ci/run and of ./run fresh. What a compiler did not get to see is named: js/src
# is emscripten's (./run web). WHERE=src limits it to files of such names.
set -euo pipefail

compilers=("$@")
if [ $# = 0 ]; then
  for name in g++-{12,13,14} clang++-{16,17,18,19}; do
    if command -v "$name" >/dev/null; then compilers+=("$name"); fi
  done
fi
if [ ${#compilers[@]} = 0 ]; then compilers=("${CXX:-c++}"); fi
logs=build/compilers
mkdir -p "$logs"

# What a build needs of Python is nanobind's headers.
python=$logs/venv/bin/python
if [ ! -x $python ]; then python3 -m venv $logs/venv || python=; fi
if [ -n "$python" ] && ! $python -m nanobind --cmake_dir >/dev/null 2>&1; then
  $python -m pip install --quiet --disable-pip-version-check nanobind || python=
fi
[ -n "$python" ] || echo "(no nanobind: python/src is left out)" >&2

# The commands of a build, one to a line, that only read: without what they would write. The readers are compiled once
# more for the fuzzers, and nanobind is not ours.
commands() {
  sed -n 's/^ *"command": "\(.*\)",*$/\1/p' "$1/compile_commands.json" | sed 's/\\"/"/g; s/\\\\/\\/g' |
    grep -vE ' -o [^ ]*/brushfire_io\.dir/|/nanobind/src/[^ ]*$|/ext/robin_map/[^ ]*$' |
    sed 's/ -o [^ ]* / /; s/ -c / -fsyntax-only /' | grep -- "${WHERE:-.}" | sort -u
}

# unseen COMMANDS: our sources that are in none of them.
unseen() {
  find src tests tools fuzz benchmarks examples python/src js/src -name '*.cpp' | grep -- "${WHERE:-.}" | sort |
    comm -23 - <(sed "s|.* $PWD/||" "$1" | sort -u)
}

status=0 table=()
for compiler in "${compilers[@]}"; do
  build=$logs/$compiler log=$logs/$compiler.log start=$SECONDS
  options=(-DBRUSHFIRE_BUILD_TESTS=ON -DBRUSHFIRE_BUILD_BENCHMARKS=ON -DBRUSHFIRE_WERROR=OFF)
  if [[ $compiler == *clang* ]]; then options+=(-DBRUSHFIRE_BUILD_FUZZERS=ON); fi
  if [ -n "$python" ]; then options+=(-DBRUSHFIRE_BUILD_PYTHON=ON "-DPython_EXECUTABLE=$PWD/$python"); fi
  cmake -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER_LAUNCHER= "${options[@]}" >"$log"
  (cd "$build" && ninja -t commands -s examples/header_examples.cpp | sh) >>"$log"  # the one source that a build makes
  commands "$build" >"$build/commands"
  (cd "$build" && xargs -P "$(nproc)" -d '\n' -n 1 sh -c 'said=$(sh -c "$0" 2>&1) || status=1; echo "$said"; exit ${status:-0}' <commands) >"$log" 2>&1 || status=1
  warnings=$(grep -cE '(warning|error):' "$log" || true)
  if [ "$warnings" != 0 ]; then status=1; fi
  mapfile -t left < <(unseen "$build/commands")
  table+=("$(printf '%-12s %6d files %6d warnings %6d s   %s' "$compiler" "$(wc -l <"$build/commands")" "$warnings" \
    $((SECONDS - start)) "${left[*]:+not seen: $(printf '%s\n' "${left[@]%/*}" | sort | uniq -c | sed 's/^ *//' | paste -sd,)}")")
  grep -E '(warning|error):' "$log" | sort -u | head -20 >&2 || true
done
printf '%s\n' "${table[@]}"
exit $status
