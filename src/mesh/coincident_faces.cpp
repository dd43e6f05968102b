#include "mesh/coincident_faces.h"

#include <algorithm>

#include "mesh/buckets.h"

namespace asdfvk {
namespace {

// A face without its lowest vertex, which is its bucket.
struct FaceKey {
  uint64_t otherVertices = 0;
  uint32_t face = 0;
  auto operator<=>(const FaceKey&) const = default;
};

}  // namespace

std::vector<uint32_t> coincidentRepresentatives(const Mesh& mesh) {
  const Buckets<FaceKey> byLowestVertex =
      sortIntoBuckets<FaceKey>(mesh.vertices.size(), mesh.faces.size(), [&](uint32_t f, auto&& put) {
        Face face = mesh.faces[f];
        std::sort(face.begin(), face.end());
        put(face[0], FaceKey{uint64_t{face[1]} << 32 | face[2], f});
      });
  std::vector<uint32_t> representatives(mesh.faces.size());
  forEachInParallel(byLowestVertex.bucketCount(), [&](uint32_t vertex) {
    const FaceKey* first = nullptr;
    for (const FaceKey& key : byLowestVertex[vertex]) {
      if (!first || first->otherVertices != key.otherVertices) first = &key;
      representatives[key.face] = first->face;
    }
  });
  return representatives;
}

}  // namespace asdfvk
