// The module that reads STEP (src/io/step_module.h). The plain reader of Open CASCADE is used, not the one for
// documents of applications, because the latter opens the files to which a file refers.
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Interface_Check.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>
#include <StepData_StepModel.hxx>
#include <StepShape_FaceSurface.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <istream>
#include <map>
#include <mutex>
#include <new>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "io/opencascade/body_names.h"
#include "io/opencascade/deviation.h"
#include "io/step_module.h"

namespace asdfvk {
namespace {

struct Stopped {};
struct Failed {
  std::string reason;
};

class MemoryBuffer : public std::streambuf {
 public:
  MemoryBuffer(const char* bytes, uint64_t size) {
    char* const begin = const_cast<char*>(bytes);  // The interface of std::streambuf is not const, but reads only.
    setg(begin, begin, begin + size);
  }
};

/// Open CASCADE prints to standard output. The printers are restored, because the process may use Open CASCADE itself.
class SilentMessenger {
 public:
  SilentMessenger() : kept_(printers()) { printers().Clear(); }
  ~SilentMessenger() { printers() = kept_; }
  SilentMessenger(const SilentMessenger&) = delete;
  SilentMessenger& operator=(const SilentMessenger&) = delete;

 private:
  static Message_SequenceOfPrinters& printers() { return Message::DefaultMessenger()->ChangePrinters(); }

  Message_SequenceOfPrinters kept_;
};

/// Sets the unit of lengths that were read, a variable of the process that other users of Open CASCADE may have
/// changed.
class LengthsInMillimetres {
 public:
  LengthsInMillimetres() : kept_(Interface_Static::CVal(kName)) { Interface_Static::SetCVal(kName, "MM"); }
  ~LengthsInMillimetres() { Interface_Static::SetCVal(kName, kept_.c_str()); }
  LengthsInMillimetres(const LengthsInMillimetres&) = delete;
  LengthsInMillimetres& operator=(const LengthsInMillimetres&) = delete;

 private:
  static constexpr const char* kName = "xstep.cascade.unit";

  std::string kept_;
};

void require(bool continues) {
  if (!continues) throw Stopped{};
}

/// Open CASCADE follows references of geometry without a test whether they exist and have the right type.
void requireSound(const Handle(StepData_StepModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Interface_Check) check = model->Check(i, true);
    if (!check->HasFailed()) continue;
    const Handle(Standard_Transient) entity = model->Value(i);
    const std::string_view type = entity->DynamicType()->Name();
    if (!type.starts_with("StepGeom_") && !type.starts_with("StepShape_") && !type.starts_with("StepRepr_")) continue;
    throw Failed{std::string(model->StringLabel(entity)->ToCString()) + ": " + check->CFail(1)};
  }
}

/// Number of shapes of a kind that are not part of a shape of another kind.
uint64_t countLoose(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum notIn) {
  uint64_t count = 0;
  for (TopExp_Explorer loose(shape, kind, notIn); loose.More(); loose.Next()) ++count;
  return count;
}

class StepRead {
 public:
  explicit StepRead(StepModuleCall& call) : call_(call) {}

  void run() {
    const LengthsInMillimetres lengths;
    load();
    transfer();
    names_.read(reader_.StepModel(), process());
    for (const TopoDS_Shape& root : roots_) names_.addRoot(root);
    const double chordError = chooseChordError();
    for (const TopoDS_Shape& root : roots_) addBodiesOf(root, chordError);
  }

 private:
  void load() {
    MemoryBuffer buffer(call_.bytes, call_.size);
    std::istream stream(&buffer);
    if (reader_.ReadStream("", stream) != IFSelect_RetDone) throw Failed{"Open CASCADE cannot parse the file"};
    requireSound(reader_.StepModel());
    if (reader_.NbRootsForTransfer() == 0) throw Failed{"no product of the file has a shape"};
  }

  void transfer() {
    reader_.TransferRoots();
    for (int i = 1; i <= reader_.NbShapes(); ++i) roots_.push_back(reader_.Shape(i));
    const Handle(StepData_StepModel) model = reader_.StepModel();
    for (int i = 1; i <= model->NbEntities(); ++i) {
      const Handle(StepShape_FaceSurface) face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
      if (!face.IsNull() && TransferBRep::ShapeResult(process(), face).IsNull()) ++call_.failedFaceCount;
    }
#if OCC_VERSION_HEX < 0x070700
    const std::string_view text(call_.bytes, call_.size), name = "TRIANGULATED_FACE";
    for (size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) ++call_.tessellatedCount;
#endif
  }

  Handle(Transfer_TransientProcess) process() { return reader_.WS()->TransferReader()->TransientProcess(); }

  double chooseChordError() {
    TColStd_SequenceOfAsciiString lengths, angles, solidAngles;
    reader_.FileUnits(lengths, angles, solidAngles);
    const char* unit = lengths.IsEmpty() ? "" : lengths.First().ToCString();
    for (int i = 1; i <= lengths.Length(); ++i)
      if (lengths.Value(i) != lengths.First()) unit = "";
    Bnd_Box box;
    for (const TopoDS_Shape& root : roots_) BRepBndLib::Add(root, box, false);
    double min[3]{}, max[3]{}, chordError = 0;
    if (!box.IsVoid()) box.Get(min[0], min[1], min[2], max[0], max[1], max[2]);
    require(call_.setChordError(call_.context, unit, min, max, &chordError));
    return chordError;
  }

  /// Solids, shells outside of solids, and faces outside of shells are bodies.
  void addBodiesOf(const TopoDS_Shape& root, double chordError) {
    for (TopExp_Explorer solid(root, TopAbs_SOLID); solid.More(); solid.Next()) addBody(solid.Current(), chordError);
    for (TopExp_Explorer shell(root, TopAbs_SHELL, TopAbs_SOLID); shell.More(); shell.Next())
      addBody(shell.Current(), chordError);
    for (TopExp_Explorer face(root, TopAbs_FACE, TopAbs_SHELL); face.More(); face.Next())
      addBody(face.Current(), chordError);
    call_.curveCount += countLoose(root, TopAbs_EDGE, TopAbs_FACE);
    call_.pointCount += countLoose(root, TopAbs_VERTEX, TopAbs_EDGE);
  }

  void addBody(const TopoDS_Shape& placed, double chordError) {
    const TopoDS_Shape body = placed.Located(TopLoc_Location());
    const auto [entry, isNew] = bodies_.try_emplace({body.TShape().get(), body.Orientation()}, bodies_.size());
    if (isNew) triangulate(body, chordError);
    const gp_Trsf place = placed.Location().Transformation();
    double columns[12];
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) columns[3 * column + row] = place.Value(row + 1, column + 1);
    require(call_.placeBody(call_.context, entry->second, columns));
  }

  /// Open CASCADE needs about 4 KB per triangle, and for a million triangles of one face minutes. A fine triangulation
  /// is therefore extrapolated from two coarse ones before it is made.
  void requireTriangleCount(const TopoDS_Shape& body, double chordError) {
    constexpr double kFine = 2e-5,
                     kStep = 4;  // Relative to the diagonal; finer bodies have 100,000 triangles and more.
    Bnd_Box box;
    BRepBndLib::Add(body, box, false);
    if (box.IsVoid() || chordError > kFine * std::sqrt(box.SquareExtent())) return;
    double counts[2]{};
    for (const int i : {0, 1}) {
      const TopoDS_Shape copy = BRepBuilderAPI_Copy(body).Shape();
      mesh(copy, chordError * (i == 0 ? kStep * kStep * kStep : kStep * kStep));
      for (TopExp_Explorer face(copy, TopAbs_FACE); face.More(); face.Next()) {
        TopLoc_Location ignored;
        const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(TopoDS::Face(face.Current()), ignored);
        if (!triangles.IsNull()) counts[i] += triangles->NbTriangles();
      }
    }
    const double growth = counts[0] > 0 ? std::max(counts[1] / counts[0], 1.0) : 1.0;
    require(call_.expectTriangles(call_.context, counts[1] * growth * growth));
  }

  /// Not in parallel, so that each run gives the same bits.
  void mesh(const TopoDS_Shape& body, double chordError) const {
    BRepMesh_IncrementalMesh(body, chordError, false, call_.maxAngleRadians, false);
  }

  /// Open CASCADE may exceed the chord error, on spheres twice. Then the body is triangulated again.
  void triangulate(const TopoDS_Shape& body, double chordError) {
    constexpr int kTryCount = 4;
    constexpr double kFiner = 0.45;
    requireTriangleCount(body, chordError);
    double asked = chordError, found = 0;
    for (int i = 0; i < kTryCount; ++i, asked *= kFiner) {
      BRepTools::Clean(body);
      mesh(body, asked);
      found = 0;
      for (TopExp_Explorer face(body, TopAbs_FACE); face.More(); face.Next())
        found = std::max(found, deviationOf(TopoDS::Face(face.Current()), chordError));
      if (found <= chordError) break;
    }
    call_.foundChordError = std::max(call_.foundChordError, found);
    points_.clear();
    corners_.clear();
    for (TopExp_Explorer face(body, TopAbs_FACE); face.More(); face.Next()) addFace(TopoDS::Face(face.Current()));
    require(call_.addBody(call_.context, names_.of(body), points_.data(), points_.size() / 3, corners_.data(),
                          corners_.size() / 3));
  }

  void addFace(const TopoDS_Face& face) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, location);
    if (triangles.IsNull() || triangles->NbTriangles() == 0) {
      ++call_.failedFaceCount;
      return;
    }
    const gp_Trsf place = location.Transformation();
    const auto first = static_cast<uint32_t>(points_.size() / 3);
    for (int i = 1; i <= triangles->NbNodes(); ++i) {
      const gp_Pnt point = triangles->Node(i).Transformed(place);
      points_.insert(points_.end(), {point.X(), point.Y(), point.Z()});
    }
    const bool isReversed = (face.Orientation() == TopAbs_REVERSED) != place.IsNegative();
    for (int i = 1; i <= triangles->NbTriangles(); ++i) {
      int a = 0, b = 0, c = 0;
      triangles->Triangle(i).Get(a, b, c);
      if (isReversed) std::swap(b, c);
      for (const int corner : {a, b, c}) corners_.push_back(first + static_cast<uint32_t>(corner) - 1);
    }
  }

  StepModuleCall& call_;
  STEPControl_Reader reader_;
  std::vector<TopoDS_Shape> roots_;
  BodyNames names_;
  std::map<std::pair<const void*, TopAbs_Orientation>, uint64_t> bodies_;
  std::vector<double> points_;
  std::vector<uint32_t> corners_;
};

StepModuleStatus fail(StepModuleCall& call, const char* reason) {
  std::strncpy(call.error, reason, sizeof(call.error) - 1);
  return StepModuleStatus::Failed;
}

}  // namespace
}  // namespace asdfvk

extern "C" __attribute__((visibility("default"))) asdfvk::StepModuleStatus asdfvk_read_step(
    asdfvk::StepModuleCall* call) {
  using namespace asdfvk;
  if (call->version != kStepModuleVersion) return StepModuleStatus::OtherVersion;
  static std::mutex mutex;  // Readers of Open CASCADE share state.
  const std::lock_guard<std::mutex> lock(mutex);
  try {
    const SilentMessenger silent;
    StepRead(*call).run();
    return StepModuleStatus::Done;
  } catch (const Stopped&) {
    return StepModuleStatus::Stopped;
  } catch (const Failed& failure) {
    return fail(*call, failure.reason.c_str());
  } catch (const std::bad_alloc&) {
    return StepModuleStatus::OutOfMemory;
  } catch (const Standard_Failure& failure) {
    return fail(*call, failure.GetMessageString());
  } catch (const std::exception& failure) {
    return fail(*call, failure.what());
  } catch (...) {
    return fail(*call, "an unknown exception");
  }
}
