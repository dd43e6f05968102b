#include "cli/picture_output.h"

#include <vector>

#include "asdf_vk/error.h"
#include "render/picture.h"
#include "render/png.h"

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

void writePicture(const CommandLine& line, const TriangleMesh& mesh, const Result& result, const RunControl& control) {
  Picture picture{.mesh = mesh, .values = {}, .highlighted = {}, .title = {}, .range = {}, .view = line.pictureView};
  std::vector<double> values;
  std::vector<uint8_t> seeds;
  switch (line.pictureOf) {
    case PictureOf::Sdf:
      values = onTriangles(mesh, result.sdf);
      picture.title = "shape diameter";
      break;
    case PictureOf::Seeds:
      seeds = onTriangles(mesh, result.isSeed);
      picture.title = "seeds";
      break;
    case PictureOf::Error:
      if (result.expectedError.empty())
        throw Error(ErrorCode::OptionConflict, "--picture-of error: so few seeds allow no estimate; give more --seeds");
      values = onTriangles(mesh, result.expectedError);
      picture.title = "expected error";
      break;
  }
  picture.values = values;
  picture.highlighted = seeds;
  writePng(line.picture, render(picture, control));
}

}  // namespace asdfvk
