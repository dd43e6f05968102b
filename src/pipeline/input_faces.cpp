#include "pipeline/input_faces.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {

std::vector<double> valuesOfInputFaces(const TriangleMesh& mesh, std::span<const double> values,
                                       std::span<const double> areas) {
  if (mesh.polygons.isEmpty()) return {values.begin(), values.end()};
  std::vector<double> sums(mesh.inputFaceCount(), 0), weights(mesh.inputFaceCount(), 0);
  std::vector<double> last(mesh.inputFaceCount(), kNoValue);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    if (std::isnan(values[face])) continue;
    const uint32_t inputFace = mesh.polygons.inputFaceOf[face];
    sums[inputFace] += areas[face] * values[face];
    weights[inputFace] += areas[face];
    last[inputFace] = values[face];
  }
  for (size_t i = 0; i < sums.size(); ++i)
    if (weights[i] > 0)
      last[i] = sums[i] / weights[i];  // else every valued triangle has zero area: any of them will do
  return last;
}

std::vector<uint8_t> seedsOfInputFaces(const TriangleMesh& mesh, std::span<const uint8_t> isSeed) {
  if (mesh.polygons.isEmpty()) return {isSeed.begin(), isSeed.end()};
  std::vector<uint8_t> seeds(mesh.inputFaceCount(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) seeds[mesh.polygons.inputFaceOf[face]] |= isSeed[face];
  return seeds;
}

}  // namespace asdfvk
