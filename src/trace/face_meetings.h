#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "asdf_vk/run_control.h"
#include "mesh/dual_graph.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Bits of FaceMeetings::bits.
inline constexpr uint8_t kCrossed = 1, kTouched = 2;

/// A segment in which another face meets a face; normalised. It is not a part of an edge of the face.
struct FaceCut {
  uint32_t face = 0;
  Vec3d from, to;
};

/// Where faces meet other faces that are not their neighbours.
struct FaceMeetings {
  std::vector<uint8_t> bits;  ///< #F. Copies of a face have the bits of their representative.
  /// The cuts of representatives, sorted by face.
  std::vector<FaceCut> cuts;
  /// Pairs of components with faces that cross or touch each other over an area, ascending, each once.
  std::vector<std::pair<uint32_t, uint32_t>> components;

  [[nodiscard]] std::span<const FaceCut> cutsOf(uint32_t face) const;
};

/// Finds all pairs of faces that meet, among the faces f with isWanted[f] != 0 (#F). Two faces cross if they have a
/// segment in common that lies inside of at least one of them. A corner within kContactDistance of a plane lies in the
/// plane. Faces touch if they lie within this distance of each other with opposite normals and overlap, or if their
/// edges do. Neighbours in the dual graph meet only if they are folded onto each other. componentOf: #F. Throws
/// Error{Cancelled}.
[[nodiscard]] FaceMeetings findFaceMeetings(const TraceScene& scene, const DualGraph& graph,
                                            std::span<const uint32_t> componentOf, std::span<const uint8_t> isWanted,
                                            const RunControl& control);

}  // namespace asdfvk
