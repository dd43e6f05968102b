"""Exceptions: one class per kind of error. Each exception has the error code of the library."""

from __future__ import annotations

from typing import Any

from . import _core


class Error(Exception):
    """Base of all errors of asdf_vk.

    code: name of the error, for example "indexOutOfRange" (include/asdf_vk/error.h).
    details: named values that occur in the message.
    """

    def __init__(self, message: str, code: str, details: dict[str, str] | None = None) -> None:
        super().__init__(message)
        self.code = code
        self.details = dict(details or {})

    def __reduce__(self) -> tuple[Any, ...]:
        return error_of, (self.code, str(self), self.details)


class UsageError(Error, ValueError):
    """An option is unknown, is out of range, or contradicts another option."""


class InputError(Error, ValueError):
    """A mesh or an array cannot be used, or there is nothing to compute on."""


class ArrayTypeError(InputError, TypeError):
    """The elements of an array have an unsupported type."""


class DeviceError(Error, RuntimeError):
    """There is no usable device, the device was lost, or the mesh exceeds a limit of the device."""


class OutputError(Error, OSError):
    """A result cannot be written."""

    def __str__(self) -> str:  # The __str__ of OSError would print an error number.
        return str(self.args[0])


class CancelledError(Error):
    """The progress callback returned False."""


class MeshWarning(UserWarning):
    """A property of the mesh or of its values may affect the results.

    code: name of the warning, for example "missingValues" (docs/formats.md).
    """

    def __init__(self, message: str, code: str) -> None:
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[Any, ...]:
        return MeshWarning, (str(self), self.code)


_CLASS_OF_KIND: dict[str, type[Error]] = {
    "usage": UsageError,
    "input": InputError,
    "device": DeviceError,
    "output": OutputError,
    "cancelled": CancelledError,
}


def error_of(code: str, message: str, details: dict[str, str] | None = None) -> Error:
    """Returns the exception for an error code. Joins the lines of the message, because a repr() can have several."""
    message = " ".join(line.strip() for line in message.splitlines())
    if code == "arrayType":
        return ArrayTypeError(message, code, details)
    return _CLASS_OF_KIND[_core.error_kinds[code]](message, code, details)
