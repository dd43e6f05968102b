"""CPU time per mesh of checks and of shape diameters, for meshes of asdf-vk-generate (README.md, docs/cluster.md)."""
import os
import re
import subprocess

PARTS = ("bracket-16", "ligament-96", "ribbed-plate", "shelled-box", "round-cup", "sharp-thread")
SHAPES = ("animal", "hand", "figure", "torus", "tree")
MIN_FACES_PER_RUN = 120_000


def generate(program, name, file, *more):
    """Returns the number of faces."""
    printed = subprocess.run([program, name, "-o", file, *map(str, more)], stderr=subprocess.PIPE, text=True, check=True)
    return int(re.search(r"with ([\d,]+) faces", printed.stderr)[1].replace(",", ""))


def edge_for(program, name, faces, file):
    """Returns the longest edge with which the part has about this number of faces."""
    least = greatest = 100.0
    while generate(program, name, file, "--longest-edge", least) < faces:
        least, greatest = least / 2, least
    for _ in range(8):
        middle = (least * greatest) ** 0.5
        if generate(program, name, file, "--longest-edge", middle) > faces:
            least = middle
        else:
            greatest = middle
    return greatest


def write_copies(folder, first, count):
    for i in range(1, count):
        os.link(first, folder / f"{first.stem}-{i}.ply")


def cpu_seconds(command):
    before = os.times()
    subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = os.times()
    return after.children_user - before.children_user + after.children_system - before.children_system


def measure(options, work):
    generator, program = options.build / "src/asdf-vk-generate", options.build / "src/asdf-vk"
    tasks = {
        "check": (PARTS, lambda folder, out: ["--fail-if-thinner", 0.8]),
        "shape diameter": (SHAPES, lambda folder, out: ["-o", out, "--format", "npy", "--backend", "cpu"]),
    }
    for task, (names, arguments) in tasks.items():
        for faces in (500, 5_000, 50_000):
            folder = work / f"{task}-{faces}"
            folder.mkdir()
            copies, total = max(1, MIN_FACES_PER_RUN // (faces * len(names))), 0
            for name in names:
                file = folder / f"{name}.ply"
                sized = ["--faces", faces] if task != "check" else ["--longest-edge", edge_for(generator, name, faces, file)]
                total += copies * generate(generator, name, file, *sized)
                write_copies(folder, file, copies)
            count = copies * len(names)
            command = [program, "-r", folder, *arguments(folder, work / "out"), "--log", work / "log", "--quiet", *options.more]
            seconds = [cpu_seconds(command) for _ in range(options.runs)]
            print(f"{task}, {total // count} faces: {min(seconds) / count:.4f} CPU seconds per mesh ({count} meshes, "
                  f"least of {options.runs} runs; greatest {max(seconds) / count:.4f})", flush=True)
