"""GNU parallel over two hosts. The hosts are two names of this machine; each has a separate sshd."""

from __future__ import annotations

import os
import pathlib
import subprocess

from daemons import answers, free_ports
from engine import Engine, Event, Surroundings
from meshes import SOME_FAILED

SHARD_COUNT = 6
HOSTS = ("first", "second")

_SERVER = """
ListenAddress 127.0.0.1
Port {port}
HostKey {folder}/host_key
AuthorizedKeysFile {folder}/key.pub
PidFile none
StrictModes no
UsePAM no
PasswordAuthentication no
PermitRootLogin prohibit-password
SetEnv PATH="{path}"
"""
_CLIENT = """
Host {host}
  HostName 127.0.0.1
  Port {port}
  IdentityFile {folder}/key
  IdentitiesOnly yes
  UserKnownHostsFile {folder}/known_hosts
  StrictHostKeyChecking accept-new
  LogLevel ERROR
"""


class ParallelHosts(Engine):
    name = "GNU parallel over ssh"

    def __init__(self, surroundings: Surroundings) -> None:
        super().__init__(surroundings, "parallel")
        # Separate folders, so that GNU parallel does not use the settings and temporary files of the user.
        self._environment["PARALLEL_HOME"] = str(self.folder / "home")
        self._environment["PARALLEL_SSH"] = f"ssh -F {self.folder}/ssh_config"
        self._environment.pop("PARALLEL", None)

    def version(self) -> str:
        return self._output("parallel", "--version").splitlines()[0]

    def start(self) -> None:
        (self.folder / "home").mkdir()
        if os.getuid() == 0:  # If sshd runs as root, it needs this folder, which the init script normally makes.
            pathlib.Path("/run/sshd").mkdir(mode=0o755, exist_ok=True)
        for name in ("host_key", "key"):
            command = ["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", str(self.folder / name)]
            subprocess.run(command, check=True, stdin=subprocess.DEVNULL)
        client = ""
        for host, port in zip(HOSTS, free_ports(len(HOSTS))):
            configuration = self.folder / f"sshd_{host}.conf"
            configuration.write_text(_SERVER.format(folder=self.folder, port=port,
                                                    path=self._environment["PATH"]))
            client += _CLIENT.format(host=host, folder=self.folder, port=port)
            command = ["/usr/sbin/sshd", "-D", "-e", "-f", str(configuration)]
            self._start(f"sshd-{host}", command, lambda: answers(port))
        (self.folder / "ssh_config").write_text(client)
        (self.folder / "hosts").write_text("".join(f"1/{host}\n" for host in HOSTS))

    def submit(self, results: pathlib.Path) -> subprocess.Popen[str]:
        command = [self.recipe("parallel_hosts.sh"), str(self.folder / "hosts"), str(SHARD_COUNT)]
        return self._recipe(results, command)

    def events(self, results: pathlib.Path) -> list[Event]:
        return [Event(0.1, "SIGKILL to a process on a host", lambda: self.kill_process(results))]

    def only_meshes_failed(self, code: int) -> bool:
        """GNU parallel exits with the number of failed jobs."""
        results = self._surroundings.folder / f"results of {self.folder.name}"
        table = (results / "log/parallel.tsv").read_text().splitlines()
        column = table[0].split("\t").index("Exitval")
        codes = [int(line.split("\t")[column]) for line in table[1:]]
        failed = [one for one in codes if one]
        return len(codes) == SHARD_COUNT and len(failed) == code and set(failed) == {SOME_FAILED}
