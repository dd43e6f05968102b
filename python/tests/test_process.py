"""Tests the module in new processes: import, threads, memory, signals, forks, exit."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import asdf_vk
from shapes import cube, dumbbell, sphere

_PREAMBLE = """
import hashlib, os, signal, sys, threading, time
import numpy as np
threads_of_numpy = len(os.listdir("/proc/self/task"))
import asdf_vk
from shapes import cube, dumbbell, sphere
signal.signal(signal.SIGINT, signal.default_int_handler)  # Background jobs of a shell ignore SIGINT.
"""


def run(code: str, timeout: float = 60, preamble: str = _PREAMBLE) -> subprocess.CompletedProcess[str]:
    """Runs code in a new process of the interpreter."""
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", preamble + textwrap.dedent(code)],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        capture_output=True,
        text=True,
        timeout=timeout,
    )


def output(code: str, timeout: float = 60) -> str:
    finished = run(code, timeout)
    assert finished.returncode == 0, finished.stderr
    return finished.stdout.strip()


def test_import_opens_nothing() -> None:
    code = """
    maps = open("/proc/self/maps").read()
    threads = len(os.listdir("/proc/self/task")) - threads_of_numpy
    print("vulkan" in maps, threads, len(os.listdir("/proc/self/fd")))
    """
    # The import opens no driver and starts no thread. The descriptors are the standard streams and the one of
    # listdir().
    assert output(code).split() == ["False", "0", "4"]


def test_without_a_vulkan_loader_the_message_has_the_reason() -> None:
    code = """
    try:
        asdf_vk.Session(backend="vulkan")
    except asdf_vk.DeviceError as error:
        print(error.code)
    print(asdf_vk.Session().backend in ("cpu", "reference"), asdf_vk.devices())
    """
    environment = dict(os.environ)
    try:
        os.environ["VK_DRIVER_FILES"] = os.environ["VK_ICD_FILENAMES"] = "/nonexistent.json"
        assert output(code).split() == ["noVulkanDriver", "True", "[]"]
    finally:
        os.environ.clear()
        os.environ.update(environment)


def test_threads_get_the_values_of_one_thread() -> None:
    meshes = [sphere(2), dumbbell(), cube(), sphere(3)]
    expected = [asdf_vk.shape_diameter(*mesh) for mesh in meshes]
    with ThreadPoolExecutor(8) as pool:
        results = list(pool.map(lambda i: (i, asdf_vk.shape_diameter(*meshes[i % 4])), range(64)))
    for i, values in results:
        np.testing.assert_array_equal(values, expected[i % 4])


def test_the_interpreter_goes_on_while_rays_are_traced() -> None:
    turns = 0
    done = threading.Event()

    def count() -> None:
        nonlocal turns
        while not done.is_set():
            turns += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    begin = time.monotonic()
    asdf_vk.shape_diameter(*sphere(5), seeds="all", rays=200)
    seconds = time.monotonic() - begin
    done.set()
    counter.join()
    assert turns > 50 * seconds


def test_calls_keep_the_memory() -> None:
    # Measured in a new process, because the heap of the process that runs the tests also changes for other reasons. A
    # leak grows in every block of calls; a single allocation of a library does not. TBB leaks only if the processors
    # are busy.
    code = """
    def resident_bytes():
        return int(open("/proc/self/statm").read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def calls(count):
        for i in range(count):
            asdf_vk.compute(*mesh)
            if i % 10 == 0:
                asdf_vk.segment(*mesh)
                try:
                    asdf_vk.shape_diameter(*mesh, rays=0)
                except asdf_vk.UsageError:
                    pass

    def keep_busy():
        while True:
            hashlib.pbkdf2_hmac("sha256", b"", b"", 1000000)

    for _ in range(2 * os.cpu_count()):
        threading.Thread(target=keep_busy, daemon=True).start()
    mesh = sphere(2)
    calls(100)
    growth = []
    for block in range(4):
        before = resident_bytes()
        calls(225)
        growth.append(resident_bytes() - before)
    print(min(growth))
    """
    assert int(output(code)) <= 64 << 10


def test_progress_and_cancellation() -> None:
    reports: list[Any] = []
    asdf_vk.shape_diameter(*sphere(5), seeds="all", rays=100, progress=lambda *report: reports.append(report))
    fractions = [fraction for fraction, _ in reports]
    assert fractions == sorted(fractions) and fractions[-1] == 1
    assert "trace" in [stage for _, stage in reports]
    with pytest.raises(asdf_vk.CancelledError):
        asdf_vk.shape_diameter(*sphere(6), seeds="all", rays=300, progress=lambda fraction, stage: False)

    def fail(fraction: float, stage: str) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        asdf_vk.shape_diameter(*sphere(6), seeds="all", rays=300, progress=fail)
    assert np.isfinite(asdf_vk.shape_diameter(*cube())).all()


@pytest.mark.parametrize("backend", ["vulkan", "reference"])
def test_an_interrupt_ends_a_long_run(backend: str) -> None:
    code = f"""
    mesh = sphere(6)
    threading.Timer(1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    try:
        asdf_vk.shape_diameter(*mesh, seeds="all", rays=1024, backend="{backend}")
    except KeyboardInterrupt:
        print(time.monotonic() - begin < 3)
    print(np.isfinite(asdf_vk.shape_diameter(*cube(), backend="{backend}")).all())
    """
    assert output(code).split() == ["True", "True"]


def test_an_interrupt_ends_the_wait_for_another_thread() -> None:
    code = """
    session = asdf_vk.Session()
    cancelled = threading.Event()
    mesh = sphere(6)
    def long_run():
        try:
            asdf_vk.shape_diameter(
                *mesh, seeds="all", rays=1024, session=session, progress=lambda *_: not cancelled.is_set())
        except asdf_vk.CancelledError:
            print("cancelled")
    worker = threading.Thread(target=long_run)
    worker.start()
    time.sleep(0.5)
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    try:
        asdf_vk.shape_diameter(*cube(), session=session)
    except KeyboardInterrupt:
        print("interrupted")
    cancelled.set()
    worker.join()
    """
    assert output(code).split() == ["interrupted", "cancelled"]


@pytest.mark.parametrize("backend", ["vulkan", "cpu", "reference"])
def test_daemon_threads_end_with_the_script(backend: Literal["vulkan", "cpu", "reference"]) -> None:
    try:
        asdf_vk.Session(backend=backend)
    except asdf_vk.DeviceError as error:
        pytest.skip(str(error))
    # Four threads: the first one computes, the second one is in its callback, the third one raises, the fourth one
    # opens sessions.
    code = f"""
    def fail():
        try:
            asdf_vk.shape_diameter(*cube(), rays=0)
        except asdf_vk.UsageError:
            pass

    def repeat(call):
        while True:
            call()

    mesh = sphere(5)
    options = {{"seeds": "all", "rays": 300, "backend": "{backend}"}}
    calls = [
        lambda: asdf_vk.shape_diameter(*mesh, **options),
        lambda: asdf_vk.shape_diameter(*cube(), **options, progress=lambda *_: time.sleep(0.001)),
        fail,
        lambda: asdf_vk.Session(backend="{backend}"),
    ]
    for call in calls:
        threading.Thread(target=repeat, args=(call,), daemon=True).start()
    time.sleep(0.2)
    """
    finished = run(code)
    assert (finished.returncode, finished.stderr) == (0, "")


def test_the_import_by_a_sub_interpreter_is_a_clear_error() -> None:
    code = """
    try:
        import _interpreters as interpreters
    except ImportError:
        import _xxsubinterpreters as interpreters
    code = "try:\\n import asdf_vk\\nexcept ImportError as error:\\n print(error, flush=True)"
    interpreters.run_string(interpreters.create(), code)
    """
    finished = run(code, preamble="")
    assert finished.returncode == 0 and "interpreters" in finished.stdout, finished


def test_a_fork_before_the_first_use() -> None:
    code = """
    children = []
    for _ in range(2):
        child = os.fork()
        if child == 0:
            os._exit(0 if np.isfinite(asdf_vk.shape_diameter(*sphere(2))).all() else 1)
        children.append(child)
    print([os.waitpid(child, 0)[1] for child in children])
    print(np.isfinite(asdf_vk.shape_diameter(*sphere(2))).all())
    """
    assert output(code).splitlines() == ["[0, 0]", "True"]


@pytest.mark.parametrize("first", ["shape_diameter(*cube())", "read_mesh(path)", "devices()"])
def test_a_fork_after_the_first_use_is_a_clear_error(tmp_path: Path, first: str) -> None:
    path = tmp_path / "cube.ply"
    asdf_vk.write(path, cube())
    # The child ends like a normal program, not by os._exit(). The child must not hang when its sessions are destroyed.
    code = f"""
    path = {str(path)!r}
    result = asdf_vk.{first}
    child = os.fork()
    if child == 0:
        for call in (lambda: asdf_vk.shape_diameter(*cube()), lambda: asdf_vk.read_mesh(path), asdf_vk.Session):
            try:
                call()
                sys.exit(1)
            except asdf_vk.DeviceError as error:
                if error.code != "forkedProcess" or "spawn" not in str(error):
                    sys.exit(2)
        sys.exit(0)
    print(os.waitpid(child, 0)[1])
    print(np.isfinite(asdf_vk.shape_diameter(*cube())).all())
    """
    assert output(code).splitlines() == ["0", "True"]


def test_processes_that_are_spawned() -> None:
    code = """
    import multiprocessing
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        results = pool.starmap(asdf_vk.shape_diameter, [cube(), sphere(2)])
    print([len(values) for values in results])
    """
    assert output("if __name__ == '__main__':\n" + textwrap.indent(textwrap.dedent(code), "    ")) == "[12, 320]"


def test_results_and_errors_can_be_pickled() -> None:
    info = asdf_vk.compute(*sphere(2))
    copy = pickle.loads(pickle.dumps(info))
    assert copy.estimated_error == info.estimated_error and copy.stage_seconds == info.stage_seconds
    np.testing.assert_array_equal(copy.fields["sdf"], info.fields["sdf"])
    with pytest.raises(asdf_vk.Error) as caught:
        asdf_vk.shape_diameter(*cube(), backend="none")  # type: ignore[arg-type]
    error: Any = pickle.loads(pickle.dumps(caught.value))
    assert type(error) is asdf_vk.UsageError and error.code == "unknownName" and str(error) == str(caught.value)


def test_sessions() -> None:
    with asdf_vk.Session(backend="vulkan", threads=1) as session:
        assert session.backend == "vulkan" and session.device_lines and session.runs_on_cpu in (True, False)
        np.testing.assert_array_equal(
            asdf_vk.shape_diameter(*sphere(3), session=session), asdf_vk.shape_diameter(*sphere(3))
        )
        with pytest.raises(asdf_vk.UsageError):
            asdf_vk.shape_diameter(*cube(), session=session, backend="cpu")
    with pytest.raises(asdf_vk.UsageError, match="closed"):
        asdf_vk.shape_diameter(*cube(), session=session)
    for device in asdf_vk.devices():
        assert device.name and device.driver and isinstance(device.usable, bool)
