"""Measures and checks batches of asdf-vk (docs/batches.md).

    python3 bench/batch threads MESHES         time with --threads 1 / time with the default, from file to .npy
    python3 bench/batch cgal MESHES            CPU time of CGAL's sdf_values with 25 rays / CPU time of one call
    python3 bench/batch many [--count 10000]   generated meshes: 1 % are broken, one hangs, one needs 10 GB of memory
    python3 bench/batch kill [--moments 50]    kill -9 at random moments, then the same call: bytes as without kill -9
    python3 bench/batch cost                   CPU seconds per mesh: checks and shape diameters by number of faces
    python3 bench/batch shards MESHES          --shard 1/7 to 7/7: union of the results, and the work of each shard

The programs are in the build folder --build (default build/develop). Files are written to a temporary folder. The exit
code is 1 if a check fails.
"""
import argparse
import pathlib
import sys
import tempfile

import measurements
import runs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["threads", "cgal", "many", "kill", "cost", "shards"])
    parser.add_argument("meshes", nargs="?", help="folder of meshes, for threads, cgal and shards")
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent.parent / "build/develop")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--count", type=int, help="number of generated meshes; default 10000 for many, 60 for kill")
    parser.add_argument("--moments", type=int, default=50)
    parser.add_argument("--shards", type=int, default=7)
    parser.add_argument("--timeout", type=float, default=30)
    parser.add_argument("--more", default="", help="further options of asdf-vk, for example '--backend cpu'")
    options = parser.parse_args()
    options.more = options.more.split()
    options.count = options.count or (10000 if options.what == "many" else 60)
    if options.what in ("threads", "cgal", "shards") and not options.meshes:
        parser.error(f"{options.what} needs a folder of meshes")
    with tempfile.TemporaryDirectory(prefix="asdf-vk-batch-") as work:
        getattr(measurements, options.what)(options, pathlib.Path(work))
    return 1 if runs.check.failed else 0


if __name__ == "__main__":
    sys.exit(main())
