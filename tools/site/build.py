"""Builds the documentation site: python tools/site/build.py [--links]. Called by ./run docs.

Gathers docs/ and what is generated (references, figures, the viewer) in build/site/source, lets Sphinx make build/site/html
of it with warnings as errors, and follows every internal link of the result. --links asks for the external ones, too.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import figures
import reference

ROOT = Path(__file__).parents[2]
SITE = ROOT / "build/site"
SOURCE = SITE / "source"
HTML = SITE / "html"
PROGRAM = ROOT / "build/release/brushfire"
# Pages of the repository that become pages of the site.
PAGES = {
    "README.md": "index.md",
    "CHANGELOG.md": "changes.md",
    "CONTRIBUTING.md": "contributing.md",
    "SECURITY.md": "security.md",
}


def gather() -> None:
    """build/site/source, anew."""
    shutil.rmtree(SOURCE, ignore_errors=True)
    shutil.copytree(ROOT / "docs", SOURCE, ignore=shutil.ignore_patterns("__pycache__"))
    for name, page in PAGES.items():
        if page != "index.md":
            text = (ROOT / name).read_text()
            (SOURCE / page).write_text(linked(text, ROOT / name, SOURCE / page))
    for page in sorted(SOURCE.rglob("*.md")):
        origin = ROOT / "docs" / page.relative_to(SOURCE)
        if origin.exists():
            page.write_text(linked(page.read_text(), origin, page))
    with (SOURCE / "decisions/README.md").open("a") as index:
        index.write("\n```{toctree}\n:hidden:\n:glob:\n*\n```\n")
    for path, text in (reference.cpp() | reference.python_rest() | reference.cli(PROGRAM) | reference.js()).items():
        (SOURCE / path).parent.mkdir(parents=True, exist_ok=True)
        (SOURCE / path).write_text(text)
    figures.draw(SOURCE / "figures")
    live_viewer(SOURCE / "extra/viewer")
    place_the_rest()


def place_the_rest() -> None:
    """Pages that index.md does not name yet go under "More", so that a new page needs no change here."""
    index = SOURCE / "index.md"
    named = set(re.findall(r"^[\w/-]+$", index.read_text(), re.MULTILINE)) | {"index"}
    folders = ("", "concepts", "tutorials", "migrate")
    pages = [
        page.relative_to(SOURCE).as_posix().removesuffix(".md") for f in folders for page in (SOURCE / f).glob("*.md")
    ]
    if rest := sorted(set(pages) - named):
        print(f"(docs/index.md names no place for {', '.join(rest)}: under More)")
        with index.open("a") as file:
            file.write("\n```{toctree}\n:hidden:\n:caption: More\n" + "\n".join(rest) + "\n```\n")


def live_viewer(folder: Path) -> None:
    """One file with a mesh and the library in it: what `brushfire view` makes, where its page was built."""
    folder.mkdir(parents=True)
    if not PROGRAM.with_name("viewer.html").exists():
        print("(the viewer is not built, ./run web does: the start page shows a picture in its place)")
        return
    mesh = ROOT / "demo/bunny.off"
    if not mesh.exists():
        mesh = SITE / "mesh.ply"
        subprocess.run([PROGRAM, "shape", "folded-sphere", "-n", "20000", "-o", mesh, "--quiet"], check=True)
    subprocess.run([PROGRAM, "view", mesh, "-o", folder / "index.html", "--quiet"], check=True)


def linked(text: str, origin: Path, page: Path) -> str:
    """Links of a Markdown file of the repository, for where it stands in the site."""
    headers = set(reference.public_headers())

    def link(match: re.Match[str]) -> str:
        bang, label, target = match[1], match[2], match[3]
        path, _, anchor = target.partition("#")
        if not path or urlsplit(target).scheme:
            return match[0]
        file = (origin.parent / path).resolve()
        name = file.relative_to(ROOT).as_posix()
        if file.is_relative_to(ROOT / "docs") and (file.is_file() or name.startswith("docs/reference/")):
            to = SOURCE / file.relative_to(ROOT / "docs")
        elif not file.exists():
            raise SystemExit(f"{origin.relative_to(ROOT)}: the link to {target} leads nowhere")
        elif name in PAGES:
            to = SOURCE / PAGES[name]
        elif name.startswith("src/brushfire/") and (header := name.removeprefix("src/brushfire/")) in headers:
            to = SOURCE / "reference" / f"{reference.cpp_page(header)}.md"
        elif file.is_dir():
            return label
        else:
            to = SOURCE / "files" / name
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, to)
        return f"{bang}[{label}]({relative(to, page.parent)}{'#' + anchor if anchor else ''})"

    blocks = re.split(r"(^```.*?^```[^\n]*$)", text, flags=re.MULTILINE | re.DOTALL)
    for i in range(0, len(blocks), 2):
        blocks[i] = re.sub(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)", link, blocks[i])
    return "".join(blocks)


def relative(to: Path, folder: Path) -> str:
    up = len(folder.relative_to(SOURCE).parts)
    return "../" * up + to.relative_to(SOURCE).as_posix()


def sphinx(builder: str, out: Path) -> None:
    # Every page is read anew: the sources are.
    command = [
        sys.executable,
        "-m",
        "sphinx",
        "-E",
        "-q",
        "-W",
        "--keep-going",
        "-b",
        builder,
        "-d",
        SITE / "doctrees",
        SOURCE,
        out,
    ]
    if subprocess.run(command, check=False).returncode:
        raise SystemExit("the documentation has warnings")


class Page(HTMLParser):
    def __init__(self, file: Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.feed(file.read_text())

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = dict(attributes)
        self.anchors |= {given[key] for key in ("id", "name") if given.get(key)}
        self.links += [given[key] for key in ("href", "src") if given.get(key)]


def check_links() -> int:
    """Of the HTML, every link within the site: the file is there, and the anchor in it. Returns how many there are."""
    pages = {file: Page(file) for file in HTML.rglob("*.html") if not file.is_relative_to(HTML / "viewer")}
    count, broken = 0, []
    for file, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            to = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            to = to / "index.html" if to.is_dir() else to
            anchor_lost = parts.fragment and to in pages and unquote(parts.fragment) not in pages[to].anchors
            if not to.exists() or anchor_lost:
                broken.append(f"{file.relative_to(HTML)}: {link}")
    if broken:
        raise SystemExit("links that lead nowhere:\n  " + "\n  ".join(sorted(set(broken))))
    return count


def main() -> None:
    if not PROGRAM.exists():
        raise SystemExit("build/release/brushfire is not built: ./run build")
    gather()
    if "--links" in sys.argv:
        sphinx("linkcheck", SITE / "links")
        return
    shutil.rmtree(HTML, ignore_errors=True)
    sphinx("html", HTML)
    links = check_links()
    pages = sum(1 for _ in HTML.rglob("*.html"))
    print(f"build/site/html/index.html: {pages} pages, {links} internal links, all of which lead somewhere")


if __name__ == "__main__":
    main()
