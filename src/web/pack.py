#!/usr/bin/env python3
"""Fills the template of the page that computes (src/page/bundle.cmake with WEB) and writes one file:

    src/web/pack.py TEMPLATE OUTPUT.html ID=FILE...

Each FILE becomes an element ID with base64 of its bytes, compressed with deflate: engine-module has the WebAssembly module
and engine-worker the script of the worker. TEMPLATE.js is the script of the page.
"""

import base64
import pathlib
import sys
import zlib


def packed(path):
    return base64.b64encode(zlib.compress(pathlib.Path(path).read_bytes(), 9)).decode()


def main():
    template, output, *elements = sys.argv[1:]
    page = pathlib.Path(template).read_text()
    data = "".join(f'<script type="application/octet-stream" id="{name}">{packed(path)}</script>\n'
                   for name, path in (element.split("=", 1) for element in elements))
    page = page.replace("@DATA@", data).replace("@SCRIPT@", packed(f"{template}.js"))
    pathlib.Path(output).write_text(page)


if __name__ == "__main__":
    main()
