"""README.md and docs/*.md show what the programs print.

A block that is marked `console` has commands, `$ COMMAND`, and below each what it prints. The commands of a page run in
one new folder, in their order; so does one that the reader does not see: <!-- $ COMMAND -->. A word `...` of a page stands
for any text, and for any lines where it is alone. Text and counts are equal. Other numbers may differ by one unit of
their last digit or by a thousandth, since devices round differently; times are not compared.
The commands of all blocks have options that the programs know. The first rows of each table of bench/known_shapes.py are
in docs/accuracy.md. Functions and types that docs/architecture.md and CONTRIBUTING.md name exist, and so do the files
and headings that links name.

    ASDF_VK_PROGRAM=... ASDF_VK_GENERATE=... python3 -m unittest printed_output_test      # in this folder
"""

from __future__ import annotations

import difflib
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
NUMBER = re.compile(r"(?<![\w.])-?\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?")
TIME = re.compile(r" (?:s|ms|min)\b")
STEP = re.compile(r"^```console\n(.*?)^```$|^<!-- \$ (.*?) -->$", re.MULTILINE | re.DOTALL)


def steps_of(page: str) -> list[tuple[str, list[str]]]:
    """Commands with the lines that they print; of hidden commands the line `...`."""
    steps: list[tuple[str, list[str]]] = []
    for block, hidden in STEP.findall(page):
        if hidden:
            steps.append((hidden, ["..."]))
        for line in block.splitlines():
            if line.startswith("$ "):
                steps.append((line[2:], []))
            elif steps[-1][0].endswith("\\") and not steps[-1][1]:
                steps[-1] = (f"{steps[-1][0][:-1]} {line.strip()}", [])
            else:
                steps[-1][1].append(line)
    return steps


def is_near(shown: str, printed: str, after: str) -> bool:
    """after: the text behind the number in the page."""
    if TIME.match(after):
        return True
    mantissa, _, exponent = shown.replace(",", "").partition("e")
    decimals = len(mantissa.partition(".")[2])
    if not decimals and not exponent and not after.startswith((" %", "%")):
        return shown == printed
    value = float(f"{mantissa}e{exponent or 0}")
    unit = 10.0 ** (int(exponent or 0) - decimals)
    return abs(float(printed.replace(",", "")) - value) <= max(1.001 * unit, 1e-3 * abs(value))


def is_line(shown: str, printed: str) -> bool:
    pattern, ends, end = "", [], 0
    for found in re.finditer(rf"\.\.\.|{NUMBER.pattern}", shown):
        pattern += re.escape(shown[end : found.start()])
        end = found.end()
        if found[0] == "...":
            pattern += ".*"
        else:
            pattern += f"({NUMBER.pattern})"
            ends.append((found[0], shown[end:]))
    match = re.fullmatch(pattern + re.escape(shown[end:]), printed)
    return match is not None and all(is_near(text, value, after) for (text, after), value in zip(ends, match.groups()))


def is_output(shown: list[str], printed: list[str]) -> bool:
    if not shown:
        return not printed
    if shown[0] == "...":
        return any(is_output(shown[1:], printed[skipped:]) for skipped in range(len(printed) + 1))
    return bool(printed) and is_line(shown[0], printed[0]) and is_output(shown[1:], printed[1:])


def run(command: str, folder: Path) -> list[str]:
    programs = folder / ".programs"
    programs.mkdir(exist_ok=True)
    for name, variable in (("asdf-vk", "ASDF_VK_PROGRAM"), ("asdf-vk-generate", "ASDF_VK_GENERATE")):
        if not (programs / name).exists():
            (programs / name).symlink_to(Path(os.environ[variable]).resolve())
    environment = {**os.environ, "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}
    finished = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=120)  # fmt: skip
    return finished.stdout.splitlines()


class PagesTest(unittest.TestCase):
    def test_blocks_show_what_their_commands_print(self) -> None:
        count = 0
        for page in PAGES:
            with tempfile.TemporaryDirectory() as folder:
                for command, shown in steps_of(page.read_text()):
                    printed = run(command, Path(folder))
                    count += 1
                    with self.subTest(page=page.name, command=command):
                        difference = "\n".join(difflib.unified_diff(shown, printed, "page", "printed", lineterm=""))
                        self.assertTrue(is_output(shown, printed), f"\n{difference}")
        self.assertGreater(count, 3)

    def test_commands_have_options_that_exist(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            calls = ("asdf-vk --help=all", "asdf-vk-generate --help", "asdf-vk summarize --help",
                     "asdf-vk serve --help", "asdf-vk mcp --help")
            known = set(re.findall(r"--[a-z][a-z-]*", "\n".join("\n".join(run(call, Path(folder))) for call in calls)))
        self.assertIn("--thinner-than", known)
        for page in PAGES:
            for line in re.findall(r"^(?:    |\$ )?(asdf-vk(?:-generate)? [^|&;#\n]*)", page.read_text(), re.MULTILINE):
                unknown = set(re.findall(r"(?<!\S)--[a-z][a-z-]*", line)) - known
                self.assertFalse(unknown, f"{page.name}: {line}")


    def test_tables_of_known_shapes_have_the_rows_of_their_script(self) -> None:
        try:
            import numpy  # noqa: F401
        except ImportError:
            self.skipTest("no NumPy")
        script = [sys.executable, "-B", ROOT / "bench/known_shapes.py", "--faces", "1300", "--backend", "reference"]
        printed = subprocess.run(script, check=True, stdout=subprocess.PIPE, text=True).stdout
        page = (ROOT / "docs/accuracy.md").read_text().splitlines()
        begin = 0
        for line in filter(None, printed.splitlines()):  # In the same order as on the page.
            found = [at for at in range(begin, len(page)) if is_line(page[at], line)]
            self.assertTrue(found, f"docs/accuracy.md lacks, after line {begin}: {line}")
            begin = found[0] + 1


    def test_names_of_the_code_exist(self) -> None:
        folders = ("src", "include", "shaders", "tests", "python")
        files = [path for folder in folders for path in (ROOT / folder).rglob("*")]
        words = set()
        for path in files:
            if path.suffix in (".cpp", ".h", ".comp", ".glsl", ".txt", ".py", ".js"):
                words.update(re.findall(r"\w+", path.read_text(errors="replace")))
        missing = []
        for page in ("docs/architecture.md", "CONTRIBUTING.md"):
            for name in re.findall(r"`([A-Za-z]+(?:::\w+)*(?:\(\))?)`", (ROOT / page).read_text()):
                if re.search(r"[a-z][A-Z]|::|\(\)", name) and name[-4:] != "Case" and not set(name.rstrip("()").split("::")) <= words:
                    missing.append(f"{page}: {name}")
        self.assertEqual(missing, [])


    def test_links_lead_to_files_and_headings(self) -> None:
        def slugs(page: Path) -> set[str]:
            text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
            heads = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
            return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}

        wrong = []
        for page in [*PAGES, *(ROOT / name for name in ("CONTRIBUTING.md", "CHANGELOG.md", "bench/experiments.md"))]:
            for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
                if target.startswith("http"):
                    continue
                name, _, heading = target.partition("#")
                file = (page.parent / name) if name else page
                if not file.exists() or (heading and heading not in slugs(file)):
                    wrong.append(f"{page.name}: {target}")
        self.assertEqual(wrong, [])


class ComparisonTest(unittest.TestCase):
    """Wrong blocks are noticed."""

    SHOWN = ["mesh.ply: 19,956 faces", "  error   about 0.38 % of the range, 1.171", "...", "done in 0.33 s"]
    PRINTED = ["mesh.ply: 19,956 faces", "  error   about 0.39 % of the range, 1.1714", "one", "two", "done in 1.2 s"]

    def test_rounding_and_times_are_allowed(self) -> None:
        self.assertTrue(is_output(self.SHOWN, self.PRINTED))

    def test_other_text_counts_numbers_and_lines_are_not(self) -> None:
        for at, wrong in ((0, "mesh.ply: 19,957 faces"), (0, "mesh.ply: 19,956 vertices"),
                          (1, "  error   about 0.48 % of the range, 1.171"),
                          (1, "  error   about 0.38 % of the range, 1.175"), (4, "done in 0.33 m")):  # fmt: skip
            with self.subTest(wrong=wrong):
                self.assertFalse(is_output(self.SHOWN, self.PRINTED[:at] + [wrong] + self.PRINTED[at + 1 :]))
        self.assertFalse(is_output(self.SHOWN, self.PRINTED[:-1]))
        self.assertFalse(is_output(self.SHOWN, [*self.PRINTED, "more"]))

    def test_commands_of_blocks_and_hidden_ones_are_found(self) -> None:
        page = "<!-- $ make -->\n```console\n$ one \\\n    two\nout\n$ three\n```\n```\n$ no\n```\n"
        self.assertEqual(steps_of(page), [("make", ["..."]), ("one  two", ["out"]), ("three", [])])


if __name__ == "__main__":
    unittest.main()
