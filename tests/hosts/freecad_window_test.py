"""Run by FreeCAD with a window, under Xvfb: the panel of the macro, its button to cancel, and a picture of the window."""

import os
import runpy
import traceback
from pathlib import Path

import FreeCAD
import FreeCADGui
import Mesh
import Part
from checks import Checks
from PySide import QtCore, QtGui

import asdf_vk

checks = Checks("FreeCAD window")
picture = Path(os.environ["ASDF_VK_SHOTS"]) / "freecad.png"
vector = FreeCAD.Vector
macro = os.path.join(os.path.dirname(asdf_vk.__file__), "hosts", "asdf_vk_freecad.py")


def wait(milliseconds):
    """Lets FreeCAD draw."""
    loop = QtCore.QEventLoop()
    QtCore.QTimer.singleShot(milliseconds, loop.quit)
    loop.exec_()


def bracket():
    """An angle bracket with a hole near its edge and a thin rib."""
    shape = Part.makeBox(40, 30, 4).fuse(Part.makeBox(4, 30, 30))
    rib = Part.Face(Part.makePolygon([vector(3, 0, 3), vector(26, 0, 3), vector(3, 0, 26), vector(3, 0, 3)]))
    shape = shape.fuse(rib.extrude(vector(0, 0.7, 0)).translated(vector(0, 22, 0)))
    for x, y, radius in ((32, 4.6, 4), (14, 10, 3)):
        shape = shape.cut(Part.makeCylinder(radius, 10, vector(x, y, -1)))
    return shape.removeSplitter()


def main():
    window = FreeCADGui.getMainWindow()
    window.resize(1050, 640)
    document = FreeCAD.newDocument("Bracket")
    obj = document.addObject("Part::Feature", "Bracket")
    obj.Shape = bracket()
    document.recompute()
    view = FreeCADGui.activeDocument().activeView()
    FreeCADGui.Selection.addSelection(obj)
    names = runpy.run_path(macro, run_name="__main__")  # FreeCAD runs macros in the same way.
    checks.that("the macro shows its panel", FreeCADGui.Control.activeDialog())
    FreeCADGui.Control.closeDialog()
    read = asdf_vk.read_mesh("big.ply")
    big = document.addObject("Mesh::Feature", "Big")
    big.Mesh = Mesh.Mesh(read.vertices[read.faces].tolist())
    panel = names["Panel"](big)

    def cancel():
        for dialog in panel.form.findChildren(QtGui.QProgressDialog):
            dialog.cancel()

    timer = QtCore.QTimer()
    timer.timeout.connect(cancel)
    timer.start(1)
    panel.run()
    timer.stop()
    checks.that(f"cancelled: {panel.result.text()!r}", panel.result.text() == "cancelled" and len(document.Objects) == 2)
    document.removeObject("Big")

    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(obj)
    panel = names["show_panel"]()

    panel.limit.setValue(1)
    panel.button.click()
    checks.that(f"result {panel.result.text()!r}", "FAIL" in panel.result.text() and "0.6" in panel.result.text())
    checks.that(f"{panel.places.count()} places", panel.places.count() >= 2)
    mesh = document.getObjectsByLabel("Thickness of Bracket")[0].Group[0]
    checks.that("colours are shown", mesh.ViewObject.Coloring and not obj.ViewObject.Visibility)
    view.viewIsometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    wait(1500)
    before = view.getCamera()
    panel.places.setCurrentRow(0)
    wait(800)
    selection = FreeCADGui.Selection.getSelection()
    checks.that("a click selects the place", [s.Label for s in selection] == [panel.places.item(0).text()])
    checks.that("and moves the view to it", view.getCamera() != before)
    FreeCADGui.SendMsgToActiveView("ViewFit")
    wait(1500)
    image = QtGui.QApplication.primaryScreen().grabWindow(int(window.winId()))
    image.save(str(picture))
    checks.picture(picture)
    document.undo()
    checks.that("undo removes the result", [o.Name for o in document.Objects] == ["Bracket"])
    panel.reject()
    checks.that("the panel closes", not FreeCADGui.Control.activeDialog())


def start():
    try:
        main()
    except Exception:
        traceback.print_exc()
        checks.that("no exception", False)
    checks.finish()


QtCore.QTimer.singleShot(2500, start)
