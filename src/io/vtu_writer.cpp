#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "io/base64_stream.h"
#include "io/input_corners.h"
#include "io/result_formats.h"

namespace asdfvk {
namespace {

template <typename T>
constexpr std::string_view vtkTypeName() {
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, uint8_t>) return "UInt8";
}

// What VTK calls a cell of so many corners: empty cell, vertex, line, triangle, polygon.
uint8_t cellTypeOf(size_t cornerCount) {
  constexpr std::array<uint8_t, 4> kTypes{0, 1, 3, 5};
  return cornerCount < kTypes.size() ? kTypes[cornerCount] : uint8_t{7};
}

class VtuFile {
 public:
  VtuFile(AtomicFile& file, bool wideHeader) : file_(file), wideHeader_(wideHeader) {}

  /// `emit` is called with a function that takes the values of the array, `count` of them, one after another.
  template <typename T, typename Emit>
  void writeArray(std::string_view attributes, uint64_t count, Emit emit) {
    file_.write(fmt::format("<DataArray type=\"{}\" {} format=\"binary\">", vtkTypeName<T>(), attributes));
    Base64Stream stream(file_);
    const uint64_t byteCount = count * sizeof(T);
    wideHeader_ ? stream.put(byteCount) : stream.put(static_cast<uint32_t>(byteCount));
    emit([&](T value) { stream.put(value); });
    stream.finish();
    file_.write("</DataArray>\n");
  }

 private:
  AtomicFile& file_;
  bool wideHeader_;  ///< UInt64 sizes.
};

template <typename T>
void writePoints(VtuFile& vtu, const TriangleMesh& mesh) {
  vtu.writeArray<T>("Name=\"Points\" NumberOfComponents=\"3\"", 3 * uint64_t{mesh.vertices.size()}, [&](auto put) {
    for (const Vec3d& p : mesh.vertices)
      for (size_t axis = 0; axis < 3; ++axis) put(static_cast<T>(p[axis]));
  });
}

template <typename T>
void writeCells(VtuFile& vtu, const TriangleMesh& mesh) {
  const uint64_t cellCount = mesh.inputFaceCount();
  vtu.writeArray<T>("Name=\"connectivity\"", inputCornerCount(mesh), [&](auto put) {
    for (uint64_t i = 0; i < cellCount; ++i)
      for (const uint32_t corner : inputFaceCorners(mesh, i)) put(static_cast<T>(corner));
  });
  vtu.writeArray<T>("Name=\"offsets\"", cellCount, [&](auto put) {
    uint64_t end = 0;
    for (uint64_t i = 0; i < cellCount; ++i) put(static_cast<T>(end += inputFaceCorners(mesh, i).size()));
  });
  vtu.writeArray<uint8_t>("Name=\"types\"", cellCount, [&](auto put) {
    for (uint64_t i = 0; i < cellCount; ++i) put(cellTypeOf(inputFaceCorners(mesh, i).size()));
  });
}

}  // namespace

void writeVtu(AtomicFile& file, const TriangleMesh& mesh, const FaceValues& face) {
  const bool isFloat = verticesAreFloats(mesh);
  const uint64_t cellCount = mesh.inputFaceCount(), cornerCount = inputCornerCount(mesh);
  const uint64_t largest = std::max(cornerCount, mesh.vertices.size());
  const bool wideIndices = largest > uint64_t{std::numeric_limits<int32_t>::max()};
  const uint64_t mostBytes = std::max(std::max(cornerCount, cellCount) * (wideIndices ? 8 : 4),
                                      3 * uint64_t{mesh.vertices.size()} * (isFloat ? 4 : 8));
  const bool wideHeader = mostBytes > std::numeric_limits<uint32_t>::max();
  file.write(
      fmt::format("<?xml version=\"1.0\"?>\n"
                  "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"{}\">\n"
                  "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
                  wideHeader ? "UInt64" : "UInt32", mesh.vertices.size(), cellCount));
  VtuFile vtu(file, wideHeader);
  isFloat ? writePoints<float>(vtu, mesh) : writePoints<double>(vtu, mesh);
  file.write("</Points>\n<Cells>\n");
  wideIndices ? writeCells<int64_t>(vtu, mesh) : writeCells<int32_t>(vtu, mesh);
  file.write("</Cells>\n<CellData Scalars=\"sdf\">\n");
  vtu.writeArray<float>("Name=\"sdf\"", cellCount, [&](auto put) {
    for (const double value : face.values) put(std::isnan(value) ? 0.0f : static_cast<float>(value));
  });
  vtu.writeArray<uint8_t>("Name=\"seed\"", cellCount, [&](auto put) {
    for (const uint8_t isSeed : face.isSeed) put(static_cast<uint8_t>(isSeed != 0));
  });
  file.write("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace asdfvk
