"""Results that have the same bits on every system: hashes of values, labels and reports of 20 generated meshes.

  golden.py PROGRAM GENERATOR [--write]            compares with results.txt, or writes it
  golden.py PROGRAM GENERATOR --engine FOLDER [--meshes MESH...]
                                                   the same for the WebAssembly module in FOLDER (scripts/web), in Node;
                                                   and compares its results of MESH with those of PROGRAM
PROGRAM and GENERATOR are commands such as "qemu-aarch64 build/test/src/asdf-vk".
"""

import argparse
import hashlib
import json
import os
import shlex
import subprocess
import sys
import tempfile

FOLDER = os.path.dirname(os.path.abspath(__file__))
RESULTS = os.path.join(FOLDER, "results.txt")
RUN_JOBS = os.path.join(FOLDER, "..", "web", "run_jobs.mjs")
# Shapes with their numbers of faces and limits; parts with their longest edges and limits.
SHAPES = [("animal", 3000, 0.05), ("hand", 4000, 0.05), ("figure", 6000, 0.1), ("tree", 3000, 0.1), ("sphere", 2000, 0.1),
          ("slab", 2000, 0.2), ("cylinder", 3000, 0.1), ("torus", 3000, 0.1), ("cube", 3000, 0.1)]
PARTS = [("wedge", 2, 0.8), ("knife", 4, 0.8), ("stepped-plate", 2, 1.6), ("ribbed-plate", 2, 1), ("pocket", 2, 1.2),
         ("shelled-box", 3, 1.2), ("round-cup", 4, 2.1), ("bracket-16", 2, 2.1), ("ligament-24", 2, 0.8),
         ("flat-thread", 4, 0.8), ("drafted-box", 4, 1.2)]
# What depends on the run and not on the result.
IGNORED = ("mesh", "output", "with", "withFaceCounts", "picture", "points", "former", "stageSeconds", "raysPerSecond",
           "deviceTimes", "device", "version", "commit")


def read(path):
    with open(path, "rb") as file:
        return file.read()


def hash_of(data):
    return hashlib.sha256(data).hexdigest()[:16]


def hash_of_report(report):
    return hash_of(json.dumps({key: report[key] for key in report if key not in IGNORED}).encode())


def result_of_program(program, mesh, limit, folder):
    """Hashes of the values in double precision, and of the report."""
    csv = os.path.join(folder, "result.csv")
    command = [*program, mesh, "--backend", "cpu", "--measure", "both", "--fail-if-thinner", str(limit), "--segment",
               "--quiet", "--json", "-o", csv]
    run = subprocess.run(command, capture_output=True, text=True)
    if not run.stdout:
        sys.exit(f"{command}: {run.stderr}")
    report = json.loads(run.stdout)
    if "error" in report:
        return report["code"], report["error"].rsplit("/", 1)[-1]
    return hash_of(read(csv)), hash_of_report(report)


def results_of_engine(engine, meshes, folder):
    """As result_of_program(), for a list of meshes and limits."""
    jobs = [{"files": [mesh], "check": {"limit": limit}, "compute": {"segment": "parts"},
             "save": [os.path.join(folder, f"engine-{i}.{kind}") for kind in ("csv", "json")]} for i, (mesh, limit) in enumerate(meshes)]
    run = subprocess.run(["node", RUN_JOBS, engine], input=json.dumps(jobs), capture_output=True, text=True)
    answers = [json.loads(line) for line in run.stdout.splitlines()]
    if len(answers) != len(jobs):
        sys.exit(f"the engine ended: {run.stderr}")
    return [(answer["code"], answer["error"]) if "error" in answer else
            (hash_of(read(job["save"][0])), hash_of_report(json.loads(read(job["save"][1]))))
            for job, answer in zip(jobs, answers)]


def generated(generator, folder):
    meshes = []
    for kind, size, limit in SHAPES + PARTS:
        path = os.path.join(folder, f"{kind}.ply")
        option = "--faces" if (kind, size, limit) in SHAPES else "--longest-edge"
        subprocess.run([*generator, kind, option, str(size), "-o", path], check=True, capture_output=True)
        meshes.append((path, limit))
    return meshes


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=shlex.split)
    parser.add_argument("generator", type=shlex.split)
    parser.add_argument("--engine")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--meshes", nargs="+", default=[])
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        meshes = generated(arguments.generator, folder)
        if arguments.engine:
            results = results_of_engine(arguments.engine, meshes, folder)
        else:
            results = [result_of_program(arguments.program, mesh, limit, folder) for mesh, limit in meshes]
        lines = [" ".join((os.path.basename(mesh)[:-4], str(limit), hash_of(read(mesh)), *result)) + "\n"
                 for (mesh, limit), result in zip(meshes, results)]
        if arguments.write:
            with open(RESULTS, "w", encoding="utf-8") as file:
                file.writelines(["# mesh, limit, and hashes of the mesh, of the values and labels, and of the report: see "
                                 "golden.py\n", *lines])
            return
        with open(RESULTS, encoding="utf-8") as file:
            expected = [line for line in file if not line.startswith("#")]
        wrong = [f"expected {old}found    {new}" for old, new in zip(expected, lines) if old != new]
        real = [(mesh, 0.8 if mesh.endswith(".stl") else 0.01) for mesh in arguments.meshes]
        for (mesh, limit), found in zip(real, results_of_engine(arguments.engine, real, folder) if real else []):
            program = result_of_program(arguments.program, mesh, limit, folder)
            if program != found:
                wrong.append(f"{mesh}: the program gives {program}, the engine {found}\n")
        print("".join(wrong) + f"{len(lines) + len(real) - len(wrong)} results agree, {len(wrong)} differ")
        sys.exit(1 if wrong or len(lines) != len(expected) else 0)


if __name__ == "__main__":
    main()
