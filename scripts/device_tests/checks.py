"""Checks of an implementation: suites, the matrix of variants, runs with validation layers."""

from __future__ import annotations

import dataclasses
import enum
import itertools
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess

from implementations import Implementation, Surroundings, ValidationLayer

# Beginning of the name of a test case. The case checks that the validation layers report errors.
CONTROL = "control: the validation layers"
SUITE_LIMIT_SECONDS = 1800
RUN_LIMIT_SECONDS = 180

KERNELS = ("seed", "ray", "packet")
FETCHES = ("storage", "texel")
# Errors that mean that the device does not support a variant.
REFUSALS = ("deviceLimit", "kernelUnsupported")
# Rays per cone, and the greatest number of seeds. All seeds are checked.
RAY_COUNTS = {30: 1000, 1024: 32}
FURTHER_OPTIONS = (("--solver", "cg"), ("--solver", "jacobi"))


class Status(enum.Enum):
    PASSED = "passed"
    REFUSED = "refused"
    FAILED = "failed"


@dataclasses.dataclass(frozen=True)
class Outcome:
    what: str
    status: Status
    detail: str  # Reason of a refusal or failure.
    command: str  # Command that repeats the run.


@dataclasses.dataclass(frozen=True)
class Mesh:
    path: pathlib.Path
    face_count: int


@dataclasses.dataclass(frozen=True)
class _Ended:
    code: int  # Exit code; -N if signal N ended the process.
    output: str
    error: str


class Checks:
    """Runs checks on one implementation. Logs are written to `folder`."""

    def __init__(
        self, surroundings: Surroundings, implementation: Implementation, layer: ValidationLayer
    ) -> None:
        self._surroundings = surroundings
        self._implementation = implementation
        self._layer = layer
        self._logs = surroundings.folder / "logs"
        self._logs.mkdir(parents=True, exist_ok=True)

    def suite(self, name: str) -> Outcome:
        """Runs a test suite. The outcome lists the failed test cases."""
        command = [str(self._surroundings.build / f"tests/asdfvk-test-{name}")]
        command.append("--source-file-exclude=*real_meshes_test.cpp")
        ended = self._run(command, self._layer.environment, SUITE_LIMIT_SECONDS)
        log = self._logs / f"{self._implementation.name}-{name}.log"
        log.write_text(ended.output + ended.error)
        repeat = self._shown(command, self._layer.environment)
        if ended.code == 0:
            return Outcome(name, Status.PASSED, "", repeat)
        cases = "; ".join(_failed_cases(ended.output))
        detail = f"{_how_it_ended(ended.code)}{': ' if cases else ''}{cases} ({log})"
        return Outcome(name, Status.FAILED, detail, repeat)

    def matrix(self, meshes: list[Mesh]) -> list[Outcome]:
        """Runs all variants and the default variant. A device may refuse variants, except the default variant."""
        cells = itertools.product(meshes, RAY_COUNTS, [(), *_variants()])
        return [self._computation(mesh, rays, variant, {}) for mesh, rays, variant in cells]

    def validated(self, mesh: Mesh) -> list[Outcome]:
        """Runs each variant and each further option with validation. A message of the validation layer is an error."""
        environment = {**self._layer.environment, "ASDF_VK_VALIDATION": "1"}
        cells = (*_variants(), *FURTHER_OPTIONS)
        return [self._computation(mesh, 30, options, environment) for options in cells]

    def _computation(
        self, mesh: Mesh, rays: int, options: tuple[str, ...], environment: dict[str, str]
    ) -> Outcome:
        seeds = min(RAY_COUNTS[rays], mesh.face_count)
        result = str(self._surroundings.folder / "result.npy")
        command = [self._surroundings.program, str(mesh.path), "--backend", "vulkan"]
        command += ["--seeds", str(seeds), "--rays", str(rays), f"--check={seeds}"]
        command += ["--json", "--quiet", "-o", result, *options]
        ended = self._run(command, environment, RUN_LIMIT_SECONDS)
        status, detail = _judge(ended, options)
        what = " ".join([mesh.path.name, str(rays), "rays", *options])
        return Outcome(what, status, detail, self._shown(command, environment))

    def _run(self, command: list[str], environment: dict[str, str], limit: float) -> _Ended:
        variables = self._surroundings.environment(self._implementation.environment, environment)
        with subprocess.Popen(
            [*self._implementation.wrapper, *command],
            env=variables,
            text=True,
            errors="replace",
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        ) as process:
            try:
                output, error = process.communicate(timeout=limit)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                output, error = process.communicate()
                return _Ended(-signal.SIGKILL, output, f"{error}\nno end within {limit:.0f} s")
            except BaseException:
                os.killpg(process.pid, signal.SIGKILL)
                raise
        return _Ended(process.returncode, output, error)

    def _shown(self, command: list[str], environment: dict[str, str]) -> str:
        variables = {**self._implementation.environment, **environment}
        settings = [f"{name}={value}" for name, value in variables.items()]
        return shlex.join(["env", *settings, *self._implementation.wrapper, *command])


def _variants() -> list[tuple[str, ...]]:
    return [
        ("--kernel", kernel, "--fetch", fetch)
        for kernel, fetch in itertools.product(KERNELS, FETCHES)
    ]


def _judge(ended: _Ended, options: tuple[str, ...]) -> tuple[Status, str]:
    try:
        report = json.loads(ended.output)
    except ValueError:
        report = {}
    if ended.code == 0:
        check = report.get("check") or {}
        if not all(check.get(name) for name in ("passed", "independent", "tracedCount")):
            return Status.FAILED, "exit code 0 without a check that passed"
        choice = report["traceChoice"]
        for name, option in (("kernel", "--kernel"), ("fetch", "--fetch")):
            if option in options and choice[name] != options[options.index(option) + 1]:
                return Status.FAILED, f"another variant ran: {choice}"
        return Status.PASSED, ""
    reason = report.get("error") or (ended.error.strip().splitlines() or [""])[-1]
    if ended.code == 3 and "--kernel" in options and report.get("code") in REFUSALS:
        return Status.REFUSED, f"{report['code']}: {reason}"
    return Status.FAILED, f"{_how_it_ended(ended.code)}: {reason}"


def _how_it_ended(code: int) -> str:
    return f"exit code {code}" if code >= 0 else f"ended by {signal.Signals(-code).name}"


def _failed_cases(output: str) -> list[str]:
    """Returns the names of failed cases from doctest's output. doctest prints the name before the first error."""
    failed: dict[str, None] = {}
    case = ""
    for line in output.splitlines():
        if line.startswith("TEST CASE:"):
            case = line.removeprefix("TEST CASE:").strip()
        elif re.search(r": (FATAL )?ERROR: ", line):
            failed[case] = None
    return list(failed)

