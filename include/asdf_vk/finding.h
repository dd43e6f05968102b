#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

/// What a finding is about.
enum class FindingKind {
  ThinWall,         ///< ThinKind::Wall of the thickness.
  ThinDetail,       ///< ThinKind::Detail, of walls or of gaps, if details count.
  ThinEdge,         ///< ThinKind::Edge, of walls or of gaps, if edges count.
  NarrowGap,        ///< ThinKind::Gap.
  ThickBody,        ///< A body that is thicker than ThicknessOptions::thickerThan.
  SealedVoid,       ///< A part of the space without a way out.
  BodiesInContact,  ///< Two bodies that touch or overlap.
  Unjudged,         ///< A part of the surface that cannot be compared with a limit.
};
/// The name of an enumerator with a small first letter, for example "thinWall".
[[nodiscard]] ASDFVK_API const char* nameOf(FindingKind kind);

/// What a finding does to the verdict.
enum class FindingLevel {
  Failure,    ///< It fails the check.
  NotJudged,  ///< It may fail the check, but cannot be judged; or it prevents a verdict.
  Note,       ///< It is not checked, or a former version has it, too.
};
/// The name of an enumerator with a small first letter, for example "notJudged".
[[nodiscard]] ASDFVK_API const char* nameOf(FindingLevel level);

/// A place to which a verdict refers, in the same form for all checks, for programs. Lengths are in the unit of the
/// mesh.
struct Finding {
  FindingKind kind = FindingKind::ThinWall;    ///< What was found.
  FindingLevel level = FindingLevel::Failure;  ///< What it does to the verdict.
  /// Thickness, width of the gap, diameter of the ball, or volume of the void; NaN for other kinds.
  double value = kNoValue;
  std::optional<double> limit;           ///< The limit that `value` is compared with.
  std::optional<Vec3d> place;            ///< A point of the surface, or the centre of a ball.
  std::optional<Vec3d> opposite;         ///< The point on the other side of a wall or a gap.
  std::optional<uint64_t> face;          ///< Input face of `place`.
  std::optional<uint64_t> oppositeFace;  ///< Input face of `opposite`.
  uint64_t faceCount = 0;                ///< Input faces of the region; 0 if it is not a region of faces.
  bool isKnown = false;                  ///< A baseline has this failure; its level is a note.
  std::vector<std::string> bodies = {};  ///< Names of the bodies, see ThinRegion::bodies.
  std::string message;                   ///< What was found, and where, in one sentence.
  std::string remedy;                    ///< What to change, in one sentence.
};

}  // namespace asdfvk
