#include "cli/result_picture.h"

#include <vector>

#include "render/picture.h"
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

Image pictureOf(const Result& result, const Field& field, const View& view, const PictureStyle& style,
                const RunControl& control) {
  const TriangleMesh& mesh = result.scene->scene.mesh;
  Picture picture{.scene = result.scene->scene, .title = field.label, .view = view};
  picture.width = style.width;
  picture.height = style.height;
  picture.textScale = style.textScale;
  picture.isDraft = style.isDraft;
  std::vector<double> values;
  std::vector<uint8_t> flags;
  std::vector<uint32_t> labels;
  if (const std::vector<double>* reals = field.reals()) {
    values = onTriangles(mesh, *reals);
    picture.values = values;
  } else if (const auto* marks = std::get_if<std::vector<uint8_t>>(&field.values)) {
    flags = onTriangles(mesh, *marks);
    picture.highlighted = flags;
  } else if (const auto* indices = std::get_if<std::vector<uint32_t>>(&field.values)) {
    labels = onTriangles(mesh, *indices);
    picture.labels = labels;
  }
  return render(picture, control);
}

}  // namespace asdfvk
