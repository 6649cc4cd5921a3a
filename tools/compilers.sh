#!/usr/bin/env bash
# ./run compilers [COMPILER...]: every source under every compiler that is here, for warnings. One table.
#
# Each compiler is asked with the options of its own build, for the language only (-fsyntax-only): what GCC sees while it
# optimises is told by builds, those of .ci/run and of ./run fresh. WHERE=src limits it to files of such names.
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

# The commands of a build, one to a line, that only read: without what they would write.
commands() {
  sed -n 's/^ *"command": "\(.*\)",*$/\1/p' "$1/compile_commands.json" | sed 's/\\"/"/g; s/\\\\/\\/g; s/ -o [^ ]* / /; s/ -c / -fsyntax-only /' |
    grep -- "${WHERE:-.}" | sort -u
}

status=0 table=()
for compiler in "${compilers[@]}"; do
  build=$logs/$compiler log=$logs/$compiler.log start=$SECONDS
  cmake -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_BUILD_TYPE=Release \
    -DBRUSHFIRE_BUILD_TESTS=ON -DBRUSHFIRE_WERROR=OFF -DCMAKE_CXX_COMPILER_LAUNCHER= >"$log"
  cmake --build "$build" --target examples/header_examples.cpp >>"$log"  # the one source that a build makes
  commands "$build" >"$build/commands"
  (cd "$build" && xargs -P "$(nproc)" -d '\n' -n 1 sh -c <commands) >"$log" 2>&1 || status=1
  warnings=$(grep -cE '(warning|error):' "$log" || true)
  if [ "$warnings" != 0 ]; then status=1; fi
  table+=("$(printf '%-12s %6d files %6d warnings %6d s' "$compiler" "$(wc -l <"$build/commands")" "$warnings" $((SECONDS - start)))")
  grep -E '(warning|error):' "$log" | sort -u | head -20 >&2 || true
done
printf '%s\n' "${table[@]}"
exit $status
