"""Checks the walls of the meshes of a folder or a bucket on a Ray cluster, and writes a table:

python3 ray_batch.py MESHES RESULTS LIMIT

MESHES is a folder or an address such as s3://bucket/meshes. RESULTS gets Parquet files with a row per mesh. Each process
of Ray opens one session with one thread. A mesh that cannot be read is a row with its error.
"""

from __future__ import annotations

import sys
from typing import Any

import asdf_vk
import numpy as np


class Check:
    """Takes a batch with the columns `path` and `bytes`, and returns the columns of the table."""

    def __init__(self, **options: Any) -> None:
        self._options = options
        self._session = asdf_vk.Session(threads=1)

    def __call__(self, batch: dict[str, Any]) -> dict[str, np.ndarray]:
        rows = [self._row(bytes(content)) for content in batch["bytes"]]
        table = {name: np.array([row[name] for row in rows]) for name in ("verdict", "least", "faces", "error")}
        return {"path": np.asarray(batch["path"]), **table}

    def _row(self, content: bytes) -> dict[str, Any]:
        row = {"verdict": "", "least": np.nan, "faces": 0, "error": ""}
        try:
            mesh = asdf_vk.read_mesh(content)
            info = asdf_vk.compute(mesh, measure="thickness", session=self._session, **self._options)
        except asdf_vk.Error as error:
            return {**row, "error": str(error)}
        return {**row, "verdict": info.thickness.verdict, "least": info.thickness.min, "faces": info.face_count}


def main() -> int:
    if len(sys.argv) != 4:
        print(__doc__, file=sys.stderr)
        return 1
    import ray  # The class Check does not need it.

    meshes, results, limit = sys.argv[1:]
    ray.init()
    pool = ray.data.ActorPoolStrategy(min_size=1, max_size=int(ray.cluster_resources()["CPU"]))
    table = ray.data.read_binary_files(meshes, include_paths=True).map_batches(
        Check, fn_constructor_kwargs={"thinner_than": float(limit)}, batch_size=64, batch_format="numpy",
        compute=pool, num_cpus=1,
    )  # fmt: skip
    table.write_parquet(results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
