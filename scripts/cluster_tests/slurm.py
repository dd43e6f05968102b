"""A Slurm cluster of one node on the loopback interface. The settings of all daemons are below build/cluster."""

from __future__ import annotations

import getpass
import os
import pathlib
import secrets
import subprocess

from daemons import Failed, answers, free_ports, wait_until
from engine import Engine, Event, Surroundings

NODE = "localhost"
CPU_COUNT = 2
TASK_COUNT = 6
MAX_SOCKET_PATH = 107  # Greatest length of the path of a socket in Linux.

_CONFIGURATION = """
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={controller_port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={socket}
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc={folder}/jobs.txt
ReturnToService=2
SlurmdParameters=config_overrides
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName={node} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes={node} Default=YES State=UP
"""


class Slurm(Engine):
    name = "Slurm array"

    def __init__(self, surroundings: Surroundings) -> None:
        super().__init__(surroundings, "slurm")
        self._environment["SLURM_CONF"] = str(self.folder / "slurm.conf")
        self._ports = free_ports(2)

    def version(self) -> str:
        return self._output("slurmctld", "-V")

    def start(self) -> None:
        socket = self.folder / "munge"
        if len(str(socket)) > MAX_SOCKET_PATH:
            raise Failed(f"the path of a socket is longer than {MAX_SOCKET_PATH} bytes: {socket}")
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(secrets.token_bytes(1024))
        (self.folder / "slurm.conf").write_text(_CONFIGURATION.format(
            user=getpass.getuser(), folder=self.folder, socket=socket, node=NODE, cpus=CPU_COUNT,
            controller_port=self._ports[0], node_port=self._ports[1]))
        # --force accepts the folder build, whose parent folders may have any permissions.
        munged = ["munged", "--foreground", "--force", f"--key-file={key}", f"--socket={socket}"]
        munged += [f"--{name}-file={self.folder}/munge.{name}" for name in ("pid", "log", "seed")]
        self._start("munged", munged, socket.exists)
        self._start("slurmctld", ["slurmctld", "-D"], lambda: answers(self._ports[0]))
        self._start("slurmd", ["slurmd", "-D", "-N", NODE], self._is_idle)

    def submit(self, results: pathlib.Path) -> subprocess.Popen[str]:
        command = ["sbatch", "--wait", f"--array=1-{TASK_COUNT}"]
        command += [f"--output={self.folder}/task-%A-%a.out"]
        return self._recipe(results, [*command, self.recipe("slurm_array.sh"), str(TASK_COUNT)])

    def events(self, results: pathlib.Path) -> list[Event]:
        return [Event(0.1, "SIGKILL to a task", lambda: self.kill_process(results)),
                Event(0.2, "scancel of a task", lambda: self._cancel(results))]

    def stop(self) -> None:
        if (self.folder / "slurm.conf").exists() and answers(self._ports[0]):
            subprocess.run(["scancel", f"--user={getpass.getuser()}"], env=self._environment,
                           check=False, capture_output=True)
            wait_until(lambda: self._output("squeue", "--noheader") == "", "the end of jobs", 60)
        super().stop()

    def _is_idle(self) -> bool:
        return self._output("sinfo", "--noheader", "--format=%t") == "idle"

    def _cancel(self, results: pathlib.Path) -> None:
        task = self.process_of(results)
        variables = pathlib.Path(f"/proc/{task}/environ").read_text().split("\0")
        values = dict(one.partition("=")[::2] for one in variables)
        name = f"{values['SLURM_ARRAY_JOB_ID']}_{values['SLURM_ARRAY_TASK_ID']}"
        subprocess.run(["scancel", name], env=self._environment, check=True)
