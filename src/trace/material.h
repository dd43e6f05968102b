#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "asdf_vk/run_control.h"
#include "mesh/components.h"
#include "mesh/dual_graph.h"
#include "trace/face_meetings.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// What a face, or a piece of it, is for the solid. The material is where the faces of all closed, consistently wound
/// components together wind around a point at least once (winding_number.h): the union of all solids.
enum class FaceKind : uint8_t {
  Boundary,  ///< Material inside, and none outside. Also faces of components that bound no solid.
  /// Material on both sides: the face is in another solid, or solids touch there. Or material only outside: the face is
  /// a side of a sheet that lies on a solid.
  Inside,
  NoThickness,  ///< No material on either side: two sheets of a wall that float32 does not tell apart.
  Inverted,     ///< The solid is wound inwards.
};

/// A convex piece of a face.
struct FacePiece {
  std::vector<Vec3d> corners;  ///< Normalised, in the winding of the face.
  FaceKind kind = FaceKind::Boundary;
};

/// The faces of a mesh as the boundary of material.
class Material {
 public:
  /// isFlipped: all faces were reversed on purpose. If the solids are wound inwards then, the material is outside of
  /// them. Throws Error{Cancelled}.
  Material(const TraceScene& scene, const DualGraph& graph, const Components& components, bool isFlipped,
           const RunControl& control);

  /// The kind of a face; if the face is cut, the kind at its barycentre.
  [[nodiscard]] FaceKind kindOf(uint32_t face) const { return kinds_.empty() ? commonKind_ : kinds_[face]; }
  /// Whether another face meets the face in a segment.
  [[nodiscard]] bool isCut(uint32_t face) const {
    return !meetings_.cuts.empty() && (meetings_.bits[face] & kCrossed) != 0;
  }
  [[nodiscard]] bool hasCuts() const { return !meetings_.cuts.empty(); }
  [[nodiscard]] bool hasKind(FaceKind kind) const;
  /// Divides a face along its cuts. The pieces do not overlap. Pieces that float32 does not resolve are left out.
  [[nodiscard]] std::vector<FacePiece> piecesOf(uint32_t face) const;
  /// Pairs of components that cross or touch each other, or have copies of faces in common.
  [[nodiscard]] std::span<const std::pair<uint32_t, uint32_t>> meetingComponents() const {
    return meetings_.components;
  }

 private:
  [[nodiscard]] FaceKind kindAt(const Vec3d& point, const Vec3d& normal) const;
  void findKinds(const DualGraph& graph, std::span<const uint8_t> isOfSolid, const RunControl& control);

  TraceScene scene_;
  bool isOutside_ = false;         // The material is outside of the solids.
  std::vector<uint32_t> weights_;  // #F, see windingNumberAt().
  FaceMeetings meetings_;
  FaceKind commonKind_ = FaceKind::Boundary;
  std::vector<FaceKind> kinds_;  // #F; empty if all faces have the common kind.
};

}  // namespace asdfvk
