"""Add-ons for other programs, one file each. `python3 -m asdf_vk.hosts` prints their paths."""
