#!/usr/bin/env bash
# tools/emscripten.sh COMMAND...: runs a command in the project's folder where there is an emscripten that can compile it:
# here, or in a Debian 13 in a chroot, which the first call makes (root needed; some minutes, 2 GB). BRUSHFIRE_EMSCRIPTEN
# says where that is. Ends with 77 where there is neither.
set -euo pipefail
cd "$(dirname "$0")/.."

machine=${BRUSHFIRE_EMSCRIPTEN:-/var/tmp/brushfire-emscripten}
mirror=${BRUSHFIRE_FRESH_MIRROR:-http://deb.debian.org/debian}
packages=(emscripten ca-certificates cmake ninja-build ccache libboost-dev libfast-float-dev nlohmann-json3-dev)
lacking() { printf 'emscripten.sh: %s\n' "$*" >&2; exit 77; }

# 3.1.6, which is Debian 12's, has a standard library without much of C++20.
is_new_enough() {
  local version
  version=$(em++ --version 2>/dev/null | sed -n '1s/.* \([0-9][0-9.]*\).*/\1/p')
  [ -n "$version" ] && printf '3.1.69\n%s\n' "$version" | sort -VC
}
if is_new_enough; then exec "$@"; fi

# Whole under its name, or not there.
make_machine() {
  [ "$(id -u)" = 0 ] || lacking "no emscripten 3.1.69 here, and only root can make a chroot for it"
  command -v debootstrap >/dev/null || lacking "no emscripten 3.1.69 here, and no debootstrap to fetch it with"
  unshare --mount true 2>/dev/null || lacking "no emscripten 3.1.69 here, and this machine makes no chroots"
  printf '\033[1mDebian 13 and its emscripten into %s\033[0m\n' "$machine" >&2
  local part
  part=$(mktemp -d "$machine.part-XXXXXX")
  chmod 755 "$part"
  if ! {
    debootstrap --variant=minbase trixie "$part" "$mirror" &&
      echo force-unsafe-io >"$part/etc/dpkg/dpkg.cfg.d/no-sync" &&
      cp /etc/resolv.conf "$part/etc/resolv.conf" &&
      chroot "$part" env DEBIAN_FRONTEND=noninteractive sh -ec 'apt-get -qq update
        apt-get -qq install -y --no-install-recommends "$@" && apt-get clean' install "${packages[@]}"
  } >"$part.log" 2>&1; then
    tail -n 20 "$part.log" >&2
    umount "$part/proc" 2>/dev/null || true
    rm -rf --one-file-system "$part" "$part.log"
    lacking "the chroot could not be made"
  fi
  umount "$part/proc" 2>/dev/null || true
  rm -f "$part.log"
  mv "$part" "$machine"
}
[ -d "$machine" ] || make_machine

# What this network asks of everyone in it, and a compiler cache beside the machine.
export SSL_CERT_FILE_HERE=${SSL_CERT_FILE:-}
# Mounts are in a namespace of the command's own, and gone when it ends.
exec unshare --mount --propagation private -- bash -c '
  set -e
  machine=$1 here=$2
  shift 2
  mkdir -p "$machine$here"
  mount -t proc proc "$machine/proc"
  mount --rbind /dev "$machine/dev"
  mount --bind "$here" "$machine$here"
  cp /etc/resolv.conf "$machine/etc/resolv.conf"
  certificate=
  if [ -f "$SSL_CERT_FILE_HERE" ]; then certificate=/etc/network-certificates.pem; cp "$SSL_CERT_FILE_HERE" "$machine$certificate"; fi
  exec chroot "$machine" env -i PATH=/usr/bin:/bin HOME=/root TERM=dumb NODE_PATH=/usr/share/nodejs \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    ${certificate:+SSL_CERT_FILE="$certificate"} CMAKE_CXX_COMPILER_LAUNCHER=ccache \
    sh -ec "cd \"\$1\" && shift && exec \"\$@\"" in "$here" "$@"' emscripten "$machine" "$PWD" "$@"
