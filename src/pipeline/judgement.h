#pragma once

#include <cstdint>
#include <vector>

#include "asdf_vk/report.h"
#include "pipeline/computation.h"
#include "pipeline/judged_surface.h"

namespace asdfvk {

/// Which faces of the judged surface have a thickness that counts, and the causes that prevent a verdict. Views its
/// arguments.
class Judgement {
 public:
  Judgement(const Computation& computation, const JudgedSurface& surface);

  /// Whether a thickness of the face counts.
  [[nodiscard]] bool isJudged(uint32_t face) const {
    return !isWoundAgainst(face) && !isInverted(face) && !isDoubleSided(face);
  }
  /// Whether the face belongs to two sheets in contact, so that its thickness is 0. For the surface of the space, such
  /// a face is an ordinary one.
  [[nodiscard]] bool isSheet(uint32_t face) const { return !surface_.isSpace() && hasNoThickness(face); }
  /// Whether all faces of the component of the face are sheets.
  [[nodiscard]] bool isInSheet(uint32_t face) const {
    return !surface_.isSpace() && isSheet_[componentIndexOf(face)] != 0;
  }
  /// A face of a component that has a volume, but no material, because each face has a reversed copy.
  [[nodiscard]] bool isDoubleSided(uint32_t face) const { return isDoubleSided_[componentIndexOf(face)] != 0; }

  [[nodiscard]] UnjudgedFaces unjudged() const;

 private:
  [[nodiscard]] bool hasNoThickness(uint32_t face) const { return surface_.kindOf(face) == FaceKind::NoThickness; }
  [[nodiscard]] uint32_t componentIndexOf(uint32_t face) const {
    return computation_.prepared.components.componentOf[face];
  }
  [[nodiscard]] const Component& componentOf(uint32_t face) const {
    return computation_.prepared.components.components[componentIndexOf(face)];
  }
  [[nodiscard]] bool isWoundAgainst(uint32_t face) const {
    return componentOf(face).isClosed && !componentOf(face).isConsistentlyWound;
  }
  [[nodiscard]] bool isInverted(uint32_t face) const { return surface_.kindOf(face) == FaceKind::Inverted; }
  [[nodiscard]] bool isOpen(uint32_t face) const {
    return !computation_.prepared.geometry.isDegenerate(face) && !componentOf(face).isClosed;
  }
  template <typename Holds>
  [[nodiscard]] uint64_t countInputFaces(const Holds& holds) const;
  template <typename Holds>
  [[nodiscard]] uint64_t countComputedFaces(const Holds& holds) const;
  void addReasonOfMesh(UnjudgedFaces& unjudged, UnjudgedCause cause, double amount) const;
  template <typename Holds>
  void addReason(UnjudgedFaces& unjudged, UnjudgedCause cause, const Holds& holds) const;

  const Computation& computation_;
  const JudgedSurface& surface_;
  std::vector<uint8_t> isSheet_, isDoubleSided_;  // #components
};

}  // namespace asdfvk
