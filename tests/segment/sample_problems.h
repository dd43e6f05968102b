#pragma once

#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/random.h"
#include "generate/shapes.h"
#include "mesh/face_geometry.h"
#include "segment/face_neighbours.h"

namespace asdfvk::test {

/// A mesh with what the segmentation needs of it, and values: the diameters of the shape with noise, mapped to [0, 1].
struct SampleMesh {
  Mesh mesh;
  FaceGeometry geometry;
  FaceNeighbours neighbours;
  std::vector<double> values;

  SampleMesh(Mesh source, std::vector<double> numbers)
      : mesh(std::move(source)),
        geometry(computeFaceGeometry(mesh)),
        neighbours(findFaceNeighbours(mesh)),
        values(std::move(numbers)) {}
};

inline SampleMesh sampleMesh(std::string_view shape, uint64_t faceCount, double noise = 0.1) {
  GeneratedShape generated = generateShape(shape, faceCount);
  Random random(7);
  std::vector<double> values;
  for (const float diameter : generated.diameter) values.push_back(diameter * (1 + noise * (random.real() - 0.5)));
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double from = *least, range = *greatest - *least;
  for (double& value : values) value = (value - from) / range;
  return {std::move(generated.mesh), std::move(values)};
}

/// A strip of triangles, each with the one before and the one after it as neighbours.
inline FaceNeighbours stripNeighbours(uint32_t faceCount) {
  FaceNeighbours neighbours(faceCount, {kNoNeighbour, kNoNeighbour, kNoNeighbour});
  for (uint32_t face = 0; face + 1 < faceCount; ++face) {
    neighbours[face][1] = face + 1;
    neighbours[face + 1][0] = face;
  }
  return neighbours;
}

/// Calls the function on that number of threads.
template <typename Function>
auto onThreads(size_t count, const Function& function) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
  return function();
}

}  // namespace asdfvk::test
