"""Random runs of asdf-vk, judged by oracles; scripts/fuzz-runs describes the options."""

from __future__ import annotations

import argparse
import pathlib
import sys
import time

import options
from batch_orders import run_orders
from program import Program
from runner import KINDS, run_case, run_until

def seconds_of(text: str) -> float:
    seconds = float(text)
    if not 0 <= seconds < float("inf"):
        raise argparse.ArgumentTypeError("not a number of seconds")
    return seconds


def main() -> int:
    parser = argparse.ArgumentParser(prog="scripts/fuzz-runs", description=__doc__)
    parser.add_argument("seconds", nargs="?", type=seconds_of, default=60.0)
    parser.add_argument("--seed", type=int, help="of the first case; default: by the clock")
    kinds_text = ", ".join(KINDS)
    parser.add_argument(
        "--only", metavar="KIND,...", default=",".join(KINDS), help="some of: " + kinds_text
    )
    parser.add_argument("--case", metavar="KIND:SEED", help="one case again, whose files are kept")
    parser.add_argument("--batch", metavar="FOLDER", type=pathlib.Path, help="its meshes in ten orders")
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--generate", type=pathlib.Path, required=True)
    parser.add_argument("--random-solid", type=pathlib.Path, required=True)
    parser.add_argument(
        "--folder", type=pathlib.Path, required=True, help="for the files of findings"
    )
    arguments = parser.parse_args()
    program = Program(
        arguments.program.resolve(), arguments.generate.resolve(), arguments.random_solid.resolve()
    )
    folder = arguments.folder.resolve()

    if arguments.case:
        kind, _, text = arguments.case.partition(":")
        if kind not in KINDS or not text.isdigit():
            parser.error(f"--case {arguments.case}: give KIND:SEED, KIND one of {kinds_text}")
        findings = run_case(program, kind, int(text), folder / f"{kind}-{text}").findings
        print("\n".join(findings) or "no finding", f"\nfiles: {folder / f'{kind}-{text}'}")
        return 1 if findings else 0

    seed = arguments.seed if arguments.seed is not None else int(time.time()) * 1000
    if arguments.batch:
        findings = run_orders(program, arguments.batch, seed, folder / f"batch-{seed}")
        print("\n".join(findings) or "no finding")
        return 1 if findings else 0

    kinds = arguments.only.split(",")
    if unknown := set(kinds) - KINDS.keys():
        parser.error(f"--only: unknown {', '.join(sorted(unknown))}; the kinds are {kinds_text}")
    if difference := options.missing_in_tables(program.help()):
        parser.error(f"options.py and --help=all differ by {', '.join(sorted(difference))}")
    print(f"fuzz-runs: {arguments.seconds:g} s from seed {seed}", flush=True)
    summary = run_until(time.monotonic() + arguments.seconds, program, kinds, seed, folder)
    summary.print()
    return 1 if summary.findings else 0


if __name__ == "__main__":
    sys.exit(main())
