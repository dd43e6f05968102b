"""Counts the checks of a host program and prints them as one line, which scripts/test-hosts collects."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any, Callable

import numpy as np


def say(line: str) -> None:
    """Prints past the buffers of hosts that replace sys.stdout."""
    os.write(1, f"{line}\n".encode())


class Checks:
    def __init__(self, host: str) -> None:
        self.host, self.count, self.failed = host, 0, 0

    def that(self, what: str, holds: Any) -> None:
        self.count += 1
        if not holds:
            self.failed += 1
            say(f"{self.host}: FAILED: {what}")

    def same_bits(self, what: str, values: Any, path: Path) -> None:
        """Compares with an array of the command line; NaN has the same bits as NaN."""
        expected = np.load(path)
        found = np.ascontiguousarray(values, expected.dtype) if expected.dtype.kind != "f" else np.asarray(values)
        if found.shape != expected.shape or found.dtype != expected.dtype:
            return self.that(f"{what}: {found.dtype} {found.shape}, expected {expected.dtype} {expected.shape}", False)
        differing = np.count_nonzero(np.ascontiguousarray(found).view("u4") != expected.view("u4"))
        return self.that(f"{what}: {differing} of {len(expected)} values differ", differing == 0 and len(expected) > 0)

    def raises(self, what: str, error: type[Exception], call: Callable[[], Any], text: str) -> None:
        """The call has to raise `error`, with one line that has `text`."""
        try:
            call()
        except error as raised:
            message = str(raised)
            self.that(f"{what}: {message!r}", text in message and "\n" not in message.strip())
        else:
            self.that(f"{what}: no {error.__name__}", False)

    def picture(self, path: Path) -> None:
        """A PNG that is not empty."""
        data = path.read_bytes() if path.exists() else b""
        self.that(f"picture of {len(data)} bytes", data.startswith(b"\x89PNG") and len(data) > 5000)

    def finish(self) -> None:
        """Ends the process without the destructors of the host, some of which fail at exit."""
        say(f"\nchecks: {self.host}: {self.count} checks, {self.failed} failed")
        sys.stderr.flush()
        os._exit(1 if self.failed else 0)
