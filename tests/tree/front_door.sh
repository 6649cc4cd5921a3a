#!/usr/bin/env bash
# tests/tree/front_door.sh RUN SCRATCH: what ./run installs, asks for and does without, on machines whose package manager
# is a list in a file: the names that it offers, and those that are installed.
set -euo pipefail
run=$1 scratch=$2 failures=0
cd "$(dirname "$run")"
rm -rf "$scratch"
mkdir -p "$scratch"

# All packages of ./run, those that it needs and (with a `+`) those that it can do without.
eval "$(sed -n '/_packages=(/,/)/p' "$run")"
all=("${build_packages[@]}" "${test_packages[@]}" "${python_packages[@]}" "${lint_packages[@]}" "${fuzz_packages[@]}")
words() { printf '%s\n' "$@" | sort -u; }
required() { words "$@" | sed '/^+/d'; }
optional() { words "$@" | sed -n 's/^+//p'; }

# machine: an empty one in $place, with the tools that ./run takes for granted and nothing else; not even apt.
machine() {
  local tool
  place=$scratch/$1
  mkdir -p "$place/bin" "$place/tree"
  cp "$run" "$place/tree/run"
  : | tee "$place/offered" "$place/installed" >"$place/asked"
  for tool in bash sh env dirname mktemp cat rm sed grep seq sleep nproc find xargs printf mkdir sort; do
    ln -s "$(command -v $tool)" "$place/bin/$tool"
  done
}

# stub NAME <<<BODY: a program of the machine.
stub() {
  { echo "#!$(command -v bash)"; cat; } >"$place/bin/$1"
  chmod +x "$place/bin/$1"
}

# apt offers the given packages; root may install them.
apt() {
  printf '%s\n' "$@" >"$place/offered"
  stub dpkg-query <<<"grep -qx -- \"\${!#}\" $place/installed && printf installed"
  stub apt-cache <<<"grep -qx -- \"\$2\" $place/offered"
  stub apt-get <<<"
while [[ \$1 == -* ]]; do case \$1 in -o) shift 2 ;; *) shift ;; esac; done
echo \"\$*\" >>$place/asked
[ \$1 = install ] || exit 0
shift
for package; do
  [[ \$package == -* ]] || { grep -qx -- \"\$package\" $place/offered && echo \"\$package\" >>$place/installed; } ||
    { echo \"E: Unable to locate package \$package\"; exit 100; }
done"
  stub id <<<'echo 0'
  stub cmake <<<'exit 0'
}

# job WORD...: ./run WORD...; what it says is in $said, how it ends in $code.
job() {
  code=0
  said=$(cd "$place/tree" && env -i PATH="$place/bin" HOME="$place" TMPDIR="$place" bash ./run "$@" 2>&1) || code=$?
}

expect() {
  if ! eval "$2"; then
    failures=$((failures + 1))
    printf '%s: %s\n  %s\n  exit code %s; asked: %s\n  said: %s\n' "${place##*/}" "$1" "$2" "$code" "$(cat "$place/asked")" "$said"
  fi
}
installed() { sort -u "$place/installed"; }
says() { [[ $said == *"$1"* ]]; }

# Debian 13 and Ubuntu 24.04, which have everything.
machine everything
mapfile -t names < <(required "${all[@]}"; optional "${all[@]}")
apt "${names[@]}"
job build
expect "a build ends well" '[ $code = 0 ]'
expect "what it needs and what it can do without is installed" \
  '[ "$(installed)" = "$( (required "${build_packages[@]}"; optional "${build_packages[@]}") | sort)" ]'
expect "nothing is said to be missing" '! says "going on without"'
: >"$place/asked"
job build
expect "the second time nothing is asked for" '[ $code = 0 ] && [ ! -s "$place/asked" ]'

# Where no optional package has a name that apt knows.
machine bare
mapfile -t names < <(required "${all[@]}")
apt "${names[@]}"
for words in build lint fuzz; do
  job $words
  packages="${words}_packages[@]"
  for name in $(optional "${!packages}"); do
    expect "$words: each package that is not on offer is named" 'says "(no $name in this distribution: going on without)"'
  done
done
expect "the fuzzers say that they do not run" '[ $code = 0 ] && says "the readers are not fuzzed"'
expect "what is needed is installed" '[ "$(installed)" = "$(required "${build_packages[@]}" "${lint_packages[@]}")" ]'
job format
expect "the format's check is skipped, which a test takes as skipped" '[ $code = 77 ] && says "the format is not checked"'
job lint --changed
expect "clang-tidy, too" '[ $code = 77 ] && says "its checks are left out"'

# Ubuntu 22.04: LLVM of other versions, and version 19 from elsewhere, under a name without the number.
machine other_names
mapfile -t names < <({ words "${names[@]}"; optional "${build_packages[@]}" +libembree-dev +valgrind +ccache; } | sort -u)
apt "${names[@]}"
stub clang-format <<<'echo "Ubuntu clang-format version 14.0.0-1ubuntu1"'
job format
expect "another version is not the one that the format is defined by" '[ $code = 77 ]'
stub clang-format <<<'[ "$1" != --version ] || { echo "Ubuntu clang-format version 19.1.1"; exit; }; echo checked'
mkdir "$place/tree/src"
: >"$place/tree/src/a.cpp"
job format
expect "version 19 is, whatever its name" '[ $code = 0 ] && says checked'

# A package that is needed and not there.
machine too_old
apt cmake
job build
expect "what could not be installed is named" '[ $code = 1 ] && says "could not install" && says "libstb-dev"'

# Neither root nor sudo.
machine a_user
mapfile -t names < <(required "${all[@]}"; optional "${all[@]}")
apt "${names[@]}"
stub id <<<'echo 1000'
job build
expect "one list of everything, without marks" \
  '[ $code = 1 ] && says "please install as root: apt-get install" && says " g++" && says " zlib1g-dev" && ! says " +"'
required "${build_packages[@]}" >"$place/installed"
job build
expect "what is optional is no reason to stop" '[ $code = 0 ] && says "going on without" && says "zlib1g-dev"'
expect "nothing was asked of apt" '[ ! -s "$place/asked" ]'

# No apt: what is not there, in one list.
machine without_apt
rm -f "$place/bin/apt-get"
job build
expect "one list" '[ $code = 1 ] && says "no apt-get" && says "C++20 compiler" && says "CMake 3.22" && says "Ninja"'
for name in c++ cmake ninja; do stub $name <<<'exit 0'; done
job build
expect "and on with it where nothing lacks" '[ $code = 0 ]'

[ $failures = 0 ] || { echo "$failures failed"; exit 1; }
echo "all as it should be"
