"""Background programs of the test. All listen on the loopback interface only."""

from __future__ import annotations

import os
import pathlib
import signal
import socket
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence

HOST = "127.0.0.1"
POLL_SECONDS = 0.02
START_LIMIT_SECONDS = 60
STOP_LIMIT_SECONDS = 20


class Failed(Exception):
    """A failure of the test, with its reason."""


def free_ports(count: int) -> list[int]:
    sockets = [socket.create_server((HOST, 0)) for _ in range(count)]
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def wait_until(condition: Callable[[], bool], what: str, limit: float) -> None:
    end = time.monotonic() + limit
    while not condition():
        if time.monotonic() > end:
            raise Failed(f"{what} did not happen within {limit:.0f} s")
        time.sleep(POLL_SECONDS)


def answers(port: int) -> bool:
    with socket.socket() as probe:
        probe.settimeout(1)
        return probe.connect_ex((HOST, port)) == 0


def processes_with(program: str, argument: str) -> list[int]:
    """Returns ascending ids of the processes of `program` that have an argument which contains `argument`."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            arguments = (folder / "cmdline").read_text(errors="replace").split("\0")
        except OSError:  # The process ended.
            continue
        # In the process of a script, the first argument is the interpreter.
        names = [os.path.basename(one) for one in arguments[:2]]
        if program in names and any(argument in one for one in arguments):
            found.append(int(folder.name))
    return sorted(found)


def kill(process_id: int) -> None:
    """Stops the process before it is killed, so that its files do not change during the checks."""
    os.kill(process_id, signal.SIGSTOP)
    os.kill(process_id, signal.SIGKILL)


class Daemons:
    """Started programs. The output of the programs is written to files in `folder`."""

    def __init__(self, folder: pathlib.Path) -> None:
        self._folder = folder
        self._running: list[tuple[str, subprocess.Popen[bytes]]] = []

    def start(self, name: str, command: Sequence[str], environment: Mapping[str, str],
              is_ready: Callable[[], bool]) -> None:
        """Returns when the program is ready."""
        log = self._folder / f"{name}.out"
        with open(log, "wb") as output:
            process = subprocess.Popen(command, env=dict(environment), stdin=subprocess.DEVNULL,
                                       stdout=output, stderr=subprocess.STDOUT,
                                       start_new_session=True)
        self._running.append((name, process))
        end = time.monotonic() + START_LIMIT_SECONDS
        while not is_ready():
            if process.poll() is not None or time.monotonic() > end:
                lines = log.read_text(errors="replace").splitlines()
                raise Failed(f"{name} does not start ({log}): {' / '.join(lines[-3:])}")
            time.sleep(POLL_SECONDS)

    def stop(self) -> None:
        """Stops all programs, in reverse order of their start."""
        while self._running:
            _, process = self._running.pop()
            process.terminate()
            try:
                process.wait(STOP_LIMIT_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
