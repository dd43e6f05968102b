#include "traced_sample.h"

#include "bvh/bvh.h"
#include "pipeline/prepared_mesh.h"
#include "seeds/samplers.h"

namespace asdfvk::bench {

std::vector<TracedFace> traceSample(ComputeBackend& backend, Mesh& mesh, const ConeOptions& coneOptions,
                                    const std::function<bool(const Vec3d&)>& wanted, uint64_t count,
                                    uint64_t randomSeed, const RunControl& control) {
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  std::vector<uint32_t> candidates;
  for (const uint32_t face : prepared.castableFaces)
    if (wanted(prepared.geometry.barycentres[face])) candidates.push_back(face);
  const std::vector<uint32_t> faces = randomPermutationSeeds(candidates, count, randomSeed);

  const Cone cone = makeCone(coneOptions);
  const Bvh bvh = buildBvh(mesh, prepared.geometry, prepared.representatives);
  const TraceScene scene{mesh, prepared.geometry, prepared.representatives, bvh};
  std::vector<double> values(faces.size());
  backend.makeTracer(scene, cone)->trace(faces, {values}, control);

  std::vector<TracedFace> sample;
  for (size_t i = 0; i < faces.size(); ++i)
    sample.push_back({prepared.geometry.barycentres[faces[i]], prepared.geometry.normals[faces[i]], values[i]});
  return sample;
}

}  // namespace asdfvk::bench
