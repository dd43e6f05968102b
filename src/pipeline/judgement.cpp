#include "pipeline/judgement.h"

#include <cmath>

#include "mesh/winding.h"

namespace asdfvk {
namespace {

// Coordinates with greater steps do not resolve the limit.
constexpr double kMaxStepShareOfLimit = 0.25;

}  // namespace

Judgement::Judgement(const Computation& computation, const JudgedSurface& surface)
    : computation_(computation), surface_(surface) {
  const PreparedMesh& prepared = computation.prepared;
  const Components& components = prepared.components;
  const double contactLength = computation.scene.bvh.normalization.contactLength();
  std::vector<double> areas(components.components.size(), 0);
  isSheet_.assign(areas.size(), 1);
  isDoubleSided_.assign(areas.size(), 0);
  for (uint32_t face = 0; face < prepared.mesh.faceCount(); ++face) {
    areas[components.componentOf[face]] += prepared.geometry.areas[face];
    if (!hasNoThickness(face) && !prepared.geometry.isDegenerate(face)) isSheet_[components.componentOf[face]] = 0;
  }
  for (size_t i = 0; i < areas.size(); ++i) {
    if (isSheet_[i] == 0 || std::abs(components.components[i].signedVolume) <= contactLength * areas[i]) continue;
    isSheet_[i] = 0;
    isDoubleSided_[i] = 1;
  }
}

/// Counts the input faces that have a triangle for which holds(triangle) is true.
template <typename Holds>
uint64_t Judgement::countInputFaces(const Holds& holds) const {
  const TriangleMesh& mesh = computation_.prepared.mesh;
  uint64_t count = 0, last = mesh.inputFaceCount();
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const uint64_t inputFace = mesh.inputFaceOf(face);
    if (inputFace == last || !holds(face)) continue;
    last = inputFace;
    ++count;
  }
  return count;
}

/// Counts such input faces in Computation::region.
template <typename Holds>
uint64_t Judgement::countComputedFaces(const Holds& holds) const {
  const TriangleMesh& mesh = computation_.prepared.mesh;
  return countInputFaces(
      [&](uint32_t face) { return computation_.region.contains(mesh.inputFaceOf(face)) && holds(face); });
}

UnjudgedFaces Judgement::unjudged() const {
  UnjudgedFaces unjudged;
  const FaceGeometry& geometry = computation_.prepared.geometry;
  unjudged.degenerateCount = countComputedFaces([&](uint32_t face) { return geometry.isDegenerate(face); });
  unjudged.invertedCount = countComputedFaces([&](uint32_t face) { return isWoundAgainst(face) || isInverted(face); });
  unjudged.openCount = countComputedFaces([&](uint32_t face) { return isOpen(face); });
  unjudged.crossedCount = surface_.crossedCount();
  unjudged.insideCount = surface_.insideCount();
  addReason(unjudged, UnjudgedCause::Border,
            [&](uint32_t face) { return isOpen(face) && !componentOf(face).isBranching; });
  addReason(unjudged, UnjudgedCause::Branching,
            [&](uint32_t face) { return isOpen(face) && componentOf(face).isBranching; });
  addReason(unjudged, UnjudgedCause::WoundAgainst, [&](uint32_t face) { return isWoundAgainst(face); });
  addReason(unjudged, UnjudgedCause::Inverted, [&](uint32_t face) { return isInverted(face); });
  addReason(unjudged, UnjudgedCause::DoubleSided, [&](uint32_t face) { return isDoubleSided(face); });
  const PreparedMesh& prepared = surface_.original().prepared;
  if (prepared.negativeVolumeCount > 0)
    addReasonOfMesh(unjudged, UnjudgedCause::NegativeVolumes, prepared.negativeVolumeCount);
  const std::optional<double> limit = surface_.limitIn(computation_.options.thickness);
  if (limit && prepared.float32Step > kMaxStepShareOfLimit * *limit)
    addReasonOfMesh(unjudged, UnjudgedCause::CoarseCoordinates, prepared.float32Step);
  return unjudged;
}

/// Adds a cause that is not at certain faces.
void Judgement::addReasonOfMesh(UnjudgedFaces& unjudged, UnjudgedCause cause, double amount) const {
  const uint64_t faceCount = countComputedFaces([](uint32_t) { return true; });
  unjudged.reasons.push_back({.cause = cause, .faceCount = faceCount, .amount = amount});
}

/// Adds the cause with the first face for which holds(face) is true, if there is one. The face need not be
/// a computed one: a face elsewhere that cannot be judged may be the other side of a wall.
template <typename Holds>
void Judgement::addReason(UnjudgedFaces& unjudged, UnjudgedCause cause, const Holds& holds) const {
  UnjudgedReason reason{.cause = cause, .faceCount = countInputFaces(holds)};
  if (reason.faceCount == 0) return;
  const PreparedMesh& prepared = computation_.prepared;
  uint32_t first = 0;
  while (!holds(first)) ++first;
  reason.face = prepared.mesh.inputFaceOf(first);
  reason.place = prepared.geometry.barycentres[first];
  const EdgeKind kind = cause == UnjudgedCause::Border         ? EdgeKind::Boundary
                        : cause == UnjudgedCause::Branching    ? EdgeKind::Branching
                        : cause == UnjudgedCause::WoundAgainst ? EdgeKind::Inconsistent
                                                               : EdgeKind::Regular;
  if (const EdgesOfKind& edges = prepared.openEdges[static_cast<size_t>(kind)]; edges.count > 0) {
    reason.edgeCount = edges.count;
    reason.face = surface_.original().prepared.mesh.inputFaceOf(edges.firstCorner / 3);
    reason.place = edges.place;
  }
  reason.isRepairable = cause == UnjudgedCause::Inverted ||
                        (cause == UnjudgedCause::WoundAgainst &&
                         canBeTurned(surface_.original().prepared.mesh, computation_.scene.bvh.normalization));
  unjudged.reasons.push_back(reason);
}

}  // namespace asdfvk
