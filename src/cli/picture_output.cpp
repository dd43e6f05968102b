#include "cli/picture_output.h"

#include <vector>

#include "picture/picture.h"
#include "picture/png.h"

namespace asdfvk {
namespace {

/// From entries per input face to entries per triangle.
template <typename T>
std::vector<T> onTriangles(const Mesh& mesh, const std::vector<T>& ofInputFaces) {
  if (mesh.polygons.isEmpty()) return ofInputFaces;
  std::vector<T> result;
  result.reserve(mesh.faces.size());
  for (const uint32_t inputFace : mesh.polygons.inputFaceOf) result.push_back(ofInputFaces[inputFace]);
  return result;
}

}  // namespace

void writePicture(const CommandLine& line, const Mesh& mesh, const Result& result, const RunControl& control) {
  const bool isOfSeeds = line.pictureOf == PictureOf::Seeds;
  std::vector<double> values;
  std::vector<uint8_t> seeds;
  if (isOfSeeds) {
    seeds = onTriangles(mesh, result.isSeed);
  } else {
    values = onTriangles(mesh, result.sdf);
  }
  writePng(line.picture, render({.mesh = mesh,
                                 .values = values,
                                 .highlighted = seeds,
                                 .title = isOfSeeds ? "seeds" : "shape diameter",
                                 .range = {},
                                 .view = line.pictureView},
                                control));
}

}  // namespace asdfvk
