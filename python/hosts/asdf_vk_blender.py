"""Add-on for Blender 3.4 and later: computes shape diameter, wall thickness and parts of a mesh.

Install this file: Edit, Preferences, Add-ons, Install. Then the sidebar of the 3D view (key N) has the tab "asdf-vk".
In a script, call `bpy.ops.object.asdf_vk(measure="THICKNESS", limit=0.8)`.

Results are stored on the mesh: attributes of the domain FACE (sdf, thickness, least_thickness, segment), the colour
attribute "asdf-vk", and a material per part after the materials of the mesh. Thin faces are selected. Lengths include
the scale of the object and are in units of Blender. Modifiers are not applied.
"""

import sys
import threading
import warnings
from pathlib import Path

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

bl_info = {
    "name": "asdf-vk: thickness and parts",
    "author": "The asdf-vk authors",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > asdf-vk",
    "description": "Shape diameter, wall thickness and parts, as attributes of the faces",
    "category": "Mesh",
}

COLOURS = "asdf-vk"  # Name of the colour attribute.
FIELDS = ("sdf", "seed", "thickness", "least_thickness", "segment")  # Names of the other attributes.
MATERIALS = "asdf_vk_material"  # Name of the attribute with the material of each face before the parts.
PART = "asdf-vk part "  # Begin of the names of the materials of the parts.
REPORT = "asdf_vk_report"  # Name of the property of the mesh that has the text of the last result.
MEASURES = (
    ("DIAMETER", "Shape Diameter", "Local diameter of the shape at each face: the mean length of many rays"),
    ("THICKNESS", "Wall Thickness", "Thickness of the wall at each face; faces below the limit are selected"),
    ("PARTS", "Parts", "Parts of the shape; each part gets a material"),
)


def module():
    """Imports the Python package asdf_vk. Raises ImportError with a remedy."""
    addon = bpy.context.preferences.addons.get(__name__)
    if addon and addon.preferences.folder:
        folder = str(Path(bpy.path.abspath(addon.preferences.folder)).expanduser())
        if folder not in sys.path:
            sys.path.append(folder)
    try:
        import asdf_vk.hosts
    except ImportError as error:
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        raise ImportError(
            f"the Python package asdf_vk cannot be imported ({error}); install it for Python {version}, and enter the "
            "folder that holds it in the preferences of this add-on"
        ) from error
    return asdf_vk


def reversed_faces(corners, first):
    """Reverses the corners of each face. The first corner of a face stays the first. first: with the number of corners."""
    begin, end = (np.repeat(each, np.diff(first)) for each in (first[:-1], first[1:]))
    index = np.arange(len(corners))
    return corners[np.where(index == begin, index, begin + end - index)]


def mesh_of(asdf_vk, obj):
    """Returns the faces in world coordinates as a Mesh of asdf_vk. Faces that the object mirrors are reversed."""
    mesh = obj.data
    if not mesh.polygons:
        raise ValueError(f"{obj.name} has no faces")
    of_user = [attribute for attribute in mesh.attributes if attribute.domain not in ("FACE", "CORNER")]
    for item in (*obj.vertex_groups, *mesh.uv_layers, *of_user):
        if item.name in (*FIELDS, COLOURS, MATERIALS):
            raise ValueError(f"{obj.name} has a vertex group, UV map or attribute with the name {item.name}: rename it")
    vertices = np.empty(3 * len(mesh.vertices), np.float32)
    corners, first = np.empty(len(mesh.loops), np.int32), np.empty(len(mesh.polygons), np.int32)
    mesh.vertices.foreach_get("co", vertices)
    mesh.loops.foreach_get("vertex_index", corners)
    mesh.polygons.foreach_get("loop_start", first)
    matrix = np.array(obj.matrix_world, np.float64)
    world = vertices.reshape(-1, 3).astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    first = np.append(first, len(corners))
    if np.linalg.det(matrix[:3, :3]) < 0:
        corners = reversed_faces(corners, first)
    return asdf_vk.mesh_of_polygons(world, corners, first)


class Computation(threading.Thread):
    """Runs asdf_vk.compute() in a separate thread. The main thread reads `fraction` and sets `is_cancelled`."""

    def __init__(self, asdf_vk, mesh, options) -> None:
        super().__init__(daemon=True)
        self.asdf_vk, self.mesh, self.options = asdf_vk, mesh, options
        self.fraction, self.is_cancelled, self.info, self.error = 0.0, False, None, None

    def run(self) -> None:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # The operator shows the warnings.
                self.info = self.asdf_vk.compute(self.mesh, progress=self.report, **self.options)
        except Exception as error:  # The operator shows the error.
            self.error = error

    def report(self, fraction: float, stage: str) -> bool:
        self.fraction = fraction
        return not self.is_cancelled


def linear(colours):
    return np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)


def colours_of(values, thin):
    """Returns linear colours: red if thin, grey without a value, else viridis from the 1st to the 99th percentile."""
    has_value = np.isfinite(values)
    low, high = np.percentile(values[has_value], (1, 99)) if has_value.any() else (0, 1)
    return linear(module().hosts.colours_of(values, low, high, thin, grey=0.5))


def colour_of_part(part: int):
    """Returns the linear colour of a part. The hues of successive parts differ by the golden angle."""
    hue = (0.05 + part * 0.381966) % 1 * 6
    channels = [0.25 + 0.65 * min(max(abs((hue + shift) % 6 - 3) - 1, 0), 1) for shift in (0, 4, 2)]
    return linear(np.array(channels))


def set_attribute(mesh, name: str, values) -> None:
    """Adds a FACE attribute of numbers. Replaces an attribute of the same name."""
    if name in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[name])
    is_real = values.dtype.kind == "f"
    attribute = mesh.attributes.new(name, "FLOAT" if is_real else "INT", "FACE")
    attribute.data.foreach_set("value", np.ascontiguousarray(values, np.float32 if is_real else np.int32))


def set_colours(mesh, colours) -> None:
    """Adds the colour attribute, with the same colour at all corners of a face."""
    if COLOURS in mesh.color_attributes:
        mesh.color_attributes.remove(mesh.color_attributes[COLOURS])
    attribute = mesh.color_attributes.new(COLOURS, "BYTE_COLOR", "CORNER")
    sizes = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    with_alpha = np.hstack([colours, np.ones((len(colours), 1))]).astype(np.float32)
    attribute.data.foreach_set("color", np.repeat(with_alpha, sizes, axis=0).ravel())
    mesh.color_attributes.active_color = mesh.color_attributes[COLOURS]


def select_faces(mesh, selected) -> None:
    """Selects the given faces with their edges and vertices. Deselects everything else."""
    corners, edges = np.empty(len(mesh.loops), np.int32), np.empty(len(mesh.loops), np.int32)
    sizes = np.empty(len(mesh.polygons), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    mesh.loops.foreach_get("edge_index", edges)
    mesh.polygons.foreach_get("loop_total", sizes)
    of_corner = np.repeat(selected, sizes)
    for items, indices in ((mesh.vertices, corners), (mesh.edges, edges)):
        flags = np.zeros(len(items), bool)
        flags[indices[of_corner]] = True
        items.foreach_set("select", flags)
    mesh.polygons.foreach_set("select", selected)


def part_slots(mesh):
    return [i for i, material in enumerate(mesh.materials) if material and material.name.startswith(PART)]


def remove_parts(mesh) -> None:
    """Removes the materials of the parts. The faces have the materials that they had before."""
    slots = part_slots(mesh)
    if MATERIALS in mesh.attributes:
        current, before = (np.zeros(len(mesh.polygons), np.int32) for _ in range(2))
        mesh.polygons.foreach_get("material_index", current)
        mesh.attributes[MATERIALS].data.foreach_get("value", before)
        mesh.polygons.foreach_set("material_index", np.where(np.isin(current, slots), before, current))
        mesh.attributes.remove(mesh.attributes[MATERIALS])
    for slot in reversed(slots):
        mesh.materials.pop(index=slot)


def add_parts(mesh, segments) -> None:
    """Adds a material per part after the materials of the mesh, which are kept."""
    remove_parts(mesh)
    before = np.zeros(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("material_index", before)
    set_attribute(mesh, MATERIALS, before)
    first = len(mesh.materials)
    for part in range(int(segments.max()) + 1):
        name = f"{PART}{part}"
        material = bpy.data.materials.get(name) or bpy.data.materials.new(name)
        material.diffuse_color = (*colour_of_part(part), 1)
        material.use_nodes = True
        for node in material.node_tree.nodes:
            if node.type == "BSDF_PRINCIPLED":
                node.inputs["Base Color"].default_value = material.diffuse_color
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", first + np.maximum(segments, 0).astype(np.int32))


def length(context, value: float, other: float = np.nan) -> str:
    """Text of a length in the unit of the scene: four digits, or up to six to differ from the text of `other`."""
    settings = context.scene.unit_settings

    def text(number: float, digits: int) -> str:
        if not np.isfinite(number):
            return "-"
        if settings.system == "NONE":
            return f"{number:.{digits}g}"
        return bpy.utils.units.to_string(settings.system, "LENGTH", number * settings.scale_length, precision=digits)

    return module().hosts.digits_of(text, value, other)


def main_field(info):
    return info.fields["sdf" if "sdf" in info.fields else "thickness"]


def show(context, mesh, info, measure: str, limit: float) -> str:
    """Stores the result on the mesh. Returns a sentence about the result."""
    for name, values in info.fields.items():
        set_attribute(mesh, name, values)
    if measure == "PARTS":
        segments = info.fields["segment"]
        add_parts(mesh, segments)
        colours = np.array([colour_of_part(part) for part in range(int(segments.max()) + 1)])
        set_colours(mesh, colours[np.maximum(segments, 0)])
        text = f"{info.segment_count} part{'s' if info.segment_count != 1 else ''}"
    elif measure == "THICKNESS":
        report, thin = info.thickness, info.thin
        set_colours(mesh, colours_of(info.fields["least_thickness"], thin))
        text = f"least thickness {length(context, np.nanmin(info.fields['least_thickness'], initial=np.inf))}"
        if limit > 0:
            select_faces(mesh, thin)
            context.tool_settings.mesh_select_mode = (False, False, True)
            verdict = module().hosts.verdict_text(report, lambda value: length(context, value, limit))
            text = f"{verdict}; {np.count_nonzero(thin)} faces below {length(context, limit, report.min)}"
    else:
        set_colours(mesh, colours_of(info.fields["sdf"], info.thin))
        text = f"median diameter {length(context, info.sdf.median)}"
    missing = np.count_nonzero(np.isnan(main_field(info)))
    text += f"; faces without a value: {missing}" if missing else ""
    mesh[REPORT] = text
    mesh.update()
    return text


class Options:
    limit: FloatProperty(name="Limit", description="Least allowed thickness; 0: none", min=0, unit="LENGTH", precision=4)
    count_details: BoolProperty(name="Count details", description="Thin places that are too small for a wall fail, too")
    count_edges: BoolProperty(name="Count edges", description="Details and thin edges fail, too: each thin point")
    parts: IntProperty(name="Parts", description="Number of parts; 0: automatic", min=0, max=100)
    all_faces: BoolProperty(name="Trace all faces",
                            description="Cast rays from every face: slower, but no value is interpolated")


class OBJECT_OT_asdf_vk(Options, bpy.types.Operator):
    bl_idname, bl_label = "object.asdf_vk", "Thickness and Parts"
    bl_description = "Computes with asdf-vk; Esc cancels"
    bl_options = {"REGISTER", "UNDO"}

    measure: EnumProperty(name="Measure", items=MEASURES)

    @classmethod
    def poll(cls, context):
        cls.poll_message_set("Select a mesh object, in Object Mode")
        return context.mode == "OBJECT" and context.object is not None and context.object.type == "MESH"

    def start(self, context) -> bool:
        """Prepares the computation. On failure, reports the reason and returns False."""
        try:
            asdf_vk = module()
            mesh = mesh_of(asdf_vk, context.object)
        except (ImportError, ValueError) as error:
            self.report({"ERROR"}, f"asdf-vk: {error}")
            return False
        if any(modifier.show_viewport for modifier in context.object.modifiers):
            self.report({"WARNING"}, "asdf-vk: the mesh is measured without its modifiers; apply them first")
        options = {}
        if self.measure == "THICKNESS":
            options["measure"] = "thickness"
            if self.limit > 0:
                options.update(thinner_than=self.limit, count_details=self.count_details, count_edges=self.count_edges)
        elif self.all_faces:
            options["seeds"] = "all"
        if self.measure == "PARTS":
            options.update(segment="parts", parts=self.parts or None)
        self.object, self.computation = context.object, Computation(asdf_vk, mesh, options)
        context.window_manager.progress_begin(0, 1)
        return True

    def finish(self, context):
        context.window_manager.progress_end()
        error, info = self.computation.error, self.computation.info
        if error is not None:
            if isinstance(error, self.computation.asdf_vk.CancelledError):
                self.report({"INFO"}, "asdf-vk: cancelled")
            else:
                self.report({"ERROR"}, f"asdf-vk: {error}")
            return {"CANCELLED"}
        if len(main_field(info)) != len(self.object.data.polygons):
            self.report({"ERROR"}, "asdf-vk: the mesh was changed during the computation")
            return {"CANCELLED"}
        for warning in info.warnings:
            self.report({"WARNING"}, f"asdf-vk: {warning.message}")
        self.report({"INFO"}, f"{self.object.name}: {show(context, self.object.data, info, self.measure, self.limit)}")
        return {"FINISHED"}

    def execute(self, context):
        """Computes and waits for the result. Used by scripts and by `blender -b`."""
        if not self.start(context):
            return {"CANCELLED"}
        self.computation.run()
        return self.finish(context)

    def invoke(self, context, event):
        """Starts the computation in the background, so that the window stays responsive."""
        if bpy.app.background:
            return self.execute(context)
        if not self.start(context):
            return {"CANCELLED"}
        self.computation.start()
        self.timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        self.computation.is_cancelled = True

    def modal(self, context, event):
        if event.type == "ESC":
            self.computation.is_cancelled = True
        if event.type in {"MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "MOUSEMOVE"}:
            return {"PASS_THROUGH"}  # Events pass through, so that the user can turn and zoom the view.
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        fraction = self.computation.fraction
        context.window_manager.progress_update(fraction)
        context.workspace.status_text_set(f"asdf-vk: {100 * fraction:.0f} % (Esc cancels)")
        if self.computation.is_alive():
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        result = self.finish(context)
        if result == {"FINISHED"}:
            for area in context.screen.areas:
                if area.type == "VIEW_3D":
                    area.spaces.active.shading.color_type = "MATERIAL" if self.measure == "PARTS" else "VERTEX"
                area.tag_redraw()
        return result


class OBJECT_OT_asdf_vk_remove_parts(bpy.types.Operator):
    bl_idname, bl_label = "object.asdf_vk_remove_parts", "Remove Parts"
    bl_description = "Removes the materials of the parts; the faces get their own materials back"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return OBJECT_OT_asdf_vk.poll(context) and bool(part_slots(context.object.data))

    def execute(self, context):
        mesh = context.object.data
        remove_parts(mesh)
        if "segment" in mesh.attributes:
            mesh.attributes.remove(mesh.attributes["segment"])
        mesh.update()
        return {"FINISHED"}


class Settings(Options, bpy.types.PropertyGroup):
    """Options of the panel."""


class VIEW3D_PT_asdf_vk(bpy.types.Panel):
    bl_idname, bl_label = "VIEW3D_PT_asdf_vk", "Thickness and parts"
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "asdf-vk"

    def draw(self, context):
        settings, column = context.scene.asdf_vk, self.layout.column()
        for (measure, label, _), names in zip(MEASURES, ((), ("limit", "count_details", "count_edges"), ("parts",))):
            box = column.box()
            for name in names:
                box.prop(settings, name)
            button = box.operator(OBJECT_OT_asdf_vk.bl_idname, text=label)
            button.measure, button.all_faces = measure, settings.all_faces
            for name in names:
                setattr(button, name, getattr(settings, name))
        if OBJECT_OT_asdf_vk_remove_parts.poll(context):
            box.operator(OBJECT_OT_asdf_vk_remove_parts.bl_idname)
        column.prop(settings, "all_faces")
        if context.object and context.object.type == "MESH" and REPORT in context.object.data:
            for line in context.object.data[REPORT].replace("; ", ", ").split(", "):
                column.label(text=line)


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __name__
    folder: StringProperty(name="Folder of asdf_vk", description="Folder that contains the package", subtype="DIR_PATH")

    def draw(self, context):
        self.layout.prop(self, "folder")
        try:
            self.layout.label(text=f"asdf_vk {module().__version__}")
        except ImportError as error:
            self.layout.label(text=str(error), icon="ERROR")


CLASSES = (OBJECT_OT_asdf_vk, OBJECT_OT_asdf_vk_remove_parts, Settings, VIEW3D_PT_asdf_vk, Preferences)


def register() -> None:
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.asdf_vk = PointerProperty(type=Settings)


def unregister() -> None:
    del bpy.types.Scene.asdf_vk
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)


if __name__ == "__main__":
    register()
