#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asdf_vk/error.h"
#include "io/colour_map.h"
#include "io/input_corners.h"
#include "io/number_text.h"
#include "io/result_formats.h"

namespace asdfvk {
namespace {

/// Puts numbers one after another as bytes, or as words with a blank between them.
class RowWriter {
 public:
  RowWriter(AtomicFile& file, bool ascii) : file_(file), ascii_(ascii) {}

  template <typename T>
  void put(T value) {
    if (!ascii_) return file_.put(value);
    char* const word = file_.reserve(kNumberTextSize + 1);
    char* to = word;
    if (!isFirst_) *to++ = ' ';
    if constexpr (sizeof(T) == 1) {
      to = appendNumber(to, static_cast<int>(value));
    } else {
      to = appendNumber(to, value);
    }
    file_.advance(static_cast<size_t>(to - word));
    isFirst_ = false;
  }
  void endRow() {
    if (ascii_) file_.put('\n');
    isFirst_ = true;
  }

 private:
  AtomicFile& file_;
  bool ascii_;
  bool isFirst_ = true;
};

template <typename T>
void writeVertices(RowWriter& row, const TriangleMesh& mesh) {
  for (const Vec3d& p : mesh.vertices) {
    row.put(static_cast<T>(p.x));
    row.put(static_cast<T>(p.y));
    row.put(static_cast<T>(p.z));
    row.endRow();
  }
}

template <typename Count>
void writeFaces(RowWriter& row, const TriangleMesh& mesh, const FaceValues& face) {
  const ColourRange range = percentileRange(face.values);
  for (uint64_t i = 0; i < mesh.inputFaceCount(); ++i) {
    const auto corners = inputFaceCorners(mesh, i);
    row.put(static_cast<Count>(corners.size()));
    for (const uint32_t corner : corners) row.put(static_cast<int32_t>(corner));
    const double value = face.values[i];
    row.put(std::isnan(value) ? 0.0f : static_cast<float>(value));
    for (const uint8_t channel : colourOf(value, range)) row.put(channel);
    row.endRow();
  }
}

}  // namespace

void writePly(AtomicFile& file, const TriangleMesh& mesh, const FaceValues& face, bool ascii) {
  if (mesh.vertices.size() > size_t{std::numeric_limits<int32_t>::max()})
    throw Error(ErrorCode::OutputNotWritable,
                "the mesh has more vertices than PLY's int can index; write .npy or .csv");
  size_t mostCorners = 3;
  for (uint64_t i = 0; i < mesh.inputFaceCount() && !mesh.polygons.isEmpty(); ++i)
    mostCorners = std::max(mostCorners, inputFaceCorners(mesh, i).size());
  const bool isByteCount = mostCorners <= std::numeric_limits<uint8_t>::max();
  const bool isFloat = verticesAreFloats(mesh);
  file.write(
      fmt::format("ply\nformat {} 1.0\n"
                  "comment asdf-vk: quality is the shape diameter function, 0 (and grey) where there is no value\n"
                  "element vertex {}\nproperty {scalar} x\nproperty {scalar} y\nproperty {scalar} z\n"
                  "element face {}\nproperty list {} int vertex_indices\nproperty float quality\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nend_header\n",
                  ascii ? "ascii" : "binary_little_endian", mesh.vertices.size(), mesh.inputFaceCount(),
                  isByteCount ? "uchar" : "int", fmt::arg("scalar", isFloat ? "float" : "double")));
  RowWriter row(file, ascii);
  isFloat ? writeVertices<float>(row, mesh) : writeVertices<double>(row, mesh);
  isByteCount ? writeFaces<uint8_t>(row, mesh, face) : writeFaces<int32_t>(row, mesh, face);
}

}  // namespace asdfvk
