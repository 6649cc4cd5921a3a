"""Holds the numbers of the documentation against what was measured: python tools/site/measured.py [--write]

In a page, `0.03 %<!-- =methods.meshes.bunny.methods.windows.mean -->` is that entry of docs/measured/methods.json, rounded
to as many digits as stand there; --write puts in what is measured now. A unit after the number converts: % ms us s.
`<!-- =python-peers: SECTION / ROW / COLUMN -->` is a cell of a measured page (benchmarks, python-peers).
"""

from __future__ import annotations

import functools
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
UNITS = {"%": 100.0, "ms": 1e3, "us": 1e6, "µs": 1e6, "s": 1.0, "": 1.0}
MARK = re.compile(
    r"(?P<number>-?\d[\d,]*(?:\.\d+)?(?:e-?\d+)?)(?P<gap> ?)(?P<unit>%|ms|us|µs|s)?(?P<mark> ?<!-- =(?P<key>[^>]*?) -->)"
)


@functools.cache
def measured(name: str) -> dict:
    return json.loads((ROOT / "docs/measured" / f"{name}.json").read_text())


def entry(key: str) -> float:
    """A number in its own unit: seconds, shares, counts."""
    if ": " in key:
        return cell(*key.split(": ", 1))
    name, *path = key.split(".")
    value = measured(name)
    for step in path:
        value = value[int(step)] if isinstance(value, list) else value[step]
    return float(value)


@functools.cache
def tables(page: str) -> dict[tuple[str, str, str], str]:
    """Of a measured page: what stands in each (section, row, column)."""
    cells, section, columns = {}, "", []
    for line in (ROOT / "docs" / f"{page}.md").read_text().splitlines():
        if line.startswith("#"):
            section, columns = line.lstrip("# "), []
        elif line.startswith("|"):
            row = [text.strip(" *`") for text in line.strip("|").split("|")]
            if not columns:
                columns = row
            elif not re.fullmatch(r"[|: -]+", line):
                cells |= {(section, row[0], column): text for column, text in zip(columns[1:], row[1:], strict=False)}
        else:
            columns = []
    return cells


def cell(page: str, path: str) -> float:
    section, row, column = (part.strip() for part in path.split(" / "))
    text = tables(page)[section, row, column]
    number, percent = re.match(r"(-?[\d.]+(?:e-?\d+)?)( ?%)?", text).groups()
    return float(number) / 100 if percent else float(number)


def as_it_stands(number: str, value: float) -> str:
    """The value with the digits that the number in the text has."""
    plain = number.replace(",", "")
    if "e" in plain:
        digits = len(plain.split("e")[0].replace(".", "").lstrip("-"))
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    decimals = len(plain.split(".")[1]) if "." in plain else 0
    significant = len(plain.replace(".", "").lstrip("-0"))
    # A number that was 20 and is 23 now stands as rounded as before.
    zeros = len(plain) - len(plain.rstrip("0")) if not decimals else 0
    rounded = round(value, decimals or -zeros)
    if decimals and rounded == 0 and significant:
        rounded, decimals = float(f"{value:.{max(significant, 1)}g}"), 12
        return f"{rounded:.12f}".rstrip("0")
    rounded += 0.0  # not -0
    return f"{rounded:,.{decimals}f}" if "," in number else f"{rounded:.{decimals}f}"


def main() -> None:
    write = "--write" in sys.argv
    count, wrong = 0, []
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        text = page.read_text()

        def held(match: re.Match[str], page: Path = page) -> str:
            nonlocal count
            count += 1
            try:
                value = entry(match["key"]) * UNITS[match["unit"] or ""]
            except (KeyError, IndexError, FileNotFoundError, ValueError) as error:
                wrong.append(f"{page.relative_to(ROOT)}: nothing was measured as {match['key']} ({error!r})")
                return match[0]
            now = as_it_stands(match["number"], value)
            if now != match["number"]:
                wrong.append(
                    f"{page.relative_to(ROOT)}: {match['number']} {match['unit'] or ''} is {now} in {match['key']} ({value:g})"
                )
            return now + match["gap"] + (match["unit"] or "") + match["mark"]

        after = MARK.sub(held, text)
        marks = text.count("<!-- =")
        if marks != len(MARK.findall(text)):
            wrong.append(f"{page.relative_to(ROOT)}: a mark without a number before it")
        if write and after != text:
            page.write_text(after)
    if write:
        print(f"{count} numbers, {len(wrong)} of which were others before")
        return
    for line in wrong:
        print(line)
    if wrong:
        raise SystemExit(
            f"{len(wrong)} of {count} numbers are not those that were measured: ./run docs numbers --write"
        )
    print(f"{count} numbers of the documentation are those that were measured")


if __name__ == "__main__":
    main()
