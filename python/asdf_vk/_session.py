"""Devices, sessions, and the sessions of the free functions."""

from __future__ import annotations

import atexit
import os
import threading
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from ._errors import error_of


@dataclass(frozen=True)
class Device:
    """A Vulkan device of this machine."""

    name: str
    driver: str
    kind: str
    usable: bool
    reason: str
    """"chosen" for the default device. For other devices, the reason why the device is rejected or has a lower rank."""


def devices() -> list[Device]:
    """Returns the Vulkan devices of this machine; an empty list without a Vulkan loader."""
    return [Device(**device) for device in _core.devices()]


class Session:
    """A device with its pipelines, kept for any number of meshes.

    backend: "auto" (Vulkan, else the CPU), "vulkan", "cpu" (single precision) or "reference" (double precision).
    device: a Vulkan device, by index or by a part of its name; empty: the device of the highest rank.
    require_gpu: raise DeviceError if the CPU would trace.
    threads: number of CPU threads; 0: the number of cores. Results do not depend on the number.
    None stands for the default of an option.

    Any number of threads may use a session; one computation runs at a time. Raises DeviceError.
    """

    def __init__(
        self,
        *,
        backend: str | None = "auto",
        device: str | int | None = "",
        require_gpu: bool | None = False,
        threads: int | None = 0,
    ) -> None:
        self._open: _core.Session | None = _core.Session(
            {"backend": backend, "device": device, "require_gpu": require_gpu, "threads": threads}
        )

    @property
    def backend(self) -> str:
        """"vulkan", "cpu" or "reference"."""
        return self._opened.backend

    @property
    def device_lines(self) -> list[str]:
        """First line: the chosen device and the reason. Then one line per device that was not chosen."""
        return self._opened.device_lines

    @property
    def runs_on_cpu(self) -> bool:
        """Whether the CPU traces: "cpu", "reference", or a CPU device of Vulkan."""
        return self._opened.runs_on_cpu

    def close(self) -> None:
        """Releases the device. Open scenes of the session keep the device."""
        self._open = None

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        if self._open is None:
            return "<asdf_vk.Session, closed>"
        return f"<asdf_vk.Session, {self.device_lines[0]}>"

    @property
    def _opened(self) -> _core.Session:
        if self._open is None:
            raise error_of("optionConflict", "the session is closed")
        return self._open


def flag_of(value: Any, name: str) -> bool:
    """Returns a flag; False for None. Raises UsageError for other types."""
    if value is not None and not isinstance(value, (bool, np.bool_)):
        raise error_of("optionOutOfRange", f"{name}={value!r} is not True or False")
    return bool(value)


def thread_count(threads: Any) -> int:
    """Returns a checked number of CPU threads; 0 and None mean the number of cores."""
    return _core.session_key({"threads": threads})[3]


_default_sessions: dict[tuple[str, str, bool, int], Session] = {}
_default_sessions_lock = threading.Lock()


def _renew_lock() -> None:
    """Replaces the lock in a forked process, where the thread that holds it does not exist."""
    global _default_sessions_lock
    _default_sessions_lock = threading.Lock()


os.register_at_fork(after_in_child=_renew_lock)


def default_session(**options: Any) -> Session:
    """The session of the free functions for these options, opened at first use and kept."""
    key = _core.session_key(options)
    with _default_sessions_lock:
        session = _default_sessions.get(key)
        if session is None:
            session = Session(**options)
            _default_sessions[key] = session
        return session


@atexit.register
def close_default_sessions() -> None:
    """Releases the devices that the free functions use. A later call opens them again."""
    with _default_sessions_lock:
        _default_sessions.clear()


_BACKEND_OPTIONS = ("backend", "device", "require_gpu", "threads")


def session_of(options: dict[str, Any]) -> Session:
    """Returns the session that `options` name or describe, and removes these options."""
    session = options.pop("session", None)
    given = {name: options.pop(name) for name in _BACKEND_OPTIONS if name in options}
    described = {name: value for name, value in given.items() if value is not None}
    if session is None:
        return default_session(**described)
    if described:
        raise error_of("optionConflict", f"{', '.join(described)} and a session exclude each other")
    if not isinstance(session, Session):
        raise error_of("optionOutOfRange", f"session={session!r} is not a Session")
    return session
