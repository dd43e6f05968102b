#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

// The parts of the report about wall thickness, gaps and voids. See the first comment of report.h.

/// What a thin place is. L is the limit (docs/thickness.md). In a report on gaps, the space between two surfaces is
/// thin.
enum class ThinKind {
  Wall,    ///< The surface around the place is thin, and nowhere much thinner than at the place. Fails the check.
  Gap,     ///< A wall of the space: a slot of a body, or a clearance between bodies. Fails the check.
  Detail,  ///< Too small for a wall at L, but a wall at a smaller limit, such as a low rib or a letter.
  Edge,    ///< Any other thin place: the shape tapers off there.
};
/// The name of an enumerator with a small first letter, for example "wall".
[[nodiscard]] ASDFVK_API const char* nameOf(ThinKind kind);

/// How a wall relates to the other version of the mesh (ComparisonReport).
enum class WallChange {
  New,      ///< The wall, or a part of it as large as a wall, was not thin in the former version.
  Thinner,  ///< A part of the wall as large as a wall was thin in the former version, and thicker.
  Kept,     ///< The former version has a wall there, which was not thicker.
  Gone,     ///< A wall of the former version; the mesh has no wall there.
};
/// The name of an enumerator with a small first letter, for example "new".
[[nodiscard]] ASDFVK_API const char* nameOf(WallChange change);

/// A point where a wall is new or thinner than in a former version.
struct ChangedPlace {
  double thickness = 0;                   ///< Thickness at the point.
  std::optional<double> formerThickness;  ///< Thickness of the former version there; unset if it has no such place.
  uint64_t face = 0;                      ///< The input face of the point.
  Vec3d place;                            ///< The point.
};

/// Whether a place of the kind fails the check. settings: ThicknessOptions or a ThicknessReport.
template <typename Settings>
[[nodiscard]] bool isCounted(const Settings& settings, ThinKind kind) {
  return kind == ThinKind::Wall || kind == ThinKind::Gap || settings.countsEdges ||
         (settings.countsDetails && kind == ThinKind::Detail);
}

/// A region is a connected part of the surface that is thinner than the limit, together with the thin part on the other
/// side of the same wall. Lengths are in the unit of the mesh.
struct ThinRegion {
  ThinKind kind = ThinKind::Edge;  ///< The greatest kind of all points of the region: a wall if a point is a wall.
  /// The least thickness of all points of this kind. Beside a wall that tapers, its surface is thinner than this.
  double min = 0;
  uint64_t minFace = 0;   ///< Input face with this thickness.
  Vec3d place, opposite;  ///< Point of this thickness on the face, and its counterpart on the opposing wall.
  /// Input face of `opposite`; unset if a whole body is thin.
  std::optional<uint64_t> oppositeFace;
  /// Names of the one or two bodies at the place, or "component 3"; empty if the mesh has one body without a name.
  std::vector<std::string> bodies;
  double least = 0;         ///< The least thickness of all points of the region; 0 at a sharp edge.
  double angleDegrees = 0;  ///< Angle between the two surfaces at the place of `least`; 0 if they are parallel.
  double width = 0;         ///< Mean width of the thin surface, on both sides of an edge together.
  uint64_t faceCount = 0;   ///< Number of input faces that have a part in the region.
  double area = 0;          ///< Area of the thin parts of the faces.
  double areaShare = 0;     ///< `area` divided by the area of the mesh, or of the computed region.
  /// Set by a comparison for walls, and for other places that count.
  std::optional<WallChange> change = {};
  /// If only a part of the region is new or thinner: its thinnest point among those that were compared.
  std::optional<ChangedPlace> changedPlace = {};
};

/// The largest ball inside of a closed component, or of the space in a sealed void.
struct SectionBall {
  double diameter = 0;  ///< Diameter of the ball.
  Vec3d centre;         ///< Centre of the ball.
};

/// A part of the space without a way out. Lengths are in the unit of the mesh.
struct SealedVoid {
  double volume = 0;                          ///< Without the bodies inside.
  uint64_t face = 0;                          ///< An input face of its boundary.
  Vec3d place;                                ///< The barycentre of a triangle of this face.
  Vec3d size;                                 ///< Sides of the bounding box.
  std::vector<std::string> looseBodies = {};  ///< Names of the bodies that lie loose inside.
  /// False if bodies overlap in a common plane at its boundary, so that volume and way out are not certain. The void is
  /// then not judged.
  bool isCertain = true;
};

/// Two bodies that touch, cross or overlap. Where they do, they have no gap, not even one of width 0.
struct BodyContact {
  std::vector<std::string> bodies;  ///< Their names, see ThinRegion::bodies.
};

/// Result of comparing the thickness with a limit.
enum class ThicknessVerdict {
  Passed,     ///< No wall is thinner than the limit.
  Failed,     ///< A wall is thinner than the limit, or another thin place that counts.
  NotJudged,  ///< No place that fails the check was found, but a part of the surface could not be judged.
};
/// The name of an enumerator with a small first letter, for example "notJudged".
[[nodiscard]] ASDFVK_API const char* nameOf(ThicknessVerdict verdict);

/// A body whose largest ball inside is greater than ThicknessOptions::thickerThan.
struct ThickBody {
  std::vector<std::string> bodies;  ///< Its name, see ThinRegion::bodies.
  double diameter = 0;              ///< Diameter of the largest ball that was found inside. A larger one may exist.
  Vec3d centre;                     ///< Centre of the ball.
};

/// The largest balls inside of the bodies. The diameter of the largest ball of a body is its greatest thickness.
struct ThickReport {
  double thickerThan = 0;  ///< The limit.
  /// Failed: a ball is greater than 1.001 of the limit. NotJudged: none was found, but a component is not closed, or
  /// the search ended early.
  ThicknessVerdict verdict = ThicknessVerdict::Passed;
  std::string sentence;  ///< The verdict in one sentence.
  /// The diameter of the largest ball that was found, divided by ThicknessReport::min; NaN if one of them is not known.
  double ratio = kNoValue;
  std::vector<ThickBody> bodies;  ///< The bodies that are thicker than the limit, the thickest first.
};

/// Why faces cannot be compared with a limit.
enum class UnjudgedCause {
  Border,             ///< The surface is open: edges with one face. A thin wall may be missing there.
  Branching,          ///< Edges with three faces or another odd number: inside and outside are not defined.
  WoundAgainst,       ///< Edges whose faces are wound against each other.
  Inverted,           ///< Bodies wound inwards.
  DoubleSided,        ///< Each face has a copy that is wound the other way: there is no material.
  NegativeVolumes,    ///< The file has negative volumes, which were not subtracted from the bodies.
  CoarseCoordinates,  ///< The coordinates are float32 values, whose steps exceed a quarter of the limit.
};
/// The name of an enumerator with a small first letter, for example "woundAgainst".
[[nodiscard]] ASDFVK_API const char* nameOf(UnjudgedCause cause);
/// Whether the cause makes the whole surface uncertain. A thin wall may then be no wall of the shape: the verdict is
/// NotJudged in any case.
[[nodiscard]] ASDFVK_API bool concernsWholeMesh(UnjudgedCause cause);

/// A cause for which faces cannot be judged, and where.
struct UnjudgedReason {
  UnjudgedCause cause = UnjudgedCause::Border;  ///< The cause.
  uint64_t faceCount = 0;                       ///< Input faces of the components with this cause.
  uint64_t edgeCount = 0;                       ///< Edges with this cause; 0 for causes that are not at edges.
  uint64_t face = 0;                            ///< The first input face with this cause.
  Vec3d place;                                  ///< A point of this face, on the edge if the cause is at an edge.
  std::vector<std::string> bodies = {};         ///< Name of the body of this face, see ThinRegion::bodies.
  bool isRepairable = false;                    ///< Whether the orientation "auto" removes the cause.
  /// Number of negative volumes, or the step of the coordinates in the unit of the mesh. 0 for the other causes.
  double amount = 0;
};

/// Input faces for which the comparison with a limit is impossible or uncertain.
struct UnjudgedFaces {
  uint64_t openCount = 0;        ///< Faces of open components, because closing such a component may add a thin wall.
  uint64_t invertedCount = 0;    ///< Faces of closed components that are oriented inwards or inconsistently.
  uint64_t degenerateCount = 0;  ///< Faces without a normal or with a non-finite corner, which are ignored.
  uint64_t crossedCount = 0;     ///< Faces that other faces cross. They are judged in pieces.
  uint64_t insideCount = 0;      ///< Faces with a part inside of the material, which is no wall and is not judged.
  std::vector<UnjudgedReason> reasons;  ///< The causes that prevent a verdict, each with its place.

  /// Whether the surface may be thinner at some point than the least thickness that was found.
  [[nodiscard]] bool preventVerdict() const { return !reasons.empty(); }
};

/// The wall thickness (docs/thickness.md), or the width of gaps. Lengths are in the unit of the mesh. In a report on
/// gaps, the thickness is that of the space, walls are gaps, and ThinKind::Gap replaces ThinKind::Wall.
struct ThicknessReport {
  bool isOfGaps = false;                    ///< The report is about gaps, not about walls.
  std::optional<ThicknessVerdict> verdict;  ///< Unset without a limit.
  /// The first line of the text report: the verdict in one sentence. Without a limit, the least wall.
  std::string sentence;
  std::optional<double> thinnerThan;  ///< The limit: ThicknessOptions::thinnerThan or closerThan.
  bool countsDetails = false;         ///< Details fail the check, too.
  bool countsEdges = false;           ///< Details and edges fail the check, too.
  /// Failed: the least thickness of all thin regions that count. Otherwise: the next wall, which is the least wall at
  /// the smallest limit at which the check fails, to 5 %. Without a limit: the least wall of all that are wider than
  /// 1/500 of the mesh. NaN if it was not found, or if the search for it ended early (ThicknessOptions::findsNextWall).
  double min = kNoValue;
  std::optional<uint64_t> minFace;  ///< Input face with this thickness; unset if there is none.
  /// Point of this thickness on minFace, and the opposite point on the opposing wall.
  std::optional<Vec3d> minPlace, minOpposite;
  /// Percentiles of the thickness at the barycentres of the triangles, weighted by area.
  double percentile1 = kNoValue, percentile5 = kNoValue, median = kNoValue, percentile95 = kNoValue, max = kNoValue;
  uint64_t noValueCount = 0;  ///< Input faces without a thickness.
  UnjudgedFaces unjudged;     ///< Input faces for which the comparison with a limit is impossible or uncertain.
  /// The largest ball that was found inside of a closed component; unset without a closed component. A larger ball may
  /// exist, because the search ends as soon as it cannot change a thickness.
  std::optional<SectionBall> greatestSection;
  /// Area of all thin regions, and this area divided by the area of the mesh or of the computed region. NaN without a
  /// limit.
  double thinArea = kNoValue, thinAreaShare = kNoValue;
  /// Thin regions: walls, then details, then edges, each by ascending `min`. Empty without a limit.
  std::vector<ThinRegion> regions;
  std::optional<ThickReport> thick;  ///< Set with ThicknessOptions::thickerThan.

  [[nodiscard]] bool counts(ThinKind kind) const { return isCounted(*this, kind); }
};

/// A connected part of the surface that is thinner than 0.95 of its former thickness.
struct ThinnerRegion {
  double thickness = 0;        ///< Thickness at the place.
  double formerThickness = 0;  ///< Thickness of the former version there.
  uint64_t face = 0;           ///< The input face with the greatest relative decrease.
  Vec3d place;                 ///< The barycentre of a triangle of this face.
  uint64_t faceCount = 0;      ///< Number of input faces.
  double area = 0;             ///< Area of the triangles.
  double areaShare = 0;        ///< `area` divided by the area of the mesh, or of the computed region.
};

/// Comparison of the wall thickness with a former version of the mesh (docs/thickness.md#two-versions).
struct ComparisonReport {
  /// Unset without a limit. Failed: a wall is new or thinner. NotJudged: none is, but a part of the surface could not
  /// be judged, or no place is in both versions; or a wall may be, but the former version could not be judged there.
  std::optional<ThicknessVerdict> verdict;
  std::string sentence;  ///< The verdict in one sentence; without a limit, where the mesh became thinner.
  /// Numbers of walls, and of other places that count, by WallChange.
  uint64_t newCount = 0, thinnerCount = 0, keptCount = 0, goneCount = 0;
  std::optional<ThicknessVerdict> formerVerdict;  ///< The verdict on the former version.
  std::vector<ThinRegion> gone;                   ///< Walls that are gone, with faces of the former version.
  /// Input faces with a thickness for which the former version has no thickness at the same place.
  uint64_t unmatchedFaceCount = 0;
  uint64_t matchedFaceCount = 0;  ///< Input faces for which it has one. 0: the mesh may be moved or scaled.
  double thinnerArea = 0, thinnerAreaShare = 0;  ///< The area that is thinner than 0.95 of before, and its share.
  std::vector<ThinnerRegion> thinner;            ///< The 100 largest regions that became thinner, by descending area.
};

}  // namespace asdfvk
