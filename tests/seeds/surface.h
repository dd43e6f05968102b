#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "seeds/samplers.h"

/// A mesh and the input of samplers.
struct Surface {
  explicit Surface(asdfvk::Mesh triangles);
  [[nodiscard]] asdfvk::SeedDomain domain() const { return {graph, geometry, candidates}; }

  asdfvk::Mesh mesh;
  asdfvk::DualGraph graph;
  asdfvk::FaceGeometry geometry;
  std::vector<uint32_t> candidates;  ///< All faces that are not degenerate.
};

/// One generated shape of asdfvk-generate. The shapes of the same name and size are made once.
const Surface& generatedSurface(const char* name, uint64_t faceCount);

/// A row of triangles in the plane z = 0, face i beside face i + 1.
asdfvk::Mesh strip(uint32_t faceCount);
/// All faces of both; no vertex in common.
asdfvk::Mesh together(asdfvk::Mesh mesh, const asdfvk::Mesh& other);

/// 1 per arc: distances count mesh edges.
std::vector<float> hops(const asdfvk::DualGraph& graph);
/// Distance along the arcs from each face to the nearest of the seeds, infinite where there is none, by relaxing all
/// arcs until nothing changes: slow, and nothing else than the definition.
std::vector<float> distancesToNearest(const asdfvk::DualGraph& graph, std::span<const float> arcLengths,
                                      std::span<const uint32_t> seeds);
/// For each seed the distance to the nearest other one, infinite where it has none in its component.
std::vector<float> distancesToNearestOther(const asdfvk::DualGraph& graph, std::span<const float> arcLengths,
                                           std::span<const uint32_t> seeds);

double meanOf(std::span<const float> numbers);
