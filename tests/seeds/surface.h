#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "seeds/samplers.h"

/// A mesh and the input of samplers.
struct Surface {
  explicit Surface(asdfvk::Mesh triangles);
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  [[nodiscard]] asdfvk::SeedDomain domain() const { return {graph, geometry, arcAngles, candidates}; }

  asdfvk::Mesh mesh;
  asdfvk::DualGraph graph;
  asdfvk::FaceGeometry geometry;
  mutable asdfvk::ArcAngles arcAngles{graph, geometry};
  std::vector<uint32_t> candidates;  ///< All faces that are not degenerate.
};

/// A generated shape. Each name and size is generated once.
const Surface& generatedSurface(const char* name, uint64_t faceCount);

/// A row of triangles in the plane z = 0; faces i and i + 1 are neighbours.
asdfvk::Mesh strip(uint32_t faceCount);

/// 1 per arc: distances count mesh edges.
asdfvk::UnsetVector<float> hops(const asdfvk::DualGraph& graph);
/// Distance along the arcs from each face to the nearest seed, infinite without a seed: relaxes all arcs until nothing
/// changes.
std::vector<float> distancesToNearest(const asdfvk::DualGraph& graph, std::span<const float> arcLengths,
                                      std::span<const uint32_t> seeds);
/// Distance from each seed to the nearest other seed, infinite where its component has no other.
std::vector<float> distancesToNearestOther(const asdfvk::DualGraph& graph, std::span<const float> arcLengths,
                                           std::span<const uint32_t> seeds);

double meanOf(std::span<const float> numbers);
