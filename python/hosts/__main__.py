"""Prints the paths of the add-ons."""

from pathlib import Path

for path in sorted(Path(__file__).parent.glob("asdf_vk_*.py")):
    print(path)
