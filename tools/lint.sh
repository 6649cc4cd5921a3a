#!/usr/bin/env bash
# clang-tidy 19 over the library and the program, and what public headers include, or over what a change touches.
#
#   lint.sh                    everything: an hour of one core
#   lint.sh --changed [BASE]   sources that differ from BASE and those of headers that do, within LINT_SECONDS (60): what
#                              is left then is named. BASE: where this branch left main; on main, the commit before.
#                              Where git does not know, a few sources that show that the checks run.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/release seconds=${LINT_SECONDS:-60}

say() { printf '%s\n' "$*" >&2; }

# tidy SOURCE [SECONDS]
tidy() {
  timeout "${2:-3600}" clang-tidy-19 -p $build --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option "$1" 2>/dev/null
}

# includes HEADER: fails where a public header uses what it does not include, or includes one of ours that it does not
# use. What it means to pass on is marked `IWYU pragma: export`; core/types.h brings the integers of the standard.
includes() {
  local found
  command -v clang-include-cleaner-19 >/dev/null || return 0
  found=$(clang-include-cleaner-19 --print=changes --ignore-headers='cstdint|cstddef' "$1" -- -std=c++20 -Isrc -I$build/generated -x c++ 2>/dev/null |
    grep -E '^(\+|- <brushfire)' || true)
  [ -z "$found" ] || { echo "$1:"; echo "$found"; return 1; }
}

# check FILE [SECONDS]
check() {
  case $1 in
    *.h) includes "$1" ;;
    *) tidy "$@" ;;
  esac
}
export build
export -f tidy includes check

public_headers() { sed -n 's|^#include <\(brushfire/.*\)>|src/\1|p' src/brushfire/brushfire.h | grep -v -e config.h -e version.h; }

# The commit that a change is held against; nothing where there is no history.
base() {
  local fork
  git rev-parse --verify -q HEAD~1 >/dev/null 2>&1 || return 0
  fork=$(git merge-base HEAD main 2>/dev/null || git merge-base HEAD origin/main 2>/dev/null || true)
  if [ -z "$fork" ] || [ "$fork" = "$(git rev-parse HEAD)" ]; then fork=$(git rev-parse HEAD~1); fi
  echo "$fork"
}

# changed BASE: of the files that differ, the work tree's included, public headers and what is compiled. A header stands
# for the source of its name, too.
changed() {
  local file public
  public=$(public_headers)
  git diff --name-only --diff-filter=d "$1" -- src tools | while read -r file; do
    case $file in
      *.cpp) echo "$file" ;;
      *.h)
        grep -x "$file" <<<"$public" || true
        git ls-files "*/$(basename "$file" .h).cpp" | grep -E '^(src|tools)/' || true
        ;;
    esac
  done | sort -u
}

few() { printf '%s\n' src/brushfire/mesh/surface_path.h src/brushfire/mesh/surface_path.cpp src/brushfire/core/text.cpp; }

check_changed() {
  local from files file end=$((SECONDS + seconds)) status=0 looked_at=0 result
  from=${1:-$(base)}
  if [ -n "$from" ]; then mapfile -t files < <(changed "$from"); else mapfile -t files < <(few); fi
  for file in "${files[@]}"; do
    [ $SECONDS -lt $end ] || break
    result=0
    check "$file" $((end - SECONDS)) || result=$?
    [ $result != 124 ] || break  # out of time
    [ $result = 0 ] || status=1
    looked_at=$((looked_at + 1))
  done
  [ $looked_at = ${#files[@]} ] || say "(not within $seconds s: ${files[*]:looked_at})"
  say "$looked_at of ${#files[@]} changed files were checked"
  return $status
}

case ${1:-} in
  --changed) check_changed "${2:-}" ;;
  '') { public_headers; find src tools -name '*.cpp'; } | xargs -P "$(nproc)" -I {} bash -c 'check {}' ;;
  *) say "lint.sh: --changed [BASE] is all that it takes"; exit 2 ;;
esac
