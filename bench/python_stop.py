"""Measures the delay between SIGINT and KeyboardInterrupt in calls of asdf_vk, at different moments of each call.

    PYTHONPATH=build/develop/python /usr/bin/python3 bench/python_stop.py MESH

Prints for each call: its duration, the median delay and the greatest delay.
"""

from __future__ import annotations

import os
import signal
import statistics
import sys
import threading
import time
import warnings
from typing import Any, Callable

import asdf_vk

MOMENTS = 12


def delay(call: Callable[[], Any], after: float) -> float | None:
    """Returns the seconds from the signal to the exception, or None if the call ended before the signal."""
    sent = 0.0

    def send() -> None:
        nonlocal sent
        sent = time.perf_counter()
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(after, send)
    timer.start()
    try:
        call()
        timer.cancel()
        timer.join()
        time.sleep(0.01)  # A signal that was sent just before the end of the call is received here.
    except KeyboardInterrupt:
        return time.perf_counter() - sent
    return None


def main() -> None:
    warnings.simplefilter("ignore")
    mesh = asdf_vk.read_mesh(sys.argv[1])
    print(f"{sys.argv[1]}, {mesh.face_count} faces")
    calls: dict[str, Callable[[], Any]] = {}
    for backend in ("vulkan", "cpu"):
        calls[f"all seeds, 300 rays, {backend}"] = lambda backend=backend: asdf_vk.shape_diameter(
            mesh, seeds="all", rays=300, backend=backend
        )
        calls[f"10 %, {backend}"] = lambda backend=backend: asdf_vk.shape_diameter(mesh, backend=backend)
    calls["thickness"] = lambda: asdf_vk.thickness(mesh)
    calls["parts"] = lambda: asdf_vk.segment(mesh)
    calls["segments of CGAL"] = lambda: asdf_vk.segment(mesh, method="cgal")
    for name, call in calls.items():
        begin = time.perf_counter()
        call()
        duration = time.perf_counter() - begin
        found = [delay(call, duration * (i + 0.5) / MOMENTS) for i in range(MOMENTS)]
        delays = [seconds for seconds in found if seconds is not None]
        print(f"{name}: {duration:.2f} s, delay median {statistics.median(delays):.3f}, greatest {max(delays):.3f} s")


if __name__ == "__main__":
    main()
