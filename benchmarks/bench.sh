#!/usr/bin/env bash
# Measures us and the peers from PyPI, and writes docs/benchmarks.md.
#   --quick     three meshes, few rounds: ten minutes in all; printed, and left in build/benchmark/quick
#   --data DIR  collections that you have fetched (FAUST, TOSCA, surfaces of HCP): a table of each, printed
# Further arguments go to suite.py (--only MESH, --core C), or with --data to collections_table.py (--each N).
set -euo pipefail
cd "$(dirname "$0")/.."

venv=build/benchmark/venv
if [ ! -x "$venv/bin/python" ]; then python3 -m venv "$venv"; fi
"$venv/bin/pip" install --quiet --only-binary :all: -r benchmarks/requirements.txt
case ${1:-} in
  --data) exec "$venv/bin/python" benchmarks/collections_table.py "${@:2}" ;;
  --quick)
    mkdir -p build/benchmark/quick
    rm -f build/benchmark/quick/results.json
    "$venv/bin/python" benchmarks/suite.py build/benchmark/quick/results.json "$@"
    "$venv/bin/python" benchmarks/report.py build/benchmark/quick/results.json build/benchmark/quick
    echo "build/benchmark/quick/benchmarks.md" >&2
    ;;
  *)
    "$venv/bin/python" benchmarks/suite.py build/benchmark/results.json "$@"
    "$venv/bin/python" benchmarks/report.py build/benchmark/results.json
    echo "docs/benchmarks.md" >&2
    ;;
esac
