"""The scripts of the documentation site find what is wrong: in code blocks, numbers, headers."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tools/site"))
import blocks
import measured
import reference


def found(tmp_path, monkeypatch, text):
    monkeypatch.setattr(blocks, "ROOT", tmp_path)
    page = tmp_path / "page.md"
    page.write_text(text)
    return blocks.blocks_of(page)


def test_a_block_has_the_output_that_follows_and_its_reason_not_to_run(tmp_path, monkeypatch):
    shown, left_out, hidden = found(
        tmp_path,
        monkeypatch,
        "```python\nprint(1)\n```\n\n```text\n1\n```\n\n<!-- not run: no network -->\n```sh\ncurl x\n```\n"
        "<!-- run: python\nx = 1\n-->\n",
    )
    assert (shown.text, shown.expected, shown.reason) == ("print(1)", "1", None)
    assert left_out.reason == "no network"
    assert hidden.hidden and hidden.text == "x = 1"


def test_text_after_words_is_no_output(tmp_path, monkeypatch):
    (block,) = found(tmp_path, monkeypatch, "```python\nprint(1)\n```\n\nAnother thing:\n\n```text\n2\n```\n")
    assert block.expected is None


def test_a_language_that_nobody_runs_needs_a_reason(tmp_path, monkeypatch):
    with pytest.raises(blocks.Failure, match="page.md:1: nobody runs a block of rust"):
        found(tmp_path, monkeypatch, "```rust\n```\n")


def test_output_is_compared_but_for_dots():
    blocks.compare("took ... ms, 3 faces", "took 17 ms,  3 faces\n")
    with pytest.raises(blocks.Failure, match="prints something else"):
        blocks.compare("took ... ms, 3 faces", "took 17 ms, 4 faces")


def test_a_shell_block_fails_with_its_commands(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a session moves into its own folder
    scan = tmp_path / "scan.ply"
    scan.write_text("")
    session = blocks.Session(scan, {"PATH": "/usr/bin:/bin"})
    try:
        assert session.run(blocks.Block("page.md", 1, "sh", "false  # exit code 1: it says no\necho on")) == "on\n"
        with pytest.raises(blocks.Failure, match="exit code 1"):
            session.run(blocks.Block("page.md", 1, "sh", "false\necho on"))
        with pytest.raises(blocks.Failure):
            session.run(blocks.Block("page.md", 1, "sh", "true  # exit code 1: so it is said"))
    finally:
        monkeypatch.chdir(tmp_path)
        session.close()


@pytest.mark.parametrize(
    ("stands", "value", "now"),
    [
        ("0.003", 0.0033, "0.003"),
        ("0.02", 0.0174, "0.02"),
        ("1,513", 1513.4, "1,513"),
        ("49", 51.2, "51"),
        ("2.7e-12", 2.68e-12, "2.7e-12"),
        ("0.00", -0.0015, "0.00"),
        ("0.003", 0.00004, "0.00004"),
        ("340", 337, "340"),
    ],
)
def test_a_number_is_rounded_as_it_stands(stands, value, now):
    assert measured.as_it_stands(stands, value) == now


def test_a_cell_of_a_measured_page_is_a_number():
    assert measured.entry("python-peers: stanford-bunny: 34834 vertices / brushfire, exact / solve") > 0
    with pytest.raises(KeyError):
        measured.entry("python-peers: no such section / a / b")


def test_declarations_keep_the_comment_above_them():
    items = reference.cpp_items(
        "\n#include <vector>\n\nnamespace brushfire {\n\nstruct Later;\n\n// What it holds.\nstruct A {\n  int a;\n\n  // not a new item\n"
        "  int b;\n};\n\n// Adds.\nint add(int a);\nint add(int a, int b);\n// Takes.\nint take();\n\n}  // namespace brushfire\n"
    )
    assert [(item.name, item.comment) for item in items] == [
        ("A", ["What it holds."]),
        ("add", ["Adds."]),
        ("take", ["Takes."]),
    ]
    assert len(items[0].code) == 6 and len(items[1].code) == 2


def test_every_public_header_and_verb_has_a_page():
    pages = reference.cpp()
    assert len(pages) == len(reference.public_headers()) + 1
    assert "DistanceOptions" in pages["reference/cpp/solvers-distance.md"]
