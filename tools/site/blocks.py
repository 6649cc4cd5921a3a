"""Executes every code block of the documentation: build/venv/bin/python tools/site/blocks.py [PAGE...]

Blocks of one page run in turn, in one folder and one Python, so that a page reads like a session; brushfire is imported
there as bf. The folder holds scan.ply, a sphere with dents of 642 vertices, and what tools/site/files/PAGE.py makes in it
(README.py, docs-certify.py). C++ of all pages is one program with a function for each page, which compiles once.

    ```python, ```sh            run; indented blocks that begin with `brushfire` are sh, too. A comment of a command that
                                has `exit code N` in it means it
    ```c++, ```cpp              compiled against build/release, linked and run
    ```js                       run by Node, where the WebAssembly is built (./run web); otherwise only parsed
    ```text after one of them   what it prints; `...` stands for anything
    ```console                  a command after `$ `, and what it prints
    <!-- run: python            a block that readers do not see, up to -->; of js: put before the later ones of the page
    <!-- not run: REASON -->    the next block is not run; at the end of any line before it
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path

from pages import PROGRAM, ROOT, Block, Failure, blocks_of, compare, make_scan

import brushfire as bf

WASM = ROOT / "js/lib/brushfire.wasm"
VIEWER = PROGRAM.with_name("viewer.html")
SLOW = 2  # seconds of processor time of one block, beyond which it is told


# ---- running ---------------------------------------------------------------------------------------------------------
class Session:
    """One page: a folder with scan.ply, and a Python."""

    def __init__(self, scan: Path, environment: dict[str, str]) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="brushfire-docs-"))
        shutil.copy(scan, self.folder)
        self.environment = environment
        self.names: dict[str, object] = {"__name__": "__main__", "bf": bf}
        self.js_before = ""

    def close(self) -> None:
        shutil.rmtree(self.folder)

    def run(self, block: Block) -> str:
        """Returns what it printed."""
        os.chdir(self.folder)
        return {"python": self.python, "sh": self.shell, "console": self.console, "js": self.javascript}[
            block.language
        ](block)

    def python(self, block: Block) -> str:
        printed = io.StringIO()
        code = compile("\n" * block.line + block.text, ROOT / block.page, "exec")
        with contextlib.redirect_stdout(printed):
            exec(code, self.names)  # noqa: S102
        return printed.getvalue()

    def shell(self, block: Block) -> str:
        lines = block.text.splitlines()
        if not VIEWER.exists():
            lines = [line for line in lines if not line.startswith("brushfire view")]
        # A command whose comment says so ends with that exit code.
        text = re.sub(
            r"^(.*?)(  #.*\bexit code (\d+).*)$",
            r"status=0; \1 || status=$?; [ $status = \3 ]\2",
            "\n".join(lines),
            flags=re.MULTILINE,
        )
        return self.command(["bash", "-euo", "pipefail", "-c", text], block)

    def console(self, block: Block) -> str:
        parts = re.split(r"^\$ ", block.text, flags=re.MULTILINE)[1:]
        for part in parts:
            command, _, expected = part.partition("\n")
            printed = self.command(["bash", "-uo", "pipefail", "-c", command + " 2>&1"], block, check=False)
            compare(expected, printed)
        return ""

    def javascript(self, block: Block) -> str:
        if block.hidden:
            self.js_before += block.text + "\n"
            return ""
        file = self.folder / "block.mjs"
        file.write_text(self.js_before + block.text)
        if not WASM.exists():
            return self.command(["node", "--check", str(file)], block)
        modules = self.folder / "node_modules"
        modules.mkdir(exist_ok=True)
        if not (modules / "brushfire").exists():
            (modules / "brushfire").symlink_to(ROOT / "js")
        return self.command(["node", str(file)], block)

    def command(self, command: list[str], block: Block, *, check: bool = True) -> str:
        done = subprocess.run(
            command, cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=60, check=False
        )
        if check and done.returncode:
            raise Failure(f"exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout


def run_cpp(pages: dict[str, list[Block]], scan: Path) -> None:
    """All C++ as one program: a function a page, run in a folder of its own."""
    includes, functions, calls = {"#include <brushfire/brushfire.h>"}, [], []
    for number, blocks in enumerate(pages.values()):
        body = []
        for block in blocks:
            lines = block.text.splitlines()
            includes.update(line for line in lines if line.startswith("#include"))
            body.append(f'#line {block.line + 1} "{ROOT / block.page}"')
            body += ["" if line.startswith("#include") else line for line in lines]
        functions.append(f"void page_{number}() {{\n" + "\n".join(body) + "\n}\n")
        calls.append(f"  page_{number}();")
    with tempfile.TemporaryDirectory(prefix="brushfire-docs-") as name:
        folder = Path(name)
        source = (
            "\n".join(sorted(includes))
            + "\n#include <cstdio>\nnamespace {\n"
            + "\n".join(functions)
            + "}\nint main() {\n"
            + "\n".join(calls)
            + "\n}\n"
        )
        (folder / "blocks.cpp").write_text(source)
        shutil.copy(scan, folder)
        release = ROOT / "build/release"
        libraries = link_line(release)
        compiler = os.environ.get("CXX", "g++")
        command = [
            compiler,
            "-std=c++20",
            "-O0",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-Wno-unused-variable",
            f"-I{ROOT / 'src'}",
            f"-I{release / 'generated'}",
            "blocks.cpp",
            "-o",
            "blocks",
            *libraries,
        ]
        for step in (command, ["./blocks"]):
            done = subprocess.run(step, cwd=folder, capture_output=True, text=True, timeout=120, check=False)
            if done.returncode:
                raise Failure(f"the C++ of {', '.join(pages)}\n{done.stdout}{done.stderr}")


def link_line(release: Path) -> list[str]:
    """What brushfire.pc says that a static brushfire needs."""
    said = dict(line.split(": ", 1) for line in (release / "brushfire.pc").read_text().splitlines() if ": " in line)
    own = [word for word in said["Libs"].split() if word != "-lbrushfire" and not word.startswith("-L")]
    required = said.get("Requires", "").split()
    others = (
        subprocess.run(["pkg-config", "--libs", *required], check=True, capture_output=True, text=True).stdout.split()
        if required
        else []
    )
    return [str(release / "libbrushfire.a"), *own, *others]


def make_files(page: str, folder: Path) -> None:
    """The files that the page's commands speak of."""
    script = ROOT / "tools/site/files" / (page.removesuffix(".md").replace("/", "-") + ".py")
    if script.exists():
        os.chdir(folder)
        exec(compile(script.read_text(), script, "exec"), {"__name__": "__main__", "__file__": str(script)})  # noqa: S102


def spent() -> float:
    """Processor time of this process and of what it has started, in seconds."""
    return sum(os.times()[:4])


# ---- all of it -------------------------------------------------------------------------------------------------------
def pages() -> list[Path]:
    """What readers read. Decisions and measured pages tell what was; they hold no blocks to copy."""
    docs = [file for file in sorted((ROOT / "docs").rglob("*.md"))]
    return [ROOT / "README.md", ROOT / "python/README.md", ROOT / "js/README.md", *docs]


def run_page(page: str, blocks: list[Block], scan: Path, environment: dict[str, str]) -> int:
    """All but its C++. Returns how many blocks failed."""
    session = Session(scan, environment)
    make_files(page, session.folder)
    failed = 0
    for block in blocks:
        if block.reason is not None or block.language == "c++":
            continue
        before = spent()
        try:
            printed = session.run(block)
            if block.expected is not None and (block.language != "js" or WASM.exists()):
                compare(block.expected, printed)
        except Exception as problem:  # noqa: BLE001
            told = str(problem) if isinstance(problem, Failure) else traceback.format_exc(limit=-2)
            print(f"{page}:{block.line}: {told}")
            failed += 1
        if spent() - before > SLOW:
            print(f"({page}:{block.line} takes {spent() - before:.1f} s of processor time)")
    os.chdir(ROOT)
    session.close()
    return failed


def run_all(everything: dict[str, list[Block]]) -> int:
    """Returns how many failed."""
    search = f"{PROGRAM.parent}:{Path(sys.executable).parent}:{os.environ['PATH']}"
    os.environ["PATH"] = search  # for the scripts of files/, too
    environment = {**os.environ, "LC_ALL": "C.UTF-8"}
    cpp = {page: [b for b in blocks if b.language == "c++" and b.reason is None] for page, blocks in everything.items()}
    cpp = {page: blocks for page, blocks in cpp.items() if blocks}
    with tempfile.TemporaryDirectory(prefix="brushfire-docs-") as home:
        scan = Path(home) / "scan.ply"
        make_scan(scan)
        failed = sum(run_page(page, blocks, scan, environment) for page, blocks in everything.items())
        if cpp:
            try:
                run_cpp(cpp, scan)
            except Failure as failure:
                print(failure)
                failed += 1
    return failed


def main() -> None:
    begin = time.monotonic()
    chosen = [Path(name).resolve() for name in sys.argv[1:]] or pages()
    everything = {file.relative_to(ROOT).as_posix(): blocks_of(file) for file in chosen}
    everything = {page: blocks for page, blocks in everything.items() if blocks}
    failed = run_all(everything)
    blocks = [block for page in everything.values() for block in page]
    skipped = [block for block in blocks if block.reason is not None]
    for block in skipped:
        print(f"(not run: {block.page}:{block.line}, {block.language}: {block.reason})")
    counts = Counter(block.language for block in blocks if block.reason is None)
    if counts["js"] and not WASM.exists():
        print("(JavaScript was parsed, not run: ./run web builds its WebAssembly)")
    if not VIEWER.exists():
        print("(lines of brushfire view were not run: ./run web builds its page)")
    told = ", ".join(f"{count} of {language}" for language, count in sorted(counts.items()))
    print(
        f"{counts.total()} blocks run on {len(everything)} pages ({told}) in {time.monotonic() - begin:.0f} s, "
        f"{spent():.0f} s of processor time; {failed} failed, {len(skipped)} not run"
    )
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
