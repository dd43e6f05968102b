// Writes the STEP files of tests/io/step_test.cpp into the folder that the argument names.
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <cstdio>
#include <initializer_list>
#include <string>

namespace {

TopoDS_Shape compoundOf(std::initializer_list<TopoDS_Shape> shapes) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
  return compound;
}

TopoDS_Shape movedBy(const TopoDS_Shape& shape, double x) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(x, 0, 0));
  return shape.Moved(TopLoc_Location(move));
}

TopoDS_Shape mirrored(const TopoDS_Shape& shape) {
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2(gp_Pnt(-5, 0, 0), gp_Dir(1, 0, 0)));
  return BRepBuilderAPI_Transform(shape, mirror, true).Shape();
}

TopoDS_Shape tube(double radius, double wall) {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(radius, 30).Shape(),
                         BRepPrimAPI_MakeCylinder(radius - wall, 30).Shape())
      .Shape();
}

TopoDS_Shape rounded(const TopoDS_Shape& box) {
  BRepFilletAPI_MakeFillet fillet(box);
  for (TopExp_Explorer edge(box, TopAbs_EDGE); edge.More(); edge.Next()) fillet.Add(3, TopoDS::Edge(edge.Current()));
  return fillet.Shape();
}

/// A box without its first face, as a shell.
TopoDS_Shape openBox(const TopoDS_Shape& box) {
  BRepBuilderAPI_Sewing sewing;
  TopExp_Explorer face(box, TopAbs_FACE);
  for (face.Next(); face.More(); face.Next()) sewing.Add(face.Current());
  sewing.Perform();
  return sewing.SewedShape();
}

bool write(const std::string& folder, const char* name, const TopoDS_Shape& shape, const char* unit = "MM") {
  Interface_Static::SetCVal("write.step.unit", unit);  // Read by the constructor of the writer.
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  return writer.Write((folder + "/" + name + ".step").c_str()) == IFSelect_RetDone;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::string folder = arguments[1];
  STEPControl_Controller::Init();  // Defines the options of Interface_Static.
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 20, 30).Shape(),
                     line = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 2, 3)).Shape(),
                     point = BRepBuilderAPI_MakeVertex(gp_Pnt(1, 2, 3)).Shape();
  TopExp_Explorer firstFace(box, TopAbs_FACE);
  const bool isWritten =
      write(folder, "box", box) && write(folder, "inch", box, "INCH") && write(folder, "metre", box, "M") &&
      write(folder, "tube", tube(10, 1)) && write(folder, "sphere", BRepPrimAPI_MakeSphere(10).Shape()) &&
      write(folder, "torus", BRepPrimAPI_MakeTorus(10, 4).Shape()) &&
      write(folder, "cone", BRepPrimAPI_MakeCone(10, 0, 20).Shape()) && write(folder, "rounded", rounded(box)) &&
      write(folder, "assembly", compoundOf({box, movedBy(box, 100), mirrored(box)})) &&
      write(folder, "shell", openBox(box)) && write(folder, "face", firstFace.Current()) &&
      write(folder, "curve", line) && write(folder, "box_curve_point", compoundOf({box, line, point}));
  if (!isWritten) std::fputs("a file cannot be written\n", stderr);
  return isWritten ? 0 : 1;
}
