"""Base class of the cluster software under test."""

from __future__ import annotations

import abc
import dataclasses
import os
import pathlib
import shutil
import subprocess
from collections.abc import Callable, Sequence

from daemons import Daemons, kill, processes_with, wait_until
from meshes import OPTIONS, SOME_FAILED, Tree

PROCESS_LIMIT_SECONDS = 60
RECIPES = pathlib.Path("docs/examples/cluster").resolve()


@dataclasses.dataclass(frozen=True)
class Surroundings:
    program: pathlib.Path  # The program asdf-vk.
    folder: pathlib.Path  # The folder build/cluster.
    tree: Tree


@dataclasses.dataclass(frozen=True)
class Event:
    """An interruption of the first run."""

    share: float  # The interruption happens when this share of the results exists.
    what: str
    happen: Callable[[], None]


class Engine(abc.ABC):
    """Cluster software. Files of the software are in `folder`, which is new."""

    name: str

    def __init__(self, surroundings: Surroundings, folder: str) -> None:
        self.folder = surroundings.folder / folder
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self._surroundings = surroundings
        self._daemons = Daemons(self.folder)
        self._environment = dict(os.environ)
        self._environment["PATH"] = os.pathsep.join(
            [str(surroundings.program.parent), "/usr/sbin", "/usr/bin", "/sbin", "/bin"])

    @abc.abstractmethod
    def version(self) -> str: ...

    @abc.abstractmethod
    def start(self) -> None: ...

    @abc.abstractmethod
    def submit(self, results: pathlib.Path) -> subprocess.Popen[str]:
        """Starts the recipe. The process ends when all meshes are done."""

    @abc.abstractmethod
    def events(self, results: pathlib.Path) -> list[Event]:
        """The interruptions of the first run."""

    @staticmethod
    def process_of(results: pathlib.Path) -> int:
        """Returns the oldest process that computes shards into this folder."""
        found: list[int] = []

        def find() -> bool:
            found[:] = processes_with("asdf-vk", f"{results}/log/")
            return bool(found)

        wait_until(find, "a process of asdf-vk", PROCESS_LIMIT_SECONDS)
        return found[0]

    def kill_process(self, results: pathlib.Path) -> None:
        while True:
            try:
                return kill(self.process_of(results))
            except ProcessLookupError:  # The process has ended in the meantime.
                continue

    def only_meshes_failed(self, code: int) -> bool:
        """Whether this exit code means that all valid meshes were computed."""
        return code == SOME_FAILED

    def stop(self) -> None:
        self._daemons.stop()

    @staticmethod
    def recipe(name: str) -> str:
        return str(RECIPES / name)

    def _start(self, name: str, command: Sequence[str], is_ready: Callable[[], bool]) -> None:
        self._daemons.start(name, command, self._environment, is_ready)

    def _output(self, *command: str) -> str:
        done = subprocess.run(command, env=self._environment, check=False, capture_output=True,
                              text=True)
        return done.stdout.strip()

    def _recipe(self, results: pathlib.Path, command: Sequence[str]) -> subprocess.Popen[str]:
        """Starts the command with the arguments that all recipes need."""
        arguments = [*command, str(self._surroundings.tree.list_file), str(results), *OPTIONS]
        with open(self.folder / "recipe.out", "a") as output:
            return subprocess.Popen(arguments, env=self._environment, cwd=self.folder, text=True,
                                    stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                                    start_new_session=True)
