"""Fixtures: paths of the programs and of real meshes, which some tests need."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Iterator

import pytest

import asdf_vk


def _path_of(variable: str) -> Path:
    value = os.environ.get(variable)
    if not value:
        pytest.skip(f"{variable} is not set")
    return Path(value)


@pytest.fixture(scope="session")
def program() -> Path:
    return _path_of("ASDF_VK_PROGRAM")


@pytest.fixture(scope="session")
def mesh_folder() -> Path:
    """The folder of real meshes, with the subfolders models and psb."""
    return _path_of("ASDF_VK_MESH_DIR")


@pytest.fixture(scope="session")
def reference() -> Iterator[asdf_vk.Session]:
    """A session that needs no device."""
    with asdf_vk.Session(backend="reference") as session:
        yield session
