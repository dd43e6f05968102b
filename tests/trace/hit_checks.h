#pragma once

#include "cone/cone_value.h"
#include "trace_results.h"

namespace asdfvk {

/// The value that a seed's hits give by coneValue(), in the mesh's unit.
inline double valueOfHits(const TracedMesh& traced, const Cone& cone, uint32_t seedFace,
                          std::span<const ConeHit> hits) {
  const std::span<const Vec3d> normals = traced.geometry.normals;
  const ConeFrame frame = seedConeFrame(traced.scene(), cone, seedFace);
  std::vector<double> lengths, weights;
  for (size_t ray = 0; ray < hits.size(); ++ray) {
    const ConeHit& hit = hits[ray];
    if (hit.face == kNoFace) continue;
    if (isFalseHit(cone, normals[seedFace], frame.toWorld(cone.directions[ray]), normals[hit.face])) continue;
    lengths.push_back(hit.distance);
    weights.push_back(cone.weights[ray]);
  }
  return traced.bvh.normalization.toMeshLength(coneValue(lengths, weights, cone.outliers));
}

/// valueOfHits() of every seed face.
inline std::vector<double> valuesOfHits(const TracedMesh& traced, const ConeOptions& options,
                                        std::span<const ConeHit> hits) {
  const Cone cone = makeCone(options);
  std::vector<double> values;
  for (const uint32_t face : traced.seedFaces())
    values.push_back(valueOfHits(traced, cone, face, hits.subspan(values.size() * options.rayCount, options.rayCount)));
  return values;
}

}  // namespace asdfvk
