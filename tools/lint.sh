#!/usr/bin/env bash
# clang-tidy 19 over the library and the program, and what public headers include, or over what a change touches.
#
#   lint.sh                    everything: half an hour of one core
#   lint.sh --changed [BASE]   sources that differ from BASE and those of headers that do, within LINT_SECONDS (60): what
#                              is left then is named. BASE: where this branch left main; on main, the commit before.
#                              Exit 77 where git has no history that tells.
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
  git rev-parse --verify -q HEAD~1 >/dev/null 2>&1 || return 0  # no repository, or only its last commit
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

# check_until SECOND FILE: what is late, or wrong, goes into lists of its own.
check_until() {
  local left=$(($1 - EPOCHSECONDS)) result=0
  if [ $left -le 0 ]; then echo "$2" >>"$lists/late"; return; fi
  check "$2" $left || result=$?
  if [ $result = 124 ]; then echo "$2" >>"$lists/late"; return; fi
  [ $result = 0 ] || echo "$2" >>"$lists/wrong"
}
export -f check_until

check_changed() {
  local from files late=() end=$((EPOCHSECONDS + seconds))
  from=${1:-$(base)}
  [ -n "$from" ] || { say "no history of git: which files changed cannot be told, none is checked"; return 77; }
  mapfile -t files < <(changed "$from")
  lists=$(mktemp -d)
  export lists
  trap 'rm -rf "$lists"' EXIT
  printf '%s\n' "${files[@]}" | sed '/^$/d' | xargs -P "$(nproc)" -I {} bash -c "check_until $end {}"
  [ ! -e "$lists/late" ] || mapfile -t late <"$lists/late"
  [ ${#late[@]} = 0 ] || say "(not within $seconds s: ${late[*]})"
  say "$((${#files[@]} - ${#late[@]})) of ${#files[@]} changed files were checked"
  [ ! -e "$lists/wrong" ]
}

case ${1:-} in
  --changed) check_changed "${2:-}" ;;
  '') { public_headers; find src tools -name '*.cpp'; } | xargs -P "$(nproc)" -I {} bash -c 'check {}' ;;
  *) say "lint.sh: --changed [BASE] is all that it takes"; exit 2 ;;
esac
