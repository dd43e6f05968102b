#!/usr/bin/python3
"""Measures pages of `asdf-vk MESH -o PAGE.html` in headless Chromium, which renders on the CPU.

    bench/page.py PAGE.html... [--seconds 4] [--screenshot FILE.png [--state KEY=VALUE&...]]

"First frame" is the time in seconds from opening the page to its first frame. "Frames per second" is measured while an
arrow key turns the mesh. With --screenshot, the program only writes a picture of the first page; --state is the part of
the address after #.
"""

import argparse
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "page"))
from PIL import Image
from browser import Browser  # noqa: E402

SIZE = (1200, 800)
TURN = """new Promise((done) => {
  const view = document.getElementById('view'), frames = () => Number(document.documentElement.dataset.frames);
  const first = frames(), begin = performance.now();
  const turn = () => {
    view.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', bubbles: true }));
    const seconds = (performance.now() - begin) / 1000;
    if (seconds < %f) requestAnimationFrame(turn);
    else done([(frames() - first) / seconds, view.width, view.height]);
  };
  requestAnimationFrame(turn);
})"""


def measure(path, seconds):
    with Browser() as browser:
        page = browser.page(size=SIZE)
        begin = time.monotonic()
        page.open(path.resolve().as_uri(), seconds=60)
        first = time.monotonic() - begin
        page.settle()
        rate, width, height = page.js(TURN % seconds)
    print(f"| {path.name} | {path.stat().st_size:,} | {first:.2f} | {rate:.1f} at {width} x {height} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="+", type=pathlib.Path, metavar="PAGE.html")
    parser.add_argument("--seconds", type=float, default=4, help="time of turning")
    parser.add_argument("--screenshot", type=pathlib.Path, metavar="FILE.png")
    parser.add_argument("--state", default="", metavar="KEY=VALUE&...", help="state of the view of --screenshot")
    arguments = parser.parse_args()
    if arguments.screenshot:
        with Browser() as browser:
            page = browser.page(f"{arguments.pages[0].resolve().as_uri()}#{arguments.state}", size=SIZE)
            page.settle()
            page.screenshot().quantize(255, dither=Image.Dither.NONE).save(arguments.screenshot, optimize=True)
        return
    print("| page | bytes | first frame, s | frames per second |\n|---|---:|---:|---:|")
    for path in arguments.pages:
        measure(path, arguments.seconds)


if __name__ == "__main__":
    main()
