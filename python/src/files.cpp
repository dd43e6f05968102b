#include "bindings.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>

#include "arrays.h"
#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "gil.h"
#include "interruptible.h"
#include "io/formats.h"
#include "mesh/input_faces.h"
#include "report.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

Mesh readWithoutGil(const std::filesystem::path& path, const std::string& format, uint64_t maxFaces,
                    double chordError) {
  requireSameProcess();
  const GilRelease released;
  return readMesh(path, {.maxFaces = maxFaces, .format = format, .chordError = chordError});
}

Mesh parseWithoutGil(const py::bytes& bytes, const std::string& format, uint64_t maxFaces, double chordError) {
  requireSameProcess();
  const std::string_view contents(bytes);
  const GilRelease released;
  return parseMesh(contents, {.maxFaces = maxFaces, .format = format, .chordError = chordError});
}

py::array verticesOf(const py::object& self) {
  const auto& mesh = self.cast<const Mesh&>();
  return viewAsArray(reinterpret_cast<const double*>(mesh.vertices.data()),
                     {static_cast<py::ssize_t>(mesh.vertices.size()), 3}, self);
}

py::array facesOf(const py::object& self) {
  const auto& mesh = self.cast<const Mesh&>();
  return viewAsArray(reinterpret_cast<const int32_t*>(mesh.faces.data()),
                     {static_cast<py::ssize_t>(mesh.faces.size()), 3}, self);
}

py::object faceOfTriangle(const py::object& self) {
  const std::vector<uint32_t>& faces = self.cast<const Mesh&>().polygons.inputFaceOf;
  if (faces.empty()) return py::none();
  return viewAsArray(reinterpret_cast<const int32_t*>(faces.data()), {static_cast<py::ssize_t>(faces.size())}, self);
}

/// vertices: 3 #V doubles. Face i has the corners corners[firstCorner[i]] .. corners[firstCorner[i + 1] - 1].
/// Precondition: all indices are in range.
Mesh meshOfPolygons(const py::array& vertices, const py::array& corners, const py::array& firstCorner) {
  const std::span<const double> numbers = entriesOf<double>(vertices);
  const std::span<const uint32_t> allCorners = entriesOf<uint32_t>(corners), first = entriesOf<uint32_t>(firstCorner);
  const GilRelease released;
  Mesh mesh;
  mesh.vertices.reserve(numbers.size() / 3);
  for (size_t i = 0; i + 2 < numbers.size(); i += 3)
    mesh.vertices.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  InputFaces faces;
  faces.reserve(first.size() - 1);
  for (size_t i = 0; i + 1 < first.size(); ++i) faces.add(allCorners.subspan(first[i], first[i + 1] - first[i]));
  faces.moveTo(mesh);
  return mesh;
}

void write(const std::filesystem::path& path, const py::object& mesh, const py::dict& perFace,
           const py::dict& perVertex, const std::string& format, bool ascii) {
  requireSameProcess();
  const std::vector<Field> fields = fieldsOf(perFace, perVertex);
  const MeshView view = viewOf(mesh);
  const GilRelease released;
  writeResult(path, view, fields, {.format = format, .fields = {}, .ascii = ascii});
}

void writePointsOf(const std::filesystem::path& path, const py::dict& perFace) {
  requireSameProcess();
  const std::vector<Field> fields = fieldsOf(perFace, {});
  runInterruptibly([&](const RunControl& control) { writePoints(path, fields, control); }, py::none());
}

/// (first face, name) of each object.
py::tuple objectsOf(const Mesh& mesh) {
  py::list objects;
  for (const NamedFaces& object : mesh.objects) objects.append(py::make_tuple(object.firstFace, object.name));
  return py::tuple(objects);
}

py::tuple stateOf(const Mesh& mesh) {
  const Polygons& polygons = mesh.polygons;
  return py::make_tuple(bytesOf(mesh.vertices), bytesOf(mesh.faces), bytesOf(polygons.firstCorner),
                        bytesOf(polygons.corners), bytesOf(polygons.inputFaceOf), mesh.unit, mesh.statedPartCount,
                        mesh.skipped, mesh.negativeVolumeCount, mesh.chordError, mesh.float32Step, objectsOf(mesh));
}

Mesh meshOf(const py::tuple& state) {
  if (state.size() != 12) throw Error(ErrorCode::ArraySize, "the pickled mesh does not have twelve members");
  Mesh mesh;
  readBytes(state[0], mesh.vertices);
  readBytes(state[1], mesh.faces);
  readBytes(state[2], mesh.polygons.firstCorner);
  readBytes(state[3], mesh.polygons.corners);
  readBytes(state[4], mesh.polygons.inputFaceOf);
  mesh.unit = state[5].cast<std::string>();
  mesh.statedPartCount = state[6].cast<uint32_t>();
  mesh.skipped = state[7].cast<std::vector<std::string>>();
  mesh.negativeVolumeCount = state[8].cast<uint32_t>();
  mesh.chordError = state[9].cast<double>();
  mesh.float32Step = state[10].cast<double>();
  for (const py::handle& object : state[11].cast<py::tuple>()) {
    auto [firstFace, name] = object.cast<std::pair<uint64_t, std::string>>();
    mesh.objects.push_back({firstFace, std::move(name)});
  }
  return mesh;
}

}  // namespace

void bindFiles(py::module_& module) {
  py::class_<Mesh>(module, "Mesh", "A mesh as read_mesh() returns it: all faces of the file, in the order of the file.")
      .def_property_readonly("vertices", verticesOf, "(n, 3) float64, in the unit of the file; read-only.")
      .def_property_readonly("faces", facesOf,
                             "(m, 3) int32 triangles, counter-clockwise seen from outside; read-only.")
      .def_property_readonly("face_count", &Mesh::inputFaceCount,
                             "Number of faces of the file. Functions return a value for each face.")
      .def_property_readonly("face_of_triangle", faceOfTriangle,
                             "(m,) int32: index of the file's face per triangle; None if all faces are triangles.")
      .def_property_readonly(
          "unit", [](const Mesh& self) { return self.unit; },
          "Unit of length that the file states (3MF, glTF, STEP), for example \"mm\"; empty for other formats.")
      .def_property_readonly("objects", objectsOf,
                             "(first face, name) of each object that the file names, in the order of the file.")
      .def("__repr__",
           [](const Mesh& self) {
             return "<asdf_vk.Mesh, " + std::to_string(self.vertices.size()) + " vertices, " +
                    std::to_string(self.inputFaceCount()) + " faces>";
           })
      .def(py::pickle([](const Mesh& mesh) { return stateOf(mesh); },
                      [](const py::tuple& state) { return meshOf(state); }));
  module.def("read_mesh", readWithoutGil);
  module.def("parse_mesh", parseWithoutGil);
  module.def("mesh_extensions", meshExtensions);
  module.def("mesh_of_polygons", meshOfPolygons);
  module.def("join_meshes", [](const std::vector<const Mesh*>& meshes, const std::vector<std::string>& names) {
    return joinMeshes(meshes, names);
  });
  module.def("has_text", [](const std::string& format) {
    const FileFormat* const row = formatOfExtension(format);
    return row != nullptr && row->hasText;
  });
  module.def("write", write);
  module.def("write_points", writePointsOf);
}

}  // namespace asdfvk::python
