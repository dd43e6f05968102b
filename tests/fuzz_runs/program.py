"""Runs of asdf-vk, undisturbed or with a signal, and the commands that repeat them."""

from __future__ import annotations

import dataclasses
import pathlib
import random
import shlex
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import kept_json

LIMIT_SECONDS = 120  # Far beyond what any case takes.
# The exit codes of docs/options.md, without 70, the internal error.
DOCUMENTED_CODES = frozenset({0, 1, 2, 3, 4, 5, 6, 7, 8, 130})
RANDOM_SOLIDS = ("assembly", "doubled")
# Codes of one mesh that has a result.
RESULT_CODES = frozenset({0, 5, 6})


@dataclasses.dataclass(frozen=True)
class Ended:
    """How a run ended. code: negative is minus the signal, None a run beyond the limit."""

    command: str
    code: int | None
    output: bytes
    error: str
    seconds: float
    sent: tuple[int, ...] = ()


@dataclasses.dataclass(frozen=True)
class Signals:
    """Signals to send, each after so many seconds from the start."""

    moments: tuple[tuple[float, int], ...]


class Program:
    def __init__(
        self, asdf_vk: pathlib.Path, generate: pathlib.Path, random_solid: pathlib.Path
    ) -> None:
        self.asdf_vk = asdf_vk
        self.generate = generate
        self.random_solid = random_solid

    def run(
        self,
        arguments: list[str],
        folder: pathlib.Path,
        signals: Signals | None = None,
        file_limit: int | None = None,
    ) -> Ended:
        """Runs asdf-vk in the folder, and notes the command there. file_limit: bytes of a file."""
        command = [str(self.asdf_vk), *arguments]
        if file_limit is not None:
            command = ["prlimit", f"--fsize={file_limit}", *command]
        text = shlex.join(command)
        moments = signals.moments if signals else ()
        note = "".join(f"  # signal {number} after {s:.3f} s" for s, number in moments)
        with (folder / "commands.sh").open("a", encoding="utf-8") as commands:
            commands.write(text + note + "\n")
        return _run(command, folder, text, signals)

    def help(self) -> str:
        return subprocess.run(
            [str(self.asdf_vk), "--help=all"], capture_output=True, text=True, check=True
        ).stdout

    def make(self, arguments: list[str], output: pathlib.Path) -> None:
        """Runs the program that makes the shape or solid, which must succeed."""
        program = self.random_solid if arguments[0] in RANDOM_SOLIDS else self.generate
        command = [str(program), *arguments, "--double", "-o", str(output)]
        subprocess.run(command, capture_output=True, check=True)


def random_signals(rng: random.Random, seconds: float) -> Signals:
    """One of the four signals, or two, at random moments of a run that takes about so long."""
    kinds = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL)
    count = 2 if rng.random() < 0.2 else 1
    moments = sorted(rng.uniform(0, 1.1 * seconds) for _ in range(count))
    return Signals(tuple((moment, int(rng.choice(kinds))) for moment in moments))


def _run(command: list[str], folder: pathlib.Path, text: str, signals: Signals | None) -> Ended:
    began = time.monotonic()
    process = subprocess.Popen(
        command,
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    sent: list[int] = []
    for moment, number in signals.moments if signals else ():
        try:
            process.wait(max(0.0, began + moment - time.monotonic()))
            break
        except subprocess.TimeoutExpired:
            process.send_signal(number)
            sent.append(number)
    code: int | None
    try:
        output, error = process.communicate(timeout=LIMIT_SECONDS)
        code = process.returncode
    except subprocess.TimeoutExpired:
        process.kill()
        output, error = process.communicate()
        code = None
    seconds = time.monotonic() - began
    if code is not None and code >= 0:
        kept_json.keep(output)
    return Ended(text, code, output, error.decode("utf-8", "replace"), seconds, tuple(sent))
