#!/usr/bin/env bash
# Counts the instructions of kernels under callgrind and compares them with budgets.txt. Times vary with the machine and
# its load; instructions do not, so that a tenth more of them is a fact and not noise.
#
#   budgets.sh COUNT_KERNELS             exit 1 where a kernel takes more than 1.1 of its budget, 77 where it cannot be told
#   budgets.sh COUNT_KERNELS --update    writes what was counted to budgets.txt (./run budgets --update)
set -euo pipefail
program=$1 update=${2:-}
budgets=$(dirname "$0")/budgets.txt

skip() { echo "$1: the budgets are not checked"; exit 77; }
command -v valgrind >/dev/null || skip "valgrind is not installed"
# What valgrind passes on of the processor decides which variant of a loop runs.
if [ "$(uname -m)" != x86_64 ] || ! grep -qw avx2 /proc/cpuinfo; then skip "this processor has no AVX2"; fi
compiler=$("$program" --compiler)
[ -n "$update" ] || grep -qx "# $compiler" "$budgets" || skip "built with $compiler, not with the compiler of budgets.txt"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# instructions KERNEL
instructions() {
  valgrind -q --tool=callgrind --callgrind-out-file="$folder/out" --collect-atstart=no --toggle-collect=counted \
    "$program" "$1" >&2
  awk '/^(totals|summary):/ { print $2; exit }' "$folder/out"
}

status=0
printf '%-24s %12s %12s %7s\n' kernel budget counted ratio
grep '^#' "$budgets" >"$folder/new"
while read -r kernel budget; do
  counted=$(instructions "$kernel")
  echo "$kernel $counted" >>"$folder/new"
  verdict=$(awk -v c="$counted" -v b="$budget" 'BEGIN { r = c / b; print (r > 1.1 ? "too many" : r < 0.9 ? "fewer: lower the budget" : "") }')
  printf '%-24s %12s %12s %7.3f %s\n' "$kernel" "$budget" "$counted" "$(awk "BEGIN { print $counted / $budget }")" "$verdict"
  if [ "$verdict" = "too many" ]; then status=1; fi
done < <(grep -v '^#' "$budgets")
if [ -n "$update" ]; then
  sed "s/^# g++ .*/# $compiler/" "$folder/new" >"$budgets"
  echo "$budgets"
  exit 0
fi
if [ $status != 0 ]; then echo "More than a tenth above budget. If that is the price of something: ./run budgets --update"; fi
exit $status
