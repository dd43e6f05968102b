"""Parts and thickness of a mesh, in cells as of a notebook: python3 parts_and_thickness.py MESH [FOLDER]

Writes FOLDER/parts.png, the mesh in the colours of its parts beside a histogram of its thickness, and
FOLDER/parts.ply, the mesh with both as fields.
"""

# %% Read the mesh with trimesh, or with asdf_vk if trimesh is not installed.
import sys
from pathlib import Path

import matplotlib
import numpy as np

import asdf_vk

matplotlib.use("Agg")  # No display is needed.
from matplotlib import pyplot  # noqa: E402

path = Path(sys.argv[1])
folder = Path(sys.argv[2] if len(sys.argv) > 2 else ".")
try:
    import trimesh

    mesh = trimesh.load(path, process=False)
except ImportError:
    mesh = asdf_vk.read_mesh(path)
vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
print(f"{path.name}: {len(vertices)} vertices, {len(faces)} faces")

# %% One scene for all queries: geometry and hierarchy are kept.
scene = asdf_vk.Scene(vertices, faces)
info = scene.compute()
values = info.fields["sdf"]
print(f"shape diameter: median {np.nanmedian(values):.4g}, device: {info.device}")
if info.estimated_error is not None:
    print(f"expected error: {100 * info.estimated_error.relative_median:.1f} % of the value in the median")

# %% Parts: their number is found.
labels = scene.segment()
print(f"{labels.max() + 1} parts")
for part in range(labels.max() + 1):
    inside = labels == part
    print(f"  part {part}: {inside.sum()} faces, median diameter {np.nanmedian(values[inside]):.4g}")

# %% Wall thickness, and the regions where the surface is thinner than the 5th percentile.
walls = scene.thickness()
limit = float(np.nanpercentile(walls, 5))
info = scene.compute(measure="thickness", thinner_than=limit)
assert info.thickness is not None
print(info.thickness.sentence)

# %% The thin faces alone, with more rays: only they cast rays.
region = info.fields["least_thickness"] < limit
print(f"mean diameter of the thin faces: {np.nanmean(scene.shape_diameter(faces=region, rays=300, seeds='all')):.4g}")

# %% A picture and a file.
figure = pyplot.figure(figsize=(10, 5))
axes = figure.add_subplot(1, 2, 1, projection="3d")
centres = vertices[faces].mean(axis=1)
shown = np.random.default_rng(0).permutation(len(faces))[:20_000]
axes.scatter(*centres[shown].T, c=labels[shown], cmap="tab20", s=1)
axes.set_box_aspect(np.ptp(centres, axis=0))
axes.set_title(f"{labels.max() + 1} parts")
histogram = figure.add_subplot(1, 2, 2)
histogram.hist(walls[np.isfinite(walls)], bins=60)
histogram.axvline(limit, color="black", linestyle=":")
histogram.set_xlabel("wall thickness, in the unit of the mesh")
histogram.set_ylabel("faces")
figure.savefig(folder / "parts.png", dpi=100)
asdf_vk.write(folder / "parts.ply", (vertices, faces), {"sdf": values, "part": labels, "thickness": walls})
print(f"wrote {folder / 'parts.png'} and {folder / 'parts.ply'}")
