"""A Dask cluster on the loopback interface: a scheduler and two workers."""

from __future__ import annotations

import os
import pathlib
import signal
import subprocess

import dask_function
import distributed

from daemons import HOST, Failed, answers, free_ports, kill
from engine import Engine, Event, Surroundings

WORKER_COUNT = 2
PYTHON = "/usr/bin/python3"  # The Python interpreter for which Debian's packages are installed.


class DaskCluster(Engine):
    name = "Dask"

    def __init__(self, surroundings: Surroundings) -> None:
        super().__init__(surroundings, "dask")
        self._file = self.folder / "scheduler.json"
        self._port = free_ports(1)[0]
        self._environment["DASK_CONFIG"] = str(self.folder / "settings")  # Ignores the user's settings.
        self._observer: distributed.Client | None = None
        self._client: subprocess.Popen[str] | None = None

    def version(self) -> str:
        return f"distributed {distributed.__version__}"

    def start(self) -> None:
        dask_function.check(self.folder, str(self._surroundings.program))
        recipe = self.recipe("dask_host.sh")
        self._start("scheduler", [recipe, "scheduler", str(self._file), "--host", HOST, "--port",
                                  str(self._port)], lambda: answers(self._port))
        # The script of the workers waits for the file of the scheduler. The client below waits for the workers.
        self._start("workers", [recipe, "workers", str(self._file), str(WORKER_COUNT), "--host",
                                HOST, "--local-directory", str(self.folder)], self._file.exists)
        file = str(self._file)
        self._observer = distributed.Client(scheduler_file=file)  # type: ignore[no-untyped-call]
        self._observer.wait_for_workers(WORKER_COUNT, timeout=60)

    def stop(self) -> None:
        if self._observer:
            self._observer.close()  # type: ignore[no-untyped-call]
        super().stop()

    def submit(self, results: pathlib.Path) -> subprocess.Popen[str]:
        command = [PYTHON, self.recipe("dask_batch.py"), str(self._file)]
        self._client = self._recipe(results, command)
        return self._client

    def events(self, results: pathlib.Path) -> list[Event]:
        return [Event(0.1, "SIGKILL to a worker", self._kill_worker),
                Event(0.4, "SIGKILL to the client", self._kill_client)]

    def _kill_worker(self) -> None:
        assert self._observer
        kill(min(self._observer.run(os.getpid).values()))

    def _kill_client(self) -> None:
        if self._client is None or self._client.poll() is not None:
            raise Failed("the client ended before it was killed")
        os.kill(self._client.pid, signal.SIGKILL)
