#!/usr/bin/env bash
# ./run fresh: the two commands of the README on machines that have nothing yet. Called in the project's folder, as root.
#
# A machine is a Debian of debootstrap's smallest kind, in a chroot: no compiler, no git, no locale, no font; its user is
# root, or one who may use sudo. It gets the checkout as it lies there, changes included, and the network's settings.
#
# `keep`: machines stay, in build/fresh/RELEASE-USER, and serve again with `keep`: what was installed and built in them is
# there, the checkout is as it lies here now. For mending what failed; what passed on a kept machine has to on a bare one.
set -euo pipefail

usage='usage: ./run fresh [bookworm] [trixie] [root] [user] [demo] [test] [build] [python] [threads] [keep]'
releases=() users=() commands=() keep=
for word in "$@"; do
  case $word in
    bookworm | trixie) releases+=("$word") ;;
    root | user) users+=("$word") ;;
    demo | test | build | python | threads) commands+=("$word") ;;
    keep) keep=yes ;;
    *) echo "$usage" >&2; exit 2 ;;
  esac
done
if [ ${#releases[@]} = 0 ]; then releases=(bookworm trixie); fi
if [ ${#users[@]} = 0 ]; then users=(root user); fi
if [ ${#commands[@]} = 0 ]; then commands=(demo test); fi

mirror=${BRUSHFIRE_FRESH_MIRROR:-http://deb.debian.org/debian}
cache=${BRUSHFIRE_FRESH_CCACHE:-}
here=build/fresh logs=build/fresh/logs table=() worker=
exec {table_out}>&1
mkdir -p "$logs"
machine=
say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }

# Mounts and processes are in namespaces of the command's own, and gone when it ends, however it ends. In the background,
# so that this script hears signals meanwhile.
inside() {
  unshare --mount --propagation private --pid --fork --kill-child -- bash -c '
    set -e
    machine=$1 cache=$2
    shift 2
    mount -t proc proc "$machine/proc"
    mount --rbind /dev "$machine/dev"
    if [ -n "$cache" ]; then mkdir -p "$machine/var/cache/ccache" && mount --bind "$cache" "$machine/var/cache/ccache"; fi
    exec chroot "$machine" "$@"' inside "$machine" "$cache" "$@" &
  worker=$!
  wait "$worker"
}

cleared() { if [[ $machine == */machine-* ]]; then rm -rf --one-file-system "$machine"; fi; }

# At the end, whatever ended it: what was found out so far.
finish() {
  local status=$?
  cleared
  exec >&"$table_out"  # a signal may come while output goes to a log
  printf '\n%-9s %-5s %-11s %-7s %8s\n' release user command result seconds
  if [ ${#table[@]} -gt 0 ]; then printf '%s\n' "${table[@]}"; fi
  echo "Processors: $(nproc). Compiled files from a cache: $(if [ -n "$cache" ]; then echo "yes, $cache"; else echo no; fi)."
  exit "$status"
}
trap finish EXIT
trap 'kill -KILL "$worker" 2>/dev/null; wait; exit 130' INT TERM

# base RELEASE USER: the machine as debootstrap makes it, or as it was kept. The bare one's archive is kept in any case.
base() {
  local archive=$here/$1.tar kept=$PWD/$here/$1-$2
  cleared
  machine=$kept
  if [ -n "$keep" ] && [ -d "$kept" ]; then return; fi
  machine=$(mktemp -d "$PWD/$here/machine-XXXXXX")
  if [ -s "$archive" ]; then
    tar -xf "$archive" -C "$machine"
  else
    say "Debian $1 from $mirror"
    debootstrap --variant=minbase "$1" "$machine" "$mirror" >"$logs/$1-debootstrap.log"
    rm -f "$machine"/var/cache/apt/archives/*.deb
    echo force-unsafe-io >"$machine/etc/dpkg/dpkg.cfg.d/no-sync"  # a machine that lives for an hour need not sync its disk
    tar -cf "$archive.part" -C "$machine" . && mv "$archive.part" "$archive"
  fi
  chmod 755 "$machine"  # the user's root, too, which mktemp makes for its own user alone
  if [ -n "$keep" ]; then mv "$machine" "$kept" && machine=$kept; fi
}

# What this network asks of everyone in it: name servers, proxies, certificates.
network() {
  local name certificates=${PIP_CERT:-${SSL_CERT_FILE:-}}
  environment=(PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb)
  cp /etc/resolv.conf "$machine/etc/resolv.conf"
  echo "127.0.0.1 localhost $(uname -n)" >"$machine/etc/hosts"
  for name in http_proxy https_proxy no_proxy PIP_INDEX_URL; do
    if [ -n "${!name:-}" ]; then environment+=("$name=${!name}"); fi
  done
  if [ -n "${http_proxy:-}" ]; then echo "Acquire::http::Proxy \"$http_proxy\";" >"$machine/etc/apt/apt.conf.d/90proxy"; fi
  if [ -f "$certificates" ]; then
    cp "$certificates" "$machine/etc/network-certificates.pem"
    environment+=(PIP_CERT=/etc/network-certificates.pem)
  fi
}

install_in_machine() {
  inside env "${environment[@]}" DEBIAN_FRONTEND=noninteractive sh -c \
    'apt-get -qq update && apt-get -qq install -y --no-install-recommends "$@"' install "$@" >"$logs/install.log" 2>&1 ||
    { cat "$logs/install.log" >&2; return 1; }
}

# prepared USER: makes the user, and the cache of compiled files where one was asked for. Sets `home`.
prepared() {
  home=/root
  if [ "$1" = user ]; then
    home=/home/user
    install_in_machine sudo
    inside id user >/dev/null 2>&1 || inside useradd --create-home --shell /bin/bash user
    echo 'user ALL=(ALL) NOPASSWD: ALL' >"$machine/etc/sudoers.d/user"
  fi
  environment+=("HOME=$home")
  if [ -n "$cache" ]; then
    install_in_machine ccache
    # The same compiler has the same date in every machine, its package's: the cache may come from outside, too.
    environment+=(CCACHE_DIR=/var/cache/ccache CCACHE_UMASK=000 CCACHE_NOHASHDIR=1 "CCACHE_BASEDIR=$home/brushfire"
      "CCACHE_SLOPPINESS=locale,pch_defines,time_macros")
  fi
}

# The checkout without its history and without what was built here. On a kept machine, what it built stays, and what has
# not changed since keeps its date: nothing is built twice.
checkout() {
  local old=$machine$home/brushfire new=$machine$home/brushfire.new file
  rm -rf "$new"
  mkdir -p "$old" "$new"
  if command -v git >/dev/null && git rev-parse --git-dir >/dev/null 2>&1; then
    git -c safe.directory="$PWD" ls-files -co --exclude-standard -z | xargs -0 ls -d 2>/dev/null | tar -c -T -
  else
    tar -c --exclude=./build --exclude=./demo --exclude=./.git .
  fi | tar -x -C "$new" --no-same-owner
  (cd "$new" && find . -type f) | while read -r file; do
    if cmp -s "$old/$file" "$new/$file"; then touch -r "$old/$file" "$new/$file"; else touch "$new/$file"; fi
  done
  for file in build demo; do
    if [ -e "$old/$file" ]; then mv "$old/$file" "$new/"; fi
  done
  rm -rf "$old"
  mv "$new" "$old"
  if [ "$1" = user ]; then inside chown -R user:user "$home"; fi
}

# command RELEASE USER COMMAND: one line of the table.
command_in_machine() {
  local log=$logs/$1-$2-$3.log start=$SECONDS result=ok as=()
  say "$1, $2: ./run $3 (log: $log)"
  if [ "$2" = user ]; then as=(setpriv --reuid=user --regid=user --init-groups); fi
  inside "${as[@]}" env -i "${environment[@]}" sh -c 'cd && cd brushfire && exec ./run "$1"' run "$3" \
    </dev/null >"$log" 2>&1 || result=FAILED
  table+=("$(printf '%-9s %-5s %-11s %-7s %8d' "$1" "$2" "./run $3" $result $((SECONDS - start)))")
  # What the test programs said last.
  while read -r line; do table+=("            $line"); done < <(grep -E 'tests (passed|failed)|[0-9]+ passed' "$log" | tail -n 5)
  [ $result = ok ] || { tail -n 40 "$log" >&2; return 1; }
}

status=0
if [ -n "$cache" ]; then
  mkdir -p "$cache" && chmod -R a+rwX "$cache"
  cache=$(cd "$cache" && pwd)
fi
for release in "${releases[@]}"; do
  for user in "${users[@]}"; do
    base "$release" "$user"
    network
    prepared "$user"
    checkout "$user"
    for command in "${commands[@]}"; do command_in_machine "$release" "$user" "$command" || status=1; done
  done
done
exit $status
