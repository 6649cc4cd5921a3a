"""A clean Debian in a chroot: to build packages in, and to use them where nothing else is. Needs root and debootstrap."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from pathlib import Path

from common import ROOT, run

MIRROR = os.environ.get("BRUSHFIRE_FRESH_MIRROR", "http://deb.debian.org/debian")
# Mounts and processes are in namespaces of the command's own, and gone when it ends, however it ends.
ENTER = """
set -e
machine=$1 cache=$2
shift 2
mount -t proc proc "$machine/proc"
mount --rbind /dev "$machine/dev"
if [ -n "$cache" ]; then mkdir -p "$machine/var/cache/ccache"; mount --bind "$cache" "$machine/var/cache/ccache"; fi
exec chroot "$machine" env -i "$@"
"""


class Machine:
    """Of the archives that ./run fresh keeps (build/fresh/RELEASE.tar), which this makes where they are missing."""

    def __init__(self, release: str, name: str) -> None:
        self.release, self.folder = release, ROOT / "build/machines" / name
        self.cache = os.environ.get("BRUSHFIRE_FRESH_CCACHE", "")
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        archive = ROOT / "build/fresh" / f"{release}.tar"
        if not archive.exists():
            archive.parent.mkdir(parents=True, exist_ok=True)
            run("debootstrap", "--variant=minbase", release, self.folder, MIRROR)
            (self.folder / "etc/dpkg/dpkg.cfg.d/no-sync").write_text("force-unsafe-io\n")
            run("tar", "-cf", f"{archive}.part", "-C", self.folder, ".")
            Path(f"{archive}.part").rename(archive)
        else:
            run("tar", "-xf", archive, "-C", self.folder)
        self.folder.chmod(0o755)
        shutil.copy("/etc/resolv.conf", self.folder / "etc/resolv.conf")
        self.environment = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root",
                            "TERM": "dumb", "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive"}  # fmt: skip
        self.network()
        self.log: list[str] = []
        self.seconds = 0.0  # that the last command took

    def network(self) -> None:
        """What this network asks of everyone in it."""
        for name in ("http_proxy", "https_proxy", "no_proxy", "PIP_INDEX_URL", "npm_config_registry"):
            if name in os.environ:
                self.environment[name] = os.environ[name]
        certificates = Path(os.environ.get("PIP_CERT") or os.environ.get("SSL_CERT_FILE") or "/none")
        if certificates.is_file():
            shutil.copy(certificates, self.folder / "etc/network-certificates.pem")
            for name in ("PIP_CERT", "SSL_CERT_FILE", "NODE_EXTRA_CA_CERTS"):
                self.environment[name] = "/etc/network-certificates.pem"

    def inside(self, command: str, *, told: bool = False, **more: str) -> str:
        """Runs a line of shell there; `told`: it stands in the machine's log, with what it printed and how long it took."""
        words = [f"{name}={value}" for name, value in (self.environment | more).items()]
        begin = time.monotonic()
        done = subprocess.run(
            ["unshare", "--mount", "--propagation", "private", "--pid", "--fork", "--kill-child", "--", "bash", "-c", ENTER,
             "enter", str(self.folder), self.cache, *words, "bash", "-euo", "pipefail", "-c", command],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
        )  # fmt: skip
        self.seconds = time.monotonic() - begin
        if told:
            self.log += [f"$ {command}", *done.stdout.rstrip().splitlines()[-40:], f"[{self.seconds:.1f} s]", ""]
        if done.returncode:
            raise SystemExit(f"{self.release}: {command}\n{done.stdout[-20000:]}")
        return done.stdout

    def install(self, *packages: str) -> None:
        self.inside("apt-get -qq update && apt-get -qq install -y --no-install-recommends " + " ".join(packages))

    def take(self, *files: Path) -> None:
        """Copies files into the machine's /root."""
        for file in files:
            shutil.copy(file, self.folder / "root")

    def remove(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)
