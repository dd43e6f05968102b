#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "asdf_vk/session.h"
#include "pipeline/computation.h"
#include "pipeline/judged_surface.h"
#include "trace/greatest_section.h"
#include "trace/thin_regions.h"

namespace asdfvk {

/// A place is thinner than in another version of the mesh if its thickness is below this share of the other.
inline constexpr double kThinnerShare = 0.95;

/// Thickness of all triangles of the computed faces. Lengths are in the unit of the mesh unless stated.
struct FaceThickness {
  std::vector<double> atBarycentre;  ///< #F; NaN for no value.
  std::vector<double> least;         ///< #F, over all points of the face; 0 if float32 does not resolve it.
  std::vector<uint8_t> isJudged;     ///< #F, 0 where `least` does not count: no value, or a misoriented component.
  std::optional<GreatestSection> greatestSection;  ///< The greatest section of all closed solids.
  UnjudgedFaces unjudged;
  std::vector<ConnectedThinParts> regions;  ///< Normalised. Empty without a limit.
  std::optional<WallPlace> nextWall;        ///< Normalised. Unset without a limit, if there is a wall, or if not found.
  /// With ThicknessOptions::thickerThan: the greatest section of each solid, normalised; infinite for those not closed.
  std::vector<GreatestSection> sections;
  /// #solids: the sections that limit the values, normalised; infinite for solids whose section limits no value.
  std::vector<GreatestSection> caps;
  std::vector<std::optional<WallChange>> wallChanges;      ///< For each region; empty without a comparison.
  std::vector<std::optional<ChangedPlace>> changedPlaces;  ///< For each region.
};

/// For each computed face that is not degenerate, the least diameter over its opposing walls, at most the greatest
/// section of its solid. A face without a wall that opposes it, in an open component, has no value. A face of the kind
/// NoThickness has the thickness 0. computation: its mesh and scene are those of the surface.
[[nodiscard]] FaceThickness measureThickness(const Computation& computation, const JudgedSurface& surface,
                                             const RunControl& control);
/// Only the thin regions and the unjudged faces, in less time. Precondition: there is a limit.
[[nodiscard]] FaceThickness findThinPlaces(const Computation& computation, const JudgedSurface& surface,
                                           const RunControl& control);

/// For each input face the least value of its triangles; NaN if none has a value. values: #F. Returns #I.
[[nodiscard]] std::vector<double> thicknessOfInputFaces(const TriangleMesh& mesh, std::span<const double> values);

}  // namespace asdfvk
