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
  UnsetVector<uint32_t> representatives;
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

/// The faces of the cells of the last seeds, as a domain.
struct SeededPart {
  std::vector<uint32_t> faces, seeds;  ///< The seeds are nodes.
  DualGraph graph;
  FaceGeometry geometry;
  std::vector<ConeHit> hits;

  /// firstSeed: the first seed that the part has.
  SeededPart(const SeededMesh& seeded, uint32_t firstSeed) {
    const SeedCells cells = seeded.cells();
    std::vector<uint32_t> nodeOf(seeded.mesh.faceCount(), kNoFace);
    for (uint32_t face = 0; face < nodeOf.size(); ++face) {
      if (cells.cellOf[face] == kNoCell || cells.cellOf[face] < firstSeed) continue;
      nodeOf[face] = static_cast<uint32_t>(faces.size());
      faces.push_back(face);
    }
    graph.offsets.resize(1, 0);
    for (const uint32_t face : faces) {
      for (const uint32_t neighbour : seeded.graph.neighboursOf(face))
        if (nodeOf[neighbour] != kNoFace) graph.neighbours.push_back(nodeOf[neighbour]);
      graph.offsets.push_back(static_cast<uint32_t>(graph.neighbours.size()));
    }
    geometry = geometryOf(seeded.geometry, faces);
    for (size_t seed = firstSeed; seed < seeded.seeds.size(); ++seed) seeds.push_back(nodeOf[seeded.seeds[seed]]);
    const auto firstHit = static_cast<std::ptrdiff_t>(firstSeed * seeded.cone.directions.size());
    hits.assign(seeded.hits.begin() + firstHit, seeded.hits.end());
  }

  [[nodiscard]] FaceDomain domain() const { return {graph, geometry, {}, 0, {}, faces}; }
};

}  // namespace asdfvk::test
