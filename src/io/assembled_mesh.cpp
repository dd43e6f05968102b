#include "io/assembled_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "mesh/input_faces.h"
#include "mesh/mesh.h"
#include "mesh/validation.h"

namespace asdfvk {
namespace {

constexpr uint64_t kMaxInstanceBytesPerByte = 64;

[[noreturn]] void failInstancesTooLarge(std::string_view what, uint64_t limit) {
  throw Error(ErrorCode::InputTooLarge,
              fmt::format("its instances have {}, which need more than {} MiB of memory; export fewer instances", what,
                          limit >> 20));
}

}  // namespace

bool Placement::isFinite() const {
  return asdfvk::isFinite(columns[0]) && asdfvk::isFinite(columns[1]) && asdfvk::isFinite(columns[2]) &&
         asdfvk::isFinite(translation);
}

Placement Placement::after(const Placement& inner) const {
  return {{direction(inner.columns[0]), direction(inner.columns[1]), direction(inner.columns[2])},
          point(inner.translation)};
}

AssembledMesh::AssembledMesh(uint64_t vertexCount, uint64_t faceCount, const MeshSource& source)
    : limit_(source.limit(kMaxInstanceBytes, kMaxInstanceBytesPerByte)) {
  requireFaceCount(faceCount, source);
  // Dividing the limits avoids an overflow of the product of two counts in a hostile file.
  if (faceCount / 2 > limit_ / sizeof(Face) || vertexCount / 2 > limit_ / sizeof(Vec3d) ||
      vertexCount * sizeof(Vec3d) + faceCount * sizeof(Face) > limit_)
    failInstancesTooLarge(counted(faceCount, "face") + " in all", limit_);
  meshBytes_ = vertexCount * sizeof(Vec3d) + faceCount * sizeof(Face);
  requireAtMost(kMaxTriangleCount, faceCount, "faces");
  requireAtMost(kMaxIndexCount, vertexCount, "vertices");
  vertices_.reserve(vertexCount);
  faces_.reserve(faceCount);
}

void AssembledMesh::addNames(const PartMesh& part, std::string_view name) {
  names_.begin(faces_.size(), name);
  for (const NamedFaces& object : part.objects)
    names_.begin(faces_.size() + object.firstFace, object.name.empty() ? name : object.name);
  // A name is in the file once, but in the memory for each instance.
  if (meshBytes_ + names_.byteCount() > limit_) failInstancesTooLarge("too many names", limit_);
}

void AssembledMesh::add(const PartMesh& part, const Placement& placement, std::string_view name) {
  if (part.faces.empty()) return;
  ++partCount_;
  addNames(part, name);
  const auto first = static_cast<uint32_t>(vertices_.size());
  for (const Vec3d& p : part.vertices) vertices_.push_back(placement.point(p));
  const double scale =
      std::max({length(placement.columns[0]), length(placement.columns[1]), length(placement.columns[2])});
  float32Step_ = std::max(float32Step_, scale * float32StepOf(part.vertices));
  const bool mirrors = placement.mirrors();
  for (const Face& face : part.faces) {
    faces_.push_back({first + face[0], first + face[1], first + face[2]});
    if (mirrors) std::swap(faces_.back()[1], faces_.back()[2]);
  }
}

Mesh AssembledMesh::finish() {
  Mesh mesh;
  mesh.vertices = std::move(vertices_);
  mesh.objects = names_.finish(faces_.size());
  InputFaces faces;
  faces.addTriangles(std::move(faces_));
  faces.moveTo(mesh);
  mesh.statedPartCount = partCount_;
  mesh.float32Step = float32Step_;
  return mesh;
}

}  // namespace asdfvk
