#pragma once

#include <utility>
#include <vector>

#include "core/random.h"
#include "mesh/coincident_faces.h"
#include "mesh/dual_graph.h"
#include "mesh/face_domain.h"
#include "predict/seed_cells.h"
#include "trace/reference_tracer.h"
#include "trace/seed_hits.h"

namespace asdfvk::test {

/// A mesh with random seeds and their hits.
struct SeededMesh {
  Mesh mesh;
  FaceGeometry geometry;
  std::vector<uint32_t> representatives;
  Bvh bvh;
  DualGraph graph;
  Cone cone;
  std::vector<uint32_t> seeds;
  std::vector<double> values;  ///< #S, in the unit of the mesh.
  std::vector<ConeHit> hits;   ///< #S x rays

  SeededMesh(Mesh source, size_t seedCount, const ConeOptions& options = {}, uint64_t randomSeed = 1)
      : mesh(std::move(source)),
        geometry(computeFaceGeometry(mesh)),
        representatives(coincidentRepresentatives(mesh, surveyEdges(mesh))),
        bvh(buildBvh(mesh, geometry, representatives)),
        graph(buildDualGraph(mesh)),
        cone(makeCone(options)) {
    for (uint32_t face = 0; face < mesh.faceCount(); ++face)
      if (!geometry.isDegenerate(face)) seeds.push_back(face);
    Random(randomSeed).shuffle(std::span(seeds));
    if (seeds.size() > seedCount) seeds.resize(seedCount);
    values.resize(seeds.size());
    hits.resize(seeds.size() * cone.directions.size());
    makeReferenceTracer(scene(), cone)->trace(seeds, {values, hits}, {});
  }
  SeededMesh(const SeededMesh&) = delete;
  SeededMesh& operator=(const SeededMesh&) = delete;

  [[nodiscard]] TraceScene scene() const { return {mesh, geometry, representatives, bvh}; }
  [[nodiscard]] FaceDomain domain() const { return {graph, geometry, {}, 0, {}}; }
  [[nodiscard]] SeedHitsView seedHits() const { return {seeds, hits}; }
  [[nodiscard]] SeedCells cells() const { return buildSeedCells(graph, seeds); }
  /// The value from the face's own rays, in the unit of the mesh.
  [[nodiscard]] double tracedValue(uint32_t face) const { return referenceCone(scene(), cone, face); }
};

}  // namespace asdfvk::test
