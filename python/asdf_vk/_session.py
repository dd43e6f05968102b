"""Devices, sessions, and the default sessions of the free functions."""

from __future__ import annotations

import atexit
import os
import threading
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._errors import error_of
from ._keywords import SessionOptions
from ._options import check_names

if TYPE_CHECKING:
    from typing_extensions import Unpack


@dataclass(frozen=True)
class Device:
    """A Vulkan device of this machine."""

    name: str
    driver: str
    kind: str
    usable: bool
    reason: str
    """"chosen" for the default device. For other devices: why the device is rejected or ranks lower."""


def devices() -> list[Device]:
    """Returns the Vulkan devices of this machine. The list is empty if there is no Vulkan loader."""
    return [Device(**device) for device in _core.devices()]


class Session:
    """An open device with its pipelines, for any number of meshes.

    backend: "auto" (Vulkan if available, else the CPU), "vulkan", "cpu" (float32) or "reference" (double precision).
    device: index of a Vulkan device, or a part of its name. Empty: the device of the highest rank.
    require_gpu: raise DeviceError if no GPU is usable.
    threads: number of CPU threads; 0 means the number of cores. Results do not depend on this number.
    The value None means the default of an option.

    Any number of threads may use a session. A session runs one computation at a time. Raises DeviceError.
    """

    def __init__(self, **options: Unpack[SessionOptions]) -> None:
        check_names(options, SessionOptions.__annotations__)
        self._open: _core.Session | None = _core.Session(dict(options))

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
        """Whether the CPU traces: backend "cpu" or "reference", or a Vulkan device on the CPU."""
        return self._opened.runs_on_cpu

    def close(self) -> None:
        """Releases the device. If scenes of the session are open, the device is released after they are closed."""
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
    """Returns a bool; None becomes False. Raises UsageError for other types."""
    if value is not None and not isinstance(value, (bool, np.bool_)):
        raise error_of("optionOutOfRange", f"{name}={value!r} is not True or False")
    return bool(value)


def thread_count(threads: Any) -> int:
    """Checks and returns a number of CPU threads. 0 and None mean the number of cores."""
    return _core.session_key({"threads": threads})[3]


_default_sessions: dict[tuple[str, str, bool, int], Session] = {}
_default_sessions_lock = threading.Lock()


def _renew_lock() -> None:
    """Replaces the lock in a forked process, because the thread that holds the lock exists only in the parent."""
    global _default_sessions_lock
    _default_sessions_lock = threading.Lock()


os.register_at_fork(after_in_child=_renew_lock)


def default_session(**options: Any) -> Session:
    """Returns the default session for these options. Opens it at first use, and keeps it."""
    key = _core.session_key(options)
    with _default_sessions_lock:
        session = _default_sessions.get(key)
        if session is None:
            session = Session(**options)
            _default_sessions[key] = session
        return session


@atexit.register
def close_default_sessions() -> None:
    """Releases the devices of the default sessions. A later call of a free function opens them again."""
    with _default_sessions_lock:
        _default_sessions.clear()


def session_of(options: dict[str, Any]) -> Session:
    """Returns the session that the options name (`session`) or describe (`backend`, ...). Removes these options."""
    session = options.pop("session", None)
    given = {name: options.pop(name) for name in SessionOptions.__annotations__ if name in options}
    described = {name: value for name, value in given.items() if value is not None}
    if session is None:
        return default_session(**described)
    if described:
        raise error_of("optionConflict", f"{', '.join(described)} and a session exclude each other")
    if not isinstance(session, Session):
        raise error_of("optionOutOfRange", f"session={session!r} is not a Session")
    return session
