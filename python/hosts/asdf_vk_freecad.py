"""Macro for FreeCAD 0.20 and later: compares the wall thickness of the selected shape with a limit in mm.

Copy this file into the folder of macros (Macro, Macros, User macros location). Select a solid or a mesh, and run the
macro. A panel asks for the limit. The result is a group with the thin places and a coloured mesh. The colours show the
thickness; red is below the limit. A click on a place, in the panel or in the tree, shows the place. Scripts, also with
freecadcmd, call check():

    import asdf_vk_freecad
    report = asdf_vk_freecad.check(document.Body, 0.8).thickness
    print(report.verdict, report.min)
"""

from __future__ import annotations

import sys

import FreeCAD
import Mesh
import MeshPart
import numpy as np
import Part

PLACE_COUNT = 50  # Greatest number of listed places.
# Greatest number of triangles after division. Large triangles are divided, so that the colours show thin places.
TRIANGLE_COUNT = 40000
RED = (0.85, 0.1, 0.1)


def module():
    """Imports the Python package asdf_vk. Raises ImportError with a remedy."""
    try:
        import asdf_vk.hosts
    except ImportError as error:
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        raise ImportError(
            f"the Python package asdf_vk cannot be imported ({error}); install it for Python {version}, or start FreeCAD "
            "with the option -P FOLDER, the folder that holds it"
        ) from error
    return asdf_vk


def length(value: float, limit: float) -> str:
    """Text of a length in mm: four digits, or up to six to differ from the text of the limit."""
    return module().hosts.digits_of(lambda number, digits: f"{number:.{digits}g} mm", value, limit)


def summary(report) -> str:
    return module().hosts.verdict_text(report, lambda value: length(value, report.thinner_than))


def triangles_of(obj, deviation: float):
    """Returns vertices (n, 3), in mm and document coordinates, and triangles (m, 3). Solids do not share vertices."""
    if obj.isDerivedFrom("Mesh::Feature"):
        placed = obj.Mesh.copy()
        placed.Placement = obj.getGlobalPlacement()
        meshes = [placed]
    elif hasattr(obj, "getGlobalPlacement") and getattr(obj, "Shape", None) is not None and obj.Shape.Faces:
        shape = obj.Shape.copy()
        shape.Placement = obj.getGlobalPlacement()
        settings = {"LinearDeflection": deviation, "AngularDeflection": 0.3, "Relative": False}
        of_solids = {face.hashCode() for solid in shape.Solids for face in solid.Faces}
        loose = [face for face in shape.Faces if face.hashCode() not in of_solids]
        pieces = [*shape.Solids, Part.Compound(loose)] if loose and of_solids else shape.Solids or [shape]
        meshes = [MeshPart.meshFromShape(Shape=piece, **settings) for piece in pieces]
    else:
        meshes = []
    if not any(mesh.CountFacets for mesh in meshes):
        raise ValueError(f"{obj.Label} has no faces; select a solid, a body, a mesh, or the original of a link")
    vertices, triangles, count = [], [], 0
    for mesh in meshes:
        points, faces = mesh.Topology
        vertices.append(np.array([tuple(point) for point in points], np.float64).reshape(-1, 3))
        triangles.append(np.array(faces, np.int64).reshape(-1, 3) + count)
        count += len(points)
    return divided(np.concatenate(vertices), np.concatenate(triangles))


def divided(vertices, triangles):
    """Divides each triangle into four until no edge is longer than 1/60 of the diagonal. The surface is unchanged."""
    longest = np.linalg.norm(np.ptp(vertices, axis=0)) / 60
    while 4 * len(triangles) <= TRIANGLE_COUNT:
        ends = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        if np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1).max() <= longest:
            break
        edges, of_triangle = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
        (a, b, c), (ab, bc, ca) = triangles.T, (of_triangle.reshape(-1, 3) + len(vertices)).T
        vertices = np.concatenate([vertices, vertices[edges].mean(axis=1)])
        corners = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
        triangles = np.stack([np.stack(corner, axis=1) for corner in corners], axis=1).reshape(-1, 3)
    return vertices, triangles


def check(obj, limit: float, deviation: float = 0.05, count_details=False, count_edges=False, progress=None):
    """Checks the walls of an object, and adds the result to its document.

    limit: in mm. deviation: greatest distance between the triangles and curved faces, in mm; the measured thickness
    between two curved faces can be too small by twice this length. count_details, count_edges: whether details and edges
    fail, too (docs/thickness.md). progress: called with a fraction from 0 to 1 and a
    text; if it returns False, the check is cancelled. Returns the report of asdf_vk.compute(), for example
    .thickness.verdict, .thickness.min, .thickness.regions, .fields. Raises ImportError, ValueError, asdf_vk.Error. A
    cancelled check (asdf_vk.CancelledError) does not change the document.
    """
    asdf_vk = module()
    if not limit > 0 or not deviation > 0:
        raise ValueError("the limit and the deviation are lengths above 0 mm")
    vertices, triangles = triangles_of(obj, deviation)
    options = {"measure": "thickness", "thinner_than": limit, "count_details": count_details, "count_edges": count_edges}
    info = asdf_vk.compute(vertices, triangles, progress=progress, **options)
    obj.Document.openTransaction("Check wall thickness")
    try:
        add_result(obj, vertices, triangles, info, limit)
    except BaseException:
        obj.Document.abortTransaction()
        raise
    obj.Document.commitTransaction()
    return info


def colours_of(info, limit: float) -> list:
    """Returns colours: red if thinner than the limit, grey without a value, else viridis from the limit upwards."""
    least = info.fields["least_thickness"]
    high = max(float(np.nanmax(least, initial=limit)), limit * 1.001)
    colours = module().hosts.colours_of(least, limit, high, info.thin, grey=0.6)
    return [(*colour, 0.0) for colour in colours.tolist()]


def result_of(obj):
    """Returns the group with the result of the last check of an object, or None if there is no result."""
    return next((group for group in obj.Document.Objects if getattr(group, "CheckedObject", None) == obj.Name), None)


def add_result(obj, vertices, triangles, info, limit: float) -> None:
    """Adds a group with the coloured mesh and the places to the document. Replaces the group of an earlier check."""
    document = obj.Document
    old = result_of(obj)
    if old is not None:
        for child in old.Group:
            document.removeObject(child.Name)
        document.removeObject(old.Name)
    group = document.addObject("App::DocumentObjectGroup", "Thickness")
    group.Label = f"Thickness of {obj.Label}"
    group.addProperty("App::PropertyString", "CheckedObject", "Thickness").CheckedObject = obj.Name
    group.addProperty("App::PropertyLength", "Limit", "Thickness").Limit = limit
    group.addProperty("App::PropertyLength", "LeastThickness", "Thickness").LeastThickness = info.thickness.min
    verdict = module().hosts.VERDICTS[info.thickness.verdict]
    group.addProperty("App::PropertyString", "Verdict", "Thickness").Verdict = verdict

    mesh = document.addObject("Mesh::Feature", "ThicknessMesh")
    mesh.Label = f"{obj.Label}: {summary(info.thickness)}"  # If a label is already in use, FreeCAD appends a number.
    mesh.Mesh = Mesh.Mesh(vertices[triangles].tolist())
    mesh.addProperty("App::PropertyColorList", "FaceColors", "Thickness").FaceColors = colours_of(info, limit)
    values = info.fields["least_thickness"].tolist()
    mesh.addProperty("App::PropertyFloatList", "LeastThickness", "Thickness").LeastThickness = values
    group.addObject(mesh)
    for region in info.thickness.regions[:PLACE_COUNT]:
        group.addObject(add_place(document, region, limit))
    document.recompute()
    if FreeCAD.GuiUp:
        mesh.ViewObject.Coloring = True
        obj.ViewObject.hide()


def add_place(document, region, limit: float):
    """Adds a thin place: a line through the wall, or a point at a sharp edge. The label has the kind."""
    place, opposite = FreeCAD.Vector(*region.place), FreeCAD.Vector(*region.opposite)
    is_point = place.distanceToPoint(opposite) < 1e-7
    line = document.addObject("Part::Feature", "Place")
    line.Shape = Part.Vertex(place) if is_point else Part.makeLine(place, opposite)
    line.Label = f"{region.kind} {length(region.min, limit)} at ({place.x:.4g}, {place.y:.4g}, {place.z:.4g})"
    if FreeCAD.GuiUp:
        view = line.ViewObject
        view.LineWidth, view.PointSize, view.LineColor, view.PointColor = 5, 10, RED, RED
        view.OnTopWhenSelected = "Object"
    return line


def show_place(place) -> None:
    import FreeCADGui

    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(place)
    FreeCADGui.SendMsgToActiveView("ViewSelection")
    try:
        from pivy import coin  # noqa: F401; the type of the camera

        camera = FreeCADGui.activeDocument().activeView().getCameraNode()
    except (ImportError, RuntimeError):
        return
    if hasattr(camera, "height"):  # The height of an orthographic view includes some of the neighbourhood of the place.
        result = place.InList[0].Group[0].Mesh.BoundBox
        camera.height.setValue(max(camera.height.getValue(), 0.4 * result.DiagonalLength))


class Panel:
    def __init__(self, obj) -> None:
        from PySide import QtGui

        self.obj = obj
        self.form = QtGui.QWidget()
        self.form.setWindowTitle("Wall thickness")
        layout = QtGui.QFormLayout(self.form)
        self.limit, self.deviation = QtGui.QDoubleSpinBox(), QtGui.QDoubleSpinBox()
        for box, value, text in ((self.limit, 0.8, "Limit"), (self.deviation, 0.05, "Deviation")):
            box.setDecimals(3)
            box.setRange(0.001, 10000)
            box.setSingleStep(0.1 * value)
            box.setSuffix(" mm")
            box.setValue(value)
            layout.addRow(text, box)
        self.details, self.edges = QtGui.QCheckBox("Count details"), QtGui.QCheckBox("Count edges")
        self.button = QtGui.QPushButton(f"Check {obj.Label}")
        self.result, self.places = QtGui.QLabel(""), QtGui.QListWidget()
        self.result.setWordWrap(True)
        for widget in (self.details, self.edges, self.button, self.result, self.places):
            layout.addRow(widget)
        self.button.clicked.connect(self.run)
        self.places.currentRowChanged.connect(self.go_to)

    def run(self) -> None:
        """Checks the object. The progress dialog can cancel."""
        from PySide import QtCore, QtGui

        dialog = QtGui.QProgressDialog("Checking walls", "Cancel", 0, 100, self.form)
        dialog.setWindowModality(QtCore.Qt.WindowModal)

        def progress(fraction: float, stage: str) -> bool:
            dialog.setValue(int(99 * fraction))
            QtGui.QApplication.processEvents()
            return not dialog.wasCanceled()

        self.places.clear()
        try:
            counted = {"count_details": self.details.isChecked(), "count_edges": self.edges.isChecked()}
            info = check(self.obj, self.limit.value(), self.deviation.value(), progress=progress, **counted)
        except Exception as error:
            self.result.setText("cancelled" if type(error).__name__ == "CancelledError" else str(error))
            return
        finally:
            dialog.close()
        report = info.thickness
        click = " A click shows a place." if report.regions else ""
        self.result.setText(f"{report.sentence}.{click}")
        self.objects = result_of(self.obj).Group[1:]
        self.places.addItems([place.Label for place in self.objects])

    def go_to(self, row: int) -> None:
        if row >= 0:
            show_place(self.objects[row])

    def getStandardButtons(self) -> int:
        from PySide import QtGui

        return int(QtGui.QDialogButtonBox.Close)

    def reject(self) -> None:
        import FreeCADGui

        FreeCADGui.Control.closeDialog()


def show_panel():
    import FreeCADGui

    selection = FreeCADGui.Selection.getSelection()
    if len(selection) != 1:
        FreeCAD.Console.PrintError("asdf-vk: select one solid or mesh, then run the macro\n")
        return None
    panel = Panel(selection[0])
    FreeCADGui.Control.showDialog(panel)
    return panel


if __name__ == "__main__" and FreeCAD.GuiUp:
    show_panel()
