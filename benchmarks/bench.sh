#!/usr/bin/env bash
# Measures us and the peers from PyPI, and writes docs/benchmarks.md. Arguments go to suite.py (--only MESH, --core C).
set -euo pipefail
cd "$(dirname "$0")/.."

venv=build/benchmark/venv
if [ ! -x "$venv/bin/python" ]; then python3 -m venv "$venv"; fi
"$venv/bin/pip" install --quiet --only-binary :all: -r benchmarks/requirements.txt
"$venv/bin/python" benchmarks/suite.py build/benchmark/results.json "$@"
"$venv/bin/python" benchmarks/report.py build/benchmark/results.json
echo "docs/benchmarks.md" >&2
