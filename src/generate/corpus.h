#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// The checks of a part: walls, gaps, sealed voids, greatest balls (docs/thickness.md).
enum class PartCheck { Thinner, Closer, Voids, Thicker };
enum class PartVerdict { Pass, Fail, NotJudged };

/// The right answer to a check of a part. It follows from the construction of the part.
struct KnownAnswer {
  PartCheck check = PartCheck::Thinner;
  double limit = 0;  ///< Unused by PartCheck::Voids.
  PartVerdict verdict = PartVerdict::Pass;
  /// The thickness of the least wall or the width of the least gap; the volume of all voids; the diameter of the
  /// greatest ball. Unset if there is none, or if it varies.
  std::optional<double> value = {};
  /// A point of the least wall or gap, and the opposite point.
  std::optional<std::array<Vec3d, 2>> place = {};
  std::string reason = {};  ///< A sentence.
};

/// A part of the corpus, and the answers to its checks.
struct KnownPart {
  std::string name;           ///< The name of the file without extension.
  std::string_view category;  ///< "walls", "edges", "gaps", "voids", "thick", "sound" or "dangerous".
  Mesh mesh;
  std::vector<KnownAnswer> answers;    ///< At least one.
  std::string_view extension = "ply";  ///< "ply", "stl", "off" or "obj".
};

// The parts of each kind of known truth. Lengths are in mm.
[[nodiscard]] std::vector<KnownPart> wallParts();       ///< Walls on both sides of the limit.
[[nodiscard]] std::vector<KnownPart> edgeParts();       ///< Shapes on both sides of the thresholds of the rule.
[[nodiscard]] std::vector<KnownPart> gapParts();        ///< Slots and clearances on both sides of the limit.
[[nodiscard]] std::vector<KnownPart> voidParts();       ///< Sealed voids, and spaces with a way out.
[[nodiscard]] std::vector<KnownPart> thickParts();      ///< Greatest balls on both sides of the limit.
[[nodiscard]] std::vector<KnownPart> soundParts();      ///< Solids that only look broken.
[[nodiscard]] std::vector<KnownPart> dangerousParts();  ///< Walls without thickness, and surfaces of no solid.

/// All parts; the names differ.
[[nodiscard]] std::vector<KnownPart> corpusParts();

}  // namespace asdfvk
