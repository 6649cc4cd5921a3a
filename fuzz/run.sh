#!/usr/bin/env bash
# fuzz/run.sh SECONDS [READER...]: fuzzes every reader (or those named) for so long each, JOBS at a time (1). SEED: where
# the random numbers begin (0, the default: anywhere; CI begins at 1, so that it finds what it found the last time).
# Prints one line per reader with the number of executions; fails, and keeps the input in build/fuzz/findings, where
# one was found.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:?usage: fuzz/run.sh SECONDS [READER...]}; shift
command -v clang++-19 >/dev/null || { echo "fuzz/run.sh: clang-19 is needed (apt-get install clang-19)" >&2; exit 1; }
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzzers >&2
export build=build/fuzz/fuzz seconds SEED=${SEED:-0}
export corpus=build/fuzz/corpus findings=build/fuzz/findings
mkdir -p "$corpus" "$findings"
"$build/make_seeds" "$corpus"
readers=("$@")
if [ ${#readers[@]} = 0 ]; then mapfile -t readers < <(cd "$build" && printf '%s\n' fuzz_* | sed 's/^fuzz_//'); fi

one() {
  local log="$findings/$1.log" status=0
  nice -n 19 "$build/fuzz_$1" -seed="$SEED" -max_total_time="$seconds" -max_len=16384 -timeout=20 -rss_limit_mb=1500 -print_final_stats=1 \
    -artifact_prefix="$findings/$1-" "$corpus/$1" >"$log" 2>&1 || status=$?
  echo "$1: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions$([ $status = 0 ] || echo ", FINDING: see $log")"
  return $status
}
export -f one
printf '%s\n' "${readers[@]}" | xargs -P "${JOBS:-1}" -I {} bash -c 'one {}'
