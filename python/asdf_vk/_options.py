"""Keyword options, with the names of the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Collection, Iterable, Literal, Optional, TypedDict

from . import _core
from ._errors import error_of
from ._keywords import ComputeOptions, SessionOptions

if TYPE_CHECKING:
    from ._session import Session

Progress = Callable[[float, str], Optional[bool]]


def checked_progress(progress: Any) -> Progress | None:
    """Returns the callback or None. Raises UsageError for any other value."""
    if progress is not None and not callable(progress):
        raise error_of("optionOutOfRange", f"progress={progress!r} is not callable")
    return progress


def check_names(names: Iterable[str], allowed: Collection[str]) -> None:
    """Raises UsageError for an option name that is not allowed, with a hint to similar names."""
    for name in names:
        if name not in allowed:
            similar = _core.similar_keywords(name, list(allowed))
            hint = f"; did you mean {similar}?" if similar else ""
            text = _core.removed_keyword_text(name) or f"there is no option '{name}'{hint}"
            raise error_of("unknownName", text, {"option": name})


class ConeOptions(TypedDict, total=False):
    """Options of Scene.at(), with the same meaning as in ComputeOptions."""

    definition: Literal["paper", "cgal"] | None
    rays: int | None
    cone_angle: float | None
    false_hit_angle: float | None
    outlier_deviations: float | None
    cone_rotation: Literal["fixed", "hashed"] | None


class CallOptions(TypedDict, total=False):
    """Options of every call."""

    progress: Progress | None
    """Called with the finished fraction of the whole call (0 to 1) and the name of the current stage, or "" before the
    first stage. If it returns False, CancelledError is raised.
    """


class PointOptions(ConeOptions, CallOptions, total=False):
    """Options of Scene.at()."""


class SceneOptions(ComputeOptions, CallOptions, total=False):
    """Options of the methods of Scene, except Scene.at()."""


class BackendOptions(SessionOptions, total=False):
    """The session of a call: `session`, or the default session for the given `backend`, `device` and so on."""

    session: Session | None


class FunctionOptions(SceneOptions, BackendOptions, total=False):
    """Options of the free functions."""
