"""Run by Blender with a window, under Xvfb: the operator in the background, Esc, and a picture of the window.

    blender --factory-startup --enable-event-simulate --python blender_window_test.py -- FOLDER PICTURE
"""

import os
import sys
import time
import traceback
from math import radians
from pathlib import Path

import bpy
from checks import Checks
from mathutils import Euler

import asdf_vk

arguments = sys.argv[sys.argv.index("--") + 1 :]
folder, picture = Path(arguments[0]), Path(arguments[1])
checks = Checks("Blender window")
bpy.context.preferences.view.show_splash = False
bpy.ops.preferences.addon_install(filepath=os.path.join(os.path.dirname(asdf_vk.__file__), "hosts", "asdf_vk_blender.py"))
bpy.ops.preferences.addon_enable(module="asdf_vk_blender")


def window_override():
    """The context of the 3D view."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return {"window": window, "area": area, "region": region}


def add(name):
    mesh = asdf_vk.read_mesh(folder / name)
    data = bpy.data.meshes.new(name)
    data.from_pydata(mesh.vertices.tolist(), [], mesh.faces.tolist())
    obj = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    return obj


def steps():
    """A generator: Blender runs between its steps, and waits as many seconds as a step yields."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    yield 1.0
    big = add("big.ply")
    override = window_override()
    with bpy.context.temp_override(**override):
        state = bpy.ops.object.asdf_vk("INVOKE_DEFAULT", measure="DIAMETER", all_faces=True)
    checks.that("runs in the background", state == {"RUNNING_MODAL"})
    yield 0.6
    checks.that("is still running", "sdf" not in big.data.attributes)
    override["window"].event_simulate(type="ESC", value="PRESS", x=300, y=300)
    override["window"].event_simulate(type="ESC", value="RELEASE", x=300, y=300)
    yield 1.5
    checks.that(f"Esc cancels, and nothing is on the mesh: {big.data.attributes.keys()}", "sdf" not in big.data.attributes)
    bpy.data.objects.remove(big)

    part = add("part.ply")
    part.select_set(True)
    bpy.context.scene.asdf_vk.limit = 0.8
    with bpy.context.temp_override(**override):
        bpy.ops.object.asdf_vk("INVOKE_DEFAULT", measure="THICKNESS", limit=0.8)
    deadline = time.monotonic() + 20
    while "thickness" not in part.data.attributes and time.monotonic() < deadline:
        yield 0.1
    checks.that("finished in the background", "thickness" in part.data.attributes)
    space = override["area"].spaces.active
    checks.that("the view shows the colours", space.shading.color_type == "VERTEX")

    # The picture: the sidebar with the panel, and the part with its thin faces in red.
    space.show_region_ui = True
    space.show_region_toolbar = False
    overlay = space.overlay
    overlay.show_floor = overlay.show_axis_x = overlay.show_axis_y = overlay.show_cursor = False
    with bpy.context.temp_override(**override):
        bpy.ops.view3d.view_selected()
        space.region_3d.view_rotation = Euler((radians(58), 0, radians(120))).to_quaternion()
        space.region_3d.view_distance *= 1.25
        bpy.ops.screen.screen_full_area()
    yield 1.0
    window = bpy.context.window_manager.windows[0]
    area = window.screen.areas[0]
    sidebar = next(region for region in area.regions if region.type == "UI")
    tab = {"x": sidebar.x + sidebar.width - 15, "y": sidebar.y + sidebar.height - 175}
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=kind, value=value, **tab)
        yield 0.3
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=300, y=100)
    yield 1.0
    bpy.ops.screen.screenshot(filepath=str(picture))
    checks.picture(picture)
    checks.finish()


running = steps()


def advance():
    try:
        return next(running)
    except Exception:
        traceback.print_exc()
        checks.that("no exception", False)
        checks.finish()


bpy.app.timers.register(advance, first_interval=1.0)
