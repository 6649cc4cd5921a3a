"""The reference pages of the site, from what the code says about itself.

cpp(): public headers; cli(): --help; js(): index.d.ts. Each returns {path of a page: its Markdown}.
Python's pages stand in docs/reference/ and are filled in by autodoc.
"""

from __future__ import annotations

import inspect
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

import brushfire

ROOT = Path(__file__).parents[2]
ROOMS = {
    "core": "errors, progress, threads",
    "mesh": "meshes, places, what is in a mesh",
    "solvers": "distance fields",
    "queries": "what is read off a field",
    "io": "files",
    "figure": "pictures",
}


# ---- text of comments ------------------------------------------------------------------------------------------------
def prose(lines: list[str]) -> str:
    """Comment lines as Markdown: what is indented is code, names of functions are marked, the rest is escaped."""
    out, code = [], []

    def end_code() -> None:
        if code:
            out.extend(["", "```cpp", *code, "```", ""])
            code.clear()

    for line in lines:
        if line.startswith("    ") and line.strip():
            code.append(line[4:])
        else:
            end_code()
            out.append(escaped(line))
    end_code()
    return "\n".join(out).strip()


def escaped(line: str) -> str:
    parts = re.split(r"(`[^`]*`)", line)
    for i in range(0, len(parts), 2):
        plain = re.split(r"((?:\b\w+::)*\b\w+\(\)|\b(?:\w+::)+\w+\b|\b\w*\[\w+(?: \+ 1)?\](?:\[\w+\])*)", parts[i])
        plain[0::2] = [re.sub(r"([*_<\[\]|$])", r"\\\1", text) for text in plain[0::2]]
        plain[1::2] = [f"`{name}`" for name in plain[1::2]]
        parts[i] = "".join(plain)
    return "".join(parts)


@dataclass
class Item:
    """A declaration, or several of one name, with the comment before it; without code a remark between two."""

    name: str
    comment: list[str]
    code: list[str]


# ---- C++ -------------------------------------------------------------------------------------------------------------
def public_headers() -> list[str]:
    umbrella = (ROOT / "src/brushfire/brushfire.h").read_text()
    headers = re.findall(r"#include <brushfire/(\w+/\w+\.h)>", umbrella)
    if len(headers) < 40:
        raise SystemExit("reference.py: brushfire.h lists too few headers")
    return headers


def cpp_page(header: str) -> str:
    """The name of a header's page, from the reference's folder."""
    return "cpp/" + header.removesuffix(".h").replace("/", "-")


def opened(line: str) -> int:
    """By how much a line of code moves the depth of braces."""
    line = re.sub(r"//.*|\"(?:\\.|[^\"])*\"|'(?:\\.|[^'])'", "", line)
    return line.count("{") - line.count("}")


def cpp_items(text: str) -> list[Item]:
    """Of a header: declarations at the level of namespaces, each with the comment above it."""
    items: list[Item] = []
    comment: list[str] = []
    code: list[str] = []
    depth = 0

    def end() -> None:
        nonlocal comment, code
        if comment or code:
            items.append(Item(cpp_name(code), comment, code))
        comment, code = [], []

    for line in text.splitlines():
        if depth == 0:
            if re.match(r"(namespace\b.*\{|\}\s*// namespace.*|#.*)$", line) or re.match(
                r"(class|struct|enum class) \w+(?: : [\w:]+)?;$", line
            ):
                end()
                continue
            if not line.strip():
                end()
                continue
            if line.startswith("//"):
                if code:
                    end()
                comment.append(line[2:].removeprefix(" "))
                continue
        code.append(line)
        depth += opened(line)
    end()
    return merged(items)


def cpp_name(code: list[str]) -> str:
    text = " ".join(code)
    for pattern in (
        r"(?:class|struct|enum class|enum) (\w+)",
        r"using (\w+) =",
        r"(operator\W+?)\(",
        r"(\w+)\(",
        r"(\w+)(?:\{.*\})?\s*(?:=|;)",
    ):
        if found := re.search(pattern, text):
            return found[1]
    return ""


def merged(items: list[Item]) -> list[Item]:
    """Neighbours of one name under one heading."""
    out: list[Item] = []
    for item in items:
        if out and item.name and out[-1].name == item.name:
            out[-1].comment += ["", *item.comment] if item.comment else []
            out[-1].code += ["", *item.code] if item.comment else item.code
        else:
            out.append(item)
    return out


def cpp() -> dict[str, str]:
    headers = public_headers()
    pages = {}
    rows: dict[str, list[tuple[str, str]]] = {room: [] for room in ROOMS}
    for header in headers:
        text = (ROOT / "src/brushfire" / header).read_text()
        head, body = re.split(r"^#pragma once$", text, maxsplit=1, flags=re.MULTILINE)
        about = [line[2:].removeprefix(" ") for line in head.splitlines() if line.startswith("//")]
        name = header.split("/")[1]
        parts = [f"# {name}", prose(about), f"```cpp\n#include <brushfire/{header}>\n```"]
        for item in cpp_items(body):
            if item.name:
                parts.append(f"## `{item.name}`")
            if item.comment:
                parts.append(prose(item.comment))
            if item.code:
                parts.append("```cpp\n" + "\n".join(item.code) + "\n```")
        pages[f"reference/{cpp_page(header)}.md"] = "\n\n".join(parts) + "\n"
        first = re.split(r"(?<=[.;])\s", " ".join(about))[0]
        rows[header.split("/")[0]].append((header, first.rstrip(".;")))
    index = ["# C++", "Everything public is in `<brushfire/brushfire.h>`; these pages are its headers, one each."]
    for room, about in ROOMS.items():
        index += [
            f"## {room}/: {about}",
            "| header | what it is |\n|---|---|\n"
            + "\n".join(f"| [{header}]({cpp_page(header)}.md) | {escaped(first)} |" for header, first in rows[room]),
            "```{toctree}\n:hidden:\n" + "\n".join(cpp_page(header) for header, _ in rows[room]) + "\n```",
        ]
    pages["reference/cpp.md"] = "\n\n".join(index) + "\n"
    return pages


# ---- Python ----------------------------------------------------------------------------------------------------------
def python_rest() -> dict[str, str]:
    """What the pages in docs/reference/python/ do not name, so that a new class or function is never missing."""
    written = "".join(page.read_text() for page in (ROOT / "docs/reference/python").glob("*.md"))
    rest = [name for name in brushfire.__all__ if not name.startswith("_") and f"brushfire.{name}\n" not in written]
    lines = [
        f".. auto{'class' if inspect.isclass(getattr(brushfire, name)) else 'function'}:: brushfire.{name}"
        for name in rest
    ]
    body = "```{eval-rst}\n" + "\n".join(lines) + "\n```" if lines else "Nothing at present."
    return {"reference/python/more.md": f"# More of Python\n\n{body}\n"}


# ---- command line ----------------------------------------------------------------------------------------------------
def cli(program: Path) -> dict[str, str]:
    def help_of(*verb: str) -> str:
        return subprocess.run([program, *verb, "--help"], check=True, capture_output=True, text=True).stdout.strip()

    main = help_of()
    verbs = re.findall(r"^  ([a-z-]+) {2,}\S", main.split("\nVerbs:\n")[1].split("\n\n")[0], re.MULTILINE)
    if len(verbs) < 10:
        raise SystemExit("reference.py: brushfire --help lists too few verbs")
    parts = [
        "# Command line",
        "What `brushfire VERB --help` prints. `brushfire manual` prints manual pages, and `--json` of every verb is for programs.",
        f"```text\n{main}\n```",
    ]
    for verb in verbs:
        text = help_of(verb)
        title, _, rest = text.partition("\n")
        parts += [f"## {verb}", f"{title}.", f"```text\n{rest.strip()}\n```"]
    return {"reference/cli.md": "\n\n".join(parts) + "\n"}


# ---- JavaScript ------------------------------------------------------------------------------------------------------
def js_items(text: str) -> list[Item]:
    items: list[Item] = []
    comment: list[str] = []
    code: list[str] = []
    depth = 0
    inside = False
    for line in text.splitlines():
        if depth == 0 and not code:
            if line.startswith("/**"):
                inside = True
            if inside:
                comment.append(re.sub(r"^\s*/?\*+ ?|\s*\*/\s*$", "", line))
                inside = not line.rstrip().endswith("*/")
                continue
            if not line.strip() or line.startswith(("//", "import ")):
                continue
        code.append(line)
        depth += opened(line)
        is_type = re.match(r"(export )?(declare )?type\b", code[0])
        if depth == 0 and line.rstrip().endswith(";" if is_type else (";", "}")):
            found = re.search(r"(?:class|interface|type|function|const) (\w+)", " ".join(code))
            items.append(Item(found[1] if found else "", [c for c in comment if c.strip()], code))
            comment, code = [], []
    return merged(items)


def js() -> dict[str, str]:
    parts = [
        "# JavaScript",
        "The types of the npm package `brushfire`: `js/lib/index.d.ts`, declaration by declaration.",
    ]
    items = [item for item in js_items((ROOT / "js/lib/index.d.ts").read_text()) if item.code[0].startswith("export")]
    if len(items) < 20:
        raise SystemExit("reference.py: index.d.ts holds too few declarations")
    for item in items:
        parts += [f"## `{item.name}`", prose(item.comment), "```ts\n" + "\n".join(item.code) + "\n```"]
    return {"reference/js.md": "\n\n".join(part for part in parts if part) + "\n"}
