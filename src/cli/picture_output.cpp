#include "cli/picture_output.h"

#include <vector>

#include "asdf_vk/error.h"
#include "render/picture.h"
#include "render/png.h"
#include "trace/scene_data.h"

namespace asdfvk {
namespace {

/// From entries per input face to entries per triangle.
template <typename T>
std::vector<T> onTriangles(const TriangleMesh& mesh, const std::vector<T>& ofInputFaces) {
  if (mesh.polygons.isEmpty()) return ofInputFaces;
  std::vector<T> result;
  result.reserve(mesh.faces.size());
  for (const uint32_t inputFace : mesh.polygons.inputFaceOf) result.push_back(ofInputFaces[inputFace]);
  return result;
}

}  // namespace

void writePicture(const CommandLine& line, const Result& result, const RunControl& control) {
  const Field* field = result.field(line.pictureOf);
  if (field == nullptr)
    throw Error(ErrorCode::UnknownField, "--picture-of: the result has no field " + line.pictureOf);
  const TriangleMesh& mesh = result.scene->mesh;
  Picture picture{.scene = *result.scene, .title = field->label, .view = line.pictureView};
  std::vector<double> values;
  std::vector<uint8_t> flags;
  if (const std::vector<double>* reals = field->reals()) {
    values = onTriangles(mesh, *reals);
    picture.values = values;
  } else if (const auto* marks = std::get_if<std::vector<uint8_t>>(&field->values)) {
    flags = onTriangles(mesh, *marks);
    picture.highlighted = flags;
  }
  writePng(line.picture, render(picture, control));
}

}  // namespace asdfvk
