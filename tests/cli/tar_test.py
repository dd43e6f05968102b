"""Tars of meshes, made and read by Python's tarfile and grouped by the rules of WebDataset.

tar_test.py PROGRAM FAULTY_PROGRAM
"""

from __future__ import annotations

import gzip
import io
import json
import os
import re
import signal
import struct
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM, FAULTY_PROGRAM = sys.argv[1:3]
FACES = [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6),
         (3, 0, 4), (3, 4, 7)]  # fmt: skip


def box(height: float = 1) -> bytes:
    corners = [(x, y, z) for z in (0, height) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    lines = ["OFF", "8 12 0", *(f"{x} {y} {z}" for x, y, z in corners), *(f"3 {a} {b} {c}" for a, b, c in FACES)]
    return ("\n".join(lines) + "\n").encode()


def binary_stl(face_count: int) -> bytes:
    return bytes(80) + struct.pack("<I", face_count) + bytes(50 * face_count)


def member(name: str, **values: object) -> tarfile.TarInfo:
    info = tarfile.TarInfo(name)
    for key, value in values.items():
        setattr(info, key, value)
    return info


def tar_of(members: list[tuple[str | tarfile.TarInfo, bytes]], format: int = tarfile.USTAR_FORMAT) -> bytes:
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=format) as tar:
        for name, content in members:
            info = name if isinstance(name, tarfile.TarInfo) else member(name)
            info.size = len(content)
            tar.addfile(info, io.BytesIO(content))
    return buffer.getvalue()


def members_of(content: bytes) -> dict[str, bytes]:
    """The files of a tar in their order; no name occurs twice."""
    found: dict[str, bytes] = {}
    if not content:
        return found
    with tarfile.open(fileobj=io.BytesIO(content), mode="r|*") as tar:
        for info in tar:
            file = tar.extractfile(info) if info.isreg() else None
            assert info.name not in found, info.name
            found[info.name] = file.read() if file is not None else b""
    return found


def samples_of(content: bytes) -> list[dict[str, bytes]]:
    """As WebDataset groups members: by the name up to the first dot of its last part."""
    samples: list[dict[str, bytes]] = []
    for name, data in members_of(content).items():
        match = re.fullmatch(r"((?:.*/|)[^.]+)[.]([^/]*)", name)
        assert match is not None, name
        key, suffix = match.groups()
        if not samples or samples[-1]["__key__"] != key.encode():
            samples.append({"__key__": key.encode()})
        assert suffix not in samples[-1], name
        samples[-1][suffix] = data
    return samples


class TarTest(unittest.TestCase):
    def setUp(self) -> None:
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = Path(self._folder.name)
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()

    def run_asdf(self, *arguments: object, content: bytes = b"", program: str = PROGRAM) -> subprocess.CompletedProcess:
        return subprocess.run([program, "--tar", *map(str, arguments), "--backend", "reference"], input=content,
                              capture_output=True, check=False, timeout=300,
                              env={**os.environ, "TMPDIR": str(self.temporary)})  # fmt: skip

    def write(self, name: str, content: bytes) -> Path:
        path = self.folder / name
        path.write_bytes(content)
        return path

    def test_order_and_samples(self) -> None:
        names = [f"{i:03}" if i % 3 else f"part.{i}/{i:03}" for i in range(200)]
        meshes: list[tuple[str | tarfile.TarInfo, bytes]] = [
            (f"{name}.off", box(0.5 if i % 2 else 2)) for i, name in enumerate(names)]  # fmt: skip
        run = self.run_asdf("-", "--format", "npy", "-o", "-", "--jobs", "3", content=tar_of(meshes))
        self.assertEqual(run.returncode, 0, run.stderr)
        samples = samples_of(run.stdout)
        self.assertEqual([sample["__key__"].decode() for sample in samples], names)
        alone = self.write("alone.off", box(2))
        values = self.folder / "alone.npy"
        subprocess.run([PROGRAM, alone, "-o", values, "--quiet", "--backend", "reference"], check=True)
        self.assertEqual(samples[0]["npy"], values.read_bytes())
        self.assertNotEqual(samples[1]["npy"], values.read_bytes())
        record = json.loads(samples[3]["json"])
        self.assertEqual((record["input"], record["output"]), ("part.3/003.off", "part.3/003.npy"))
        self.assertEqual((record["status"], record["code"], record["faceCount"]), ("done", 0, 12))
        self.assertTrue(record["options"])
        self.assertEqual(set(self.temporary.iterdir()), set())

    def test_verdicts_are_records(self) -> None:
        content = tar_of([("a.off", box(2)), ("b.off", box(0.5)), ("c.off", b"OFF\nnonsense")])
        run = self.run_asdf("-", "--fail-if-thinner", "0.8", "-o", "-", content=content)
        self.assertEqual(run.returncode, 6, run.stderr)
        self.assertIn(b"1 ok, 1 thin, 1 unreadable", run.stderr)
        samples = samples_of(run.stdout)
        self.assertEqual([sorted(sample) for sample in samples], 3 * [["__key__", "json"]])
        records = [json.loads(sample["json"]) for sample in samples]
        self.assertEqual([record["error"] for record in records], [None, "tooThin", "unreadableInput"])
        self.assertEqual([record["code"] for record in records], [0, 6, 2])
        log = self.folder / "log.jsonl"
        run = self.run_asdf("-", "--fail-if-thinner", "0.8", "--json", "--log", log, content=content)
        self.assertEqual(run.returncode, 6)
        lines = [json.loads(line) for line in run.stdout.splitlines()]
        self.assertEqual([line["mesh"] for line in lines], ["a.off", "b.off", "c.off"])
        self.assertEqual([line["output"] for line in lines[:2]], [None, None])
        self.assertEqual(len(log.read_text().splitlines()), 3)
        run = self.run_asdf("-", "--fail-if-thinner", "0.8", "--format", "obj", "-o", "-", content=content)
        self.assertEqual([sorted(sample) for sample in samples_of(run.stdout)][:2], 2 * [["__key__", "json", "obj"]])

    def test_members_are_kept(self) -> None:
        others: list[tuple[str | tarfile.TarInfo, bytes]] = [
            ("a.cls", b"7"), ("a.json", b"{}"), ("a.off", box()), ("a.png", bytes(3 << 20)), ("notes/.hidden.off", b"x"),
            (member("sub", type=tarfile.DIRTYPE), b""), (member("link.txt", type=tarfile.SYMTYPE, linkname="a.cls"), b""),
            ("b.off", b"broken"), ("b.txt", b"text")]  # fmt: skip
        run = self.run_asdf("-", "--format", "npy", "-o", "-", "--keep-members", content=tar_of(others))
        self.assertEqual(run.returncode, 7, run.stderr)
        found = members_of(run.stdout)
        names = [name if isinstance(name, str) else name.name for name, _ in others]
        expected = names[:3] + ["a.asdf.npy", "a.asdf.json"] + names[3:8] + ["b.asdf.json"] + names[8:]
        self.assertEqual(list(found), expected)
        for name, content in others:
            self.assertEqual(found[name if isinstance(name, str) else name.name], content)
        with tarfile.open(fileobj=io.BytesIO(run.stdout)) as tar:
            self.assertEqual(tar.getmember("link.txt").linkname, "a.cls")
            self.assertTrue(tar.getmember("sub").isdir())
        without = self.run_asdf("-", "--format", "npy", "-o", "-", content=tar_of(others))
        self.assertEqual(list(members_of(without.stdout)), ["a.npy", "a.json", "b.json"])

    def test_unusual_members(self) -> None:
        content = tar_of([
            ("s.off", box()), ("s.stl", binary_stl(4)), ("s.mtl", b"newmtl a"), ("s.off", box()),
            ("../out.off", box()), ("/abs.off", box()), ("a/../b.off", box()), ("./dot.off", box()),
            (member("soft.off", type=tarfile.SYMTYPE, linkname="s.off"), b""),
            (member("hard.off", type=tarfile.LNKTYPE, linkname="s.off"), b""),
            (member("fifo.off", type=tarfile.FIFOTYPE), b""), ("r.asdf.ply", b"a result"), ("._s.off", b"x"),
            ("n" * 300 + ".off", box()), ("Ä ö\n.off", box()), ("up.OFF", box()), ("gz.off.gz", gzip.compress(box())),
            ("empty.off", b""), ("s.off", box())], tarfile.PAX_FORMAT)  # fmt: skip
        log = self.folder / "log.jsonl"
        run = self.run_asdf("-", "--fail-if-thinner", "0.1", "-o", "-", "--log", log, content=content)
        self.assertEqual(run.returncode, 7, run.stderr)
        records = {}
        for line in log.read_text().splitlines():
            record = json.loads(line)
            records.setdefault(record["input"], []).append(record["message"] or record["status"])
        self.assertEqual(records["s.off"], ["done"] + 2 * ["its name occurs twice in the tar; rename one"])
        for name in ("../out.off", "/abs.off", "a/../b.off"):
            self.assertIn("leads out of the folder", records[name][0])
        self.assertIn("is a link to s.off", records["soft.off"][0])
        self.assertIn("is a link to s.off", records["hard.off"][0])
        self.assertEqual(records["fifo.off"], ["is not a file"])
        for name in ("./dot.off", "n" * 300 + ".off", "Ä ö\n.off", "up.OFF", "gz.off.gz"):
            self.assertEqual(records[name], ["done"])
        self.assertEqual(len(records), 14)
        names: list[str] = []
        with tarfile.open(fileobj=io.BytesIO(run.stdout), mode="r|") as tar:
            names = [info.name for info in tar]
        self.assertEqual(names, ["s.json", "s.stl.json", "./dot.json", "soft.json", "hard.json", "fifo.json",
                                 "n" * 300 + ".json", "Ä ö\n.json", "up.json", "gz.json", "empty.json"])  # fmt: skip

    def test_compression(self) -> None:
        content = tar_of([(f"{i}.off", box()) for i in range(20)])
        plain = self.write("a.tar", content)
        packed = self.write("b.tar.gz", gzip.compress(content))
        other = self.folder / "c.tar.zst"
        tools = subprocess.run(["zstd", "-q", plain, "-o", other], check=False) if has_tool("zstd") else None
        inputs = [packed] + ([other] if tools is not None and tools.returncode == 0 else [])
        run = self.run_asdf(*inputs, "-o", f"{self.folder}/out/", "--format", "npy", "--log", self.folder / "log")
        self.assertEqual(run.returncode, 0, run.stderr)
        for path in inputs:
            answer = self.folder / "out" / (path.name.split(".")[0] + ".asdf.tar")
            self.assertEqual(len(samples_of(answer.read_bytes())), 20)
            self.assertEqual(json.loads(Path(f"{answer}.json").read_text())["code"], 0)
        first = json.loads((self.folder / "log").read_text().splitlines()[0])
        self.assertEqual(first["input"], f"{packed}/0.off")
        for name, magic in (("x.tar.gz", b"\x1f\x8b"), ("x.tar.zst", b"\x28\xb5\x2f\xfd")):
            run = self.run_asdf(plain, "-o", self.folder / name, "--format", "npy")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertTrue((self.folder / name).read_bytes().startswith(magic))
        self.assertEqual(len(samples_of((self.folder / "x.tar.gz").read_bytes())), 20)
        second = tar_of([(f"second-{i}.off", box()) for i in range(20)])
        run = self.run_asdf("-", "-o", "-", "--format", "npy", content=content + second)
        self.assertEqual(len(samples_of(run.stdout)), 40)

    def test_damaged_tars(self) -> None:
        content = tar_of([(f"{i}.off", box()) for i in range(20)])
        member_size = 512 + -(-len(box()) // 512) * 512
        for name, bad, reason, done in [
            ("cut in a member", content[: 7 * member_size + 600], b"damaged or truncated", 7),
            ("cut in a header", content[: 7 * member_size + 100], b"damaged or truncated", 7),
            ("cut between members", content[: 7 * member_size], b"lacks the end of a tar", 7),
            ("a header overwritten", content[: 7 * member_size] + b"x" * 512 + content[7 * member_size + 512:],
             b"damaged or truncated", 7),
            ("no tar", box() * 100, b"is not a tar", 0),
            ("empty", b"", b"", 0),
            ("a cut gzip", gzip.compress(content)[:200], b"", None),
        ]:  # fmt: skip
            with self.subTest(name):
                run = self.run_asdf("-", "--format", "npy", "-o", "-", content=bad)
                self.assertEqual(run.returncode, 7 if done else 2, run.stderr)
                self.assertIn(b"asdf-vk: error: -: ", run.stderr)
                self.assertIn(reason, run.stderr)
                if done is not None:
                    self.assertEqual(len(samples_of(run.stdout)), done)
                path = self.write("bad.tar", bad)
                output = self.folder / "out.tar"
                output.write_bytes(b"old")
                run = self.run_asdf(path, "--format", "npy", "-o", output, "--quiet")
                self.assertEqual(run.returncode, 7 if done else 2, run.stderr)
                self.assertEqual(output.read_bytes(), b"old")
                self.assertIn(b"out.tar is not written", run.stderr)
                self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["bad.tar", "out.tar", "tmp"])
        self.assertEqual(self.run_asdf("-", "-o", "-", content=bytes(10240)).returncode, 0)
        run = self.run_asdf(self.folder / "none.tar", self.write("good.tar", content), "-o", f"{self.folder}/o/",
                            "--format", "npy")  # fmt: skip
        self.assertEqual(run.returncode, 7)
        self.assertIn(b"cannot be opened", run.stderr)
        self.assertEqual(len(samples_of((self.folder / "o/good.asdf.tar").read_bytes())), 20)

    def test_huge_members(self) -> None:
        """A mesh of 10 GB and a sparse one are answered without the memory that they state."""
        sparse = self.folder / "sparse.off"
        with sparse.open("wb") as file:
            file.truncate(1 << 20)
            file.seek(1 << 19)
            file.write(box())
        subprocess.run(["tar", "-C", self.folder, "--sparse", "-cf", self.folder / "s.tar", "sparse.off"], check=True)
        run = self.run_asdf(self.folder / "s.tar", "-o", "-", "--keep-members", "--format", "npy")
        self.assertEqual(members_of(run.stdout)["sparse.off"], sparse.read_bytes())
        big = member("big.stl", size=10 << 30)
        reader, writer = os.pipe()
        if os.fork() == 0:
            os.close(reader)
            with os.fdopen(writer, "wb") as pipe:
                pipe.write(tar_of([("a.off", box())])[: 512 + -(-len(box()) // 512) * 512] + big.tobuf())
                for _ in range(16):
                    pipe.write(bytes(1 << 20))
            os._exit(0)
        os.close(writer)
        with os.fdopen(reader, "rb") as pipe:
            run = subprocess.run([PROGRAM, "--tar", "-", "-o", "-", "--format", "npy", "--backend", "reference"],
                                 stdin=pipe, capture_output=True, check=False)  # fmt: skip
        self.assertEqual(run.returncode, 7)
        self.assertIn(b"big.stl: has 10737418240 bytes; a mesh in a tar may have 1073741824", run.stderr)
        self.assertEqual(list(members_of(run.stdout)), ["a.npy", "a.json", "big.json"])

    def test_faults(self) -> None:
        content = tar_of([(f"{name}.off", box()) for name in ("a", "crash", "b", "hang", "slow", "c")])
        run = self.run_asdf("-", "--format", "npy", "-o", "-", "--timeout", "3", content=content, program=FAULTY_PROGRAM)
        self.assertEqual(run.returncode, 7, run.stderr)
        records = {s["__key__"].decode(): json.loads(s["json"])["error"] for s in samples_of(run.stdout)}
        self.assertEqual(list(records), ["a", "crash", "b", "hang", "slow", "c"])
        self.assertEqual({k: e for k, e in records.items() if e}, {"crash": "crashed", "hang": "timeLimit"})
        self.assertEqual(set(self.temporary.iterdir()), set())

    def test_kill_and_resume(self) -> None:
        shards = [self.write(f"s{i}.tar", tar_of([(f"{i}{j}{'-slow' if i == 2 else ''}.off", box(0.5 if j else 2))
                                                  for j in range(4)])) for i in range(4)]  # fmt: skip
        out = self.folder / "out"
        call = [FAULTY_PROGRAM, "--tar", *shards, "-o", f"{out}/", "--fail-if-thinner", "0.8", "--skip-existing",
                "--backend", "reference", "--jobs", "1"]  # fmt: skip
        process = subprocess.Popen(call, stderr=subprocess.DEVNULL)
        while not (out / "s1.asdf.tar.json").exists():
            time.sleep(0.005)
        time.sleep(0.3)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertFalse((out / "s2.asdf.tar").exists())
        before = {path: path.stat().st_mtime_ns for path in out.glob("s[01].*")}
        run = subprocess.run(call, capture_output=True, check=False)
        self.assertEqual(run.returncode, 6, run.stderr)
        self.assertIn(b"2 skipped", run.stderr)
        self.assertEqual({path: path.stat().st_mtime_ns for path in before}, before)
        expected = sorted(f"s{i}.asdf.tar{end}" for i in range(4) for end in ("", ".json"))
        self.assertEqual(sorted(path.name for path in out.iterdir()), expected)
        run = subprocess.run(call, capture_output=True, check=False)
        self.assertIn(b"4 skipped", run.stderr)
        self.assertEqual(run.returncode, 6, run.stderr)  # The code of the skipped tars.
        run = subprocess.run([*call, "--keep-members"], capture_output=True, check=False)
        self.assertNotIn(b"skipped", run.stderr)

    def test_a_signal_ends_a_waiting_run(self) -> None:
        content = tar_of([("a.off", box()), ("b.off", box())])
        with subprocess.Popen([PROGRAM, "--tar", "-", "-o", "-", "--format", "npy", "--backend", "reference", "--quiet"],
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:  # fmt: skip
            assert process.stdin is not None and process.stdout is not None
            process.stdin.write(content[: 512 + -(-len(box()) // 512) * 512 + 600])
            process.stdin.flush()
            time.sleep(1)
            process.send_signal(signal.SIGTERM)
            output = process.stdout.read()
            self.assertEqual(process.wait(timeout=20), 130)
        self.assertEqual(list(members_of(output)), ["a.npy", "a.json"])

    def test_an_interrupted_tar_is_not_complete(self) -> None:
        # The whole tar has been read when the signal comes.
        side = range(101)
        vertices = [f"{x} {y} {x * y % 7}" for x in side for y in side]
        squares = [101 * x + y for x in side[:-1] for y in side[:-1]]
        faces = [f"3 {i + 101 * j} {i + 101} {i + 1 - j}" for i in squares for j in (0, 1)]
        slow = "\n".join(["OFF", f"{len(vertices)} {len(faces)} 0", *vertices, *faces, ""]).encode()
        tar = self.write("t.tar", tar_of([("a.off", box()), ("slow.off", slow)]))
        call = [PROGRAM, "--tar", tar, "--backend", "reference", "--rays", "900", "--seeds", "all", "--json"]
        with subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
            assert process.stdout is not None
            process.stdout.readline()  # The report of a.off.
            process.send_signal(signal.SIGTERM)
            process.stdout.read()
            self.assertEqual(process.wait(timeout=20), 130)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["t.tar", "tmp"])

    def test_rules_and_baselines_apply_to_members_with_and_without_results(self) -> None:
        tar = self.write("t.tar", tar_of([("p/a.off", box())]))
        limits = self.write("limits.json", b'{"limits": [{"files": "t.tar/p/*.off", "fail-if-thinner": 2}]}')
        known = self.folder / "known.json"
        for results in ([], ["--format", "npy"]):
            for check in (["--limits", limits], ["--fail-if-thinner", "2"]):
                call = [PROGRAM, "--tar", tar.name, "-o", "o.tar", "--backend", "reference", *check, *results]
                self.assertEqual(subprocess.run(call, cwd=self.folder, capture_output=True, check=False).returncode, 6)
            update = [*call, "--baseline", known, "--update-baseline"]
            self.assertEqual(subprocess.run(update, cwd=self.folder, capture_output=True, check=False).returncode, 0)
            call += ["--baseline", known]
            self.assertEqual(subprocess.run(call, cwd=self.folder, capture_output=True, check=False).returncode, 0)

    def test_a_key_that_occurs_again_later(self) -> None:
        members = [("a.off", box()), ("b.off", box()), ("a.v2.off", box()), ("b.off", box())]
        run = self.run_asdf("-", "-o", "-", "--format", "npy", content=tar_of(members))
        self.assertEqual(run.returncode, 7, run.stderr)
        self.assertIn(b"b.off: its name occurs twice", run.stderr)
        self.assertEqual(list(members_of(run.stdout)),
                         ["a.npy", "a.json", "b.npy", "b.json", "a.v2.off.npy", "a.v2.off.json"])  # fmt: skip

    def test_refusals(self) -> None:
        for arguments, reason in [
            (["a.tar", "-o", "x.ply"], b"--tar writes a tar"),
            (["-", "-"], b"only once"),
            (["a.tar", "b.tar", "-o", "-"], b"holds one result"),
            (["a.tar", "-o", "-", "--json"], b"both write to standard output"),
            (["a.tar", "--format", "html"], b"no member of a tar"),
            (["a.tar", "--picture", "x.png"], b"--picture"),
            (["a.tar", "-o", "o/", "--skip-existing", "--fail-if-thinner", "1", "--report-format", "junit"],
             b"drop --skip-existing"),
            (["-", "--format", "npy"], b"has no file name"),
        ]:
            run = self.run_asdf(*arguments)
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertIn(reason, run.stderr)
        run = subprocess.run([PROGRAM, "a.off", "--keep-members"], capture_output=True, check=False)
        self.assertIn(b"--keep-members needs --tar", run.stderr)


def has_tool(name: str) -> bool:
    return subprocess.run(["which", name], capture_output=True, check=False).returncode == 0


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
