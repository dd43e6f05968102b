#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "bvh/bvh.h"
#include "mesh/coincident_faces.h"
#include "trace/reference_tracer.h"

namespace asdfvk {

/// A mesh with all that tracing needs.
struct TracedMesh {
  Mesh mesh;
  FaceGeometry geometry;
  std::vector<uint32_t> representatives;
  Bvh bvh;

  explicit TracedMesh(Mesh source)
      : mesh(std::move(source)),
        geometry(computeFaceGeometry(mesh)),
        representatives(lowestFacesWithTheSameVertices(mesh)),
        bvh(buildBvh(mesh, geometry, representatives)) {}

  [[nodiscard]] TraceScene scene() const { return {mesh, geometry, representatives, bvh}; }

  [[nodiscard]] std::vector<uint32_t> seedFaces() const {
    std::vector<uint32_t> faces;
    for (uint32_t f = 0; f < mesh.faceCount(); ++f)
      if (!geometry.isDegenerate(f)) faces.push_back(f);
    return faces;
  }

  /// One value per face; kNoValue for degenerate ones.
  [[nodiscard]] std::vector<double> values(const ConeOptions& options = {}) const {
    const std::vector<uint32_t> seeds = seedFaces();
    std::vector<double> traced(seeds.size()), all(mesh.faceCount(), kNoValue);
    const Cone cone = makeCone(options);
    makeReferenceTracer(scene(), cone)->trace(seeds, {traced}, {});
    for (size_t i = 0; i < seeds.size(); ++i) all[seeds[i]] = traced[i];
    return all;
  }

  static std::vector<uint32_t> lowestFacesWithTheSameVertices(const Mesh& mesh) {
    std::map<Face, uint32_t> lowest;
    std::vector<uint32_t> representatives;
    for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
      Face wound = mesh.faces[f];
      std::rotate(wound.begin(), std::min_element(wound.begin(), wound.end()), wound.end());
      representatives.push_back(lowest.try_emplace(wound, f).first->second);
    }
    return representatives;
  }
};

}  // namespace asdfvk
