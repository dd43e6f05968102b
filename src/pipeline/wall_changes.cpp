#include "pipeline/wall_changes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/vec3.h"
#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

/// Number of points of a wall besides those of its faces.
constexpr size_t kPointsPerWall = 64;
/// Numbers of worse points of a wall around which a disc is looked for: first, and if none of these has one.
constexpr size_t kFirstDiscCount = 8, kMaxDiscCount = 256;
constexpr size_t kPointsPerDisc = 6;
constexpr double kDiscRadius = 7.0 / 16;  // In units of the thickness.
/// Points at most this far from a part of a wall are on it (normalised).
constexpr double kOnPart = 4 * kUnresolved;

enum class PointChange : uint8_t {
  None,
  Thinner,  ///< Thin before, and thinner now.
  Added,    ///< Thinner now, and not thin before; or without a place in the former version.
  Unknown,  ///< Without a place in a former version in which a surface may be missing.
};

bool isOfCountedKind(const MeasuredVersion& version, size_t region) {
  return isCounted(version.computation.options.thickness, version.thickness.regions[region].kind);
}

/// The thin parts of a version, of all kinds: the kind of a place near the limits of a kind depends on the
/// triangulation.
class ThinPartsOfFaces {
 public:
  explicit ThinPartsOfFaces(const MeasuredVersion& version) : version_(version) {
    const std::vector<ConnectedThinParts>& regions = version.thickness.regions;
    for (uint32_t region = 0; region < regions.size(); ++region)
      for (const ThinPart& part : regions[region].parts) parts_.push_back({part.face, region, &part});
    std::stable_sort(parts_.begin(), parts_.end(), [](const Row& a, const Row& b) { return a.face < b.face; });
  }

  /// Calls take(region) for the regions that have the point. Returns whether there is one.
  template <typename Take>
  bool forEachAt(const Counterpart& at, const Take& take) const {
    bool isThin = false;
    auto row = std::lower_bound(parts_.begin(), parts_.end(), at.face,
                                [](const Row& each, uint32_t face) { return each.face < face; });
    for (; row != parts_.end() && row->face == at.face; ++row) {
      const auto& [a, b, c] = row->part->corners;
      const Vec3d middle = (a + b + c) / 3.0;
      const double reach = std::max({length(a - middle), length(b - middle), length(c - middle)}) + kOnPart;
      if (length(at.point - middle) > reach) continue;  // Large faces have many parts.
      const PlaneTriangle triangle{row->part->corners, version_.computation.prepared.geometry.normals[at.face]};
      if (length(nearestPoint(triangle, at.point) - at.point) > kOnPart) continue;
      isThin = true;
      take(row->region);
    }
    return isThin;
  }
  [[nodiscard]] bool contains(const Counterpart& at) const {
    return forEachAt(at, [](uint32_t) {});
  }

 private:
  struct Row {
    uint32_t face = 0, region = 0;
    const ThinPart* part = nullptr;
  };

  const MeasuredVersion& version_;
  std::vector<Row> parts_;  // Ascending by face.
};

/// Points of the counted regions of a version with their counterparts.
struct WallPoints {
  PlacedPoints placed;
  std::vector<uint32_t> regionOf;
  std::vector<Counterpart> counterparts;
};

void keepCounterparts(WallPoints& points, const MeasuredVersion& of, const MeasuredVersion& other,
                      const RunControl& control) {
  measure(of, points.placed, control);
  points.counterparts = counterpartsOf(points.placed, other, control);
}

/// The place, and some points of each counted region: one of each face, if `ofFaces` has no counterpart at the middle
/// of its only part, and others of faces with many parts.
WallPoints wallPointsOf(const MeasuredVersion& version, const MeasuredVersion& other,
                        std::span<const Counterpart> ofFaces, const RunControl& control) {
  const Normalization& unit = version.surface.scene().bvh.normalization;
  const FaceGeometry& geometry = version.computation.prepared.geometry;
  WallPoints points, known;
  const auto add = [&](WallPoints& to, uint32_t region, uint32_t face, const Vec3d& point) {
    to.placed.add(version, face, point);
    to.regionOf.push_back(region);
  };
  const auto addPart = [&](uint32_t region, const ThinPart& part, bool isOnly) {
    const Vec3d middle = unit.toMesh(middleOf(part.corners));
    const bool isWhole = isOnly && !ofFaces.empty() && ofFaces[part.face].face != kNoFace &&
                         length(middle - geometry.barycentres[part.face]) <= unit.contactLength();
    add(isWhole ? known : points, region, part.face, isWhole ? geometry.barycentres[part.face] : middle);
  };
  const std::vector<ConnectedThinParts>& regions = version.thickness.regions;
  for (uint32_t i = 0; i < regions.size(); ++i) {
    if (!isOfCountedKind(version, i)) continue;
    add(points, i, regions[i].place.face, unit.toMesh(regions[i].place.ball.ball.onFace));
    std::vector<const ThinPart*> parts;
    for (const ThinPart& part : regions[i].parts)
      if (part.isThinAtMiddle) parts.push_back(&part);
    std::stable_sort(parts.begin(), parts.end(),
                     [](const ThinPart* a, const ThinPart* b) { return a->face < b->face; });
    for (size_t begin = 0, end = 0; begin < parts.size(); begin = end) {
      while (end < parts.size() && parts[end]->face == parts[begin]->face) ++end;
      const size_t count = std::max<size_t>(1, kPointsPerWall * (end - begin) / parts.size());
      if (ofFaces.empty() && count * parts.size() < kPointsPerWall) continue;
      for (size_t k = 0; k < std::min(count, end - begin); ++k)
        addPart(i, *parts[begin + k * (end - begin) / std::min(count, end - begin)], end - begin == 1);
    }
  }
  keepCounterparts(points, version, other, control);
  for (size_t i = 0; i < known.regionOf.size(); ++i) {
    const uint32_t face = known.placed.faces[i];
    add(points, known.regionOf[i], face, known.placed.points[i]);
    points.placed.thickness.push_back(rangeAtBarycentre(version, face));
    points.counterparts.push_back(ofFaces[face]);
  }
  return points;
}

class WallComparison {
 public:
  WallComparison(const MeasuredVersion& now, const MeasuredVersion& former)
      : now_(now),
        former_(former),
        partsOfNow_(now),
        partsOfFormer_(former),
        mayMissSurface_(former.thickness.unjudged.preventVerdict() ||
                        former.computation.prepared.traceableFaces.empty()),
        isInsideKnown_(std::ranges::all_of(former.thickness.unjudged.reasons, [](const UnjudgedReason& reason) {
          return reason.cause == UnjudgedCause::Border || reason.cause == UnjudgedCause::Branching;
        })) {}

  void run(std::span<const Counterpart> ofFaces, const RunControl& control) {
    const size_t count = now_.thickness.regions.size(), formerCount = former_.thickness.regions.size();
    std::vector<uint8_t> isMatched(count), isFormerMatched(formerCount);
    const WallPoints points = wallPointsOf(now_, former_, ofFaces, control);
    for (size_t i = 0; i < points.regionOf.size(); ++i)
      if (partsOfFormer_.forEachAt(points.counterparts[i], [&](uint32_t region) { isFormerMatched[region] = 1; }))
        isMatched[points.regionOf[i]] = 1;
    const WallPoints formerPoints = wallPointsOf(former_, now_, {}, control);
    for (size_t i = 0; i < formerPoints.regionOf.size(); ++i)
      if (partsOfNow_.forEachAt(formerPoints.counterparts[i], [&](uint32_t region) { isMatched[region] = 1; }) ||
          isOutside(formerPoints, i))
        isFormerMatched[formerPoints.regionOf[i]] = 1;
    now_.thickness.wallChanges.assign(count, std::nullopt);
    now_.thickness.changedPlaces.assign(count, std::nullopt);
    former_.thickness.wallChanges.assign(formerCount, std::nullopt);
    former_.thickness.changedPlaces.assign(formerCount, std::nullopt);
    std::vector<std::vector<size_t>> pointsOf(count);
    for (size_t i = 0; i < points.regionOf.size(); ++i) pointsOf[points.regionOf[i]].push_back(i);
    for (size_t region = 0; region < count; ++region)
      if (isOfCountedKind(now_, region)) judge(region, points, pointsOf[region], isMatched[region] != 0, control);
    for (size_t region = 0; region < formerCount; ++region)
      if (isOfCountedKind(former_, region))
        former_.thickness.wallChanges[region] = isFormerMatched[region] != 0 ? WallChange::Kept : WallChange::Gone;
  }

 private:
  /// Whether the place of a former point is outside of the domain, where no walls of `now` are known.
  [[nodiscard]] bool isOutside(const WallPoints& formerPoints, size_t i) const {
    uint32_t face = formerPoints.counterparts[i].face;
    if (now_.computation.region.hasAll()) return false;
    if (face == kNoFace)
      findNearestPoints(now_.surface.scene(), std::span(&formerPoints.placed.points[i], 1), RunControl(),
                        [&](size_t, const SurfacePoint& nearest) { face = nearest.face; });
    return face != kNoFace && !now_.computation.region.contains(now_.computation.prepared.mesh.inputFaceOf(face));
  }

  [[nodiscard]] PointChange changeOf(const ThicknessRange& thickness, const Counterpart& at) const {
    if (at.face == kNoFace || std::isnan(at.thickness.low))
      return mayMissSurface_ ? PointChange::Unknown : PointChange::Added;
    if (!isThinner(thickness, at.thickness)) return PointChange::None;
    return partsOfFormer_.contains(at) ? PointChange::Thinner : PointChange::Added;
  }

  /// own: the points of the region.
  void judge(size_t region, const WallPoints& points, std::span<const size_t> own, bool isMatched,
             const RunControl& control) {
    std::vector<size_t> worse[4];  // By PointChange.
    bool hasCounterpart = false;
    const auto isCapped = [&](size_t i) { return points.placed.thickness[i].isCapped; };
    const bool areAllCapped = std::all_of(own.begin(), own.end(), isCapped);
    for (const size_t i : own) {
      hasCounterpart = hasCounterpart || points.counterparts[i].face != kNoFace;
      // The section that limits a capped point may be far away.
      if (areAllCapped || !isCapped(i))
        worse[static_cast<size_t>(changeOf(points.placed.thickness[i], points.counterparts[i]))].push_back(i);
    }
    std::optional<WallChange>& change = now_.thickness.wallChanges[region];
    const auto isWorse = [&](PointChange kind) {
      const std::optional<size_t> middle = thinnestDisc(points, worse[static_cast<size_t>(kind)], control);
      if (middle) now_.thickness.changedPlaces[region] = placeOf(points, *middle);
      return middle.has_value();
    };
    if (!isMatched) {
      change = WallChange::New;
      if (hasCounterpart || !mayMissSurface_) keepWorse();
      return;
    }
    const bool isThinner = isWorse(PointChange::Thinner);
    if (isThinner || isWorse(PointChange::Added)) {
      change = isThinner ? WallChange::Thinner : WallChange::New;
      keepWorse();
    } else {
      change = isWorse(PointChange::Unknown) ? WallChange::New : WallChange::Kept;
    }
  }

  void keepWorse() { now_.thickness.isWorseForSure = isInsideKnown_; }

  [[nodiscard]] ChangedPlace placeOf(const WallPoints& points, size_t i) const {
    const Counterpart& at = points.counterparts[i];
    return {points.placed.thickness[i].low,
            at.face == kNoFace || std::isnan(at.thickness.low) ? std::nullopt : std::optional(at.thickness.low),
            now_.computation.prepared.mesh.inputFaceOf(points.placed.faces[i]), points.placed.points[i]};
  }

  /// The thinnest of those points that are the middle of a disc of points that became worse.
  [[nodiscard]] std::optional<size_t> thinnestDisc(const WallPoints& points, std::span<const size_t> middles,
                                                   const RunControl& control) const {
    for (const size_t maxCount : {kFirstDiscCount, kMaxDiscCount}) {
      const size_t count = std::min(maxCount, middles.size());
      std::vector<size_t> chosen;
      for (size_t k = 0; k < count; ++k) chosen.push_back(middles[k * middles.size() / count]);
      const std::vector<uint8_t> isWorse = areDiscsWorse(points.placed, chosen, control);
      std::optional<size_t> thinnest;
      for (size_t k = 0; k < count; ++k)
        if (isWorse[k] != 0 &&
            !(thinnest && points.placed.thickness[*thinnest].low <= points.placed.thickness[chosen[k]].low))
          thinnest = chosen[k];
      if (thinnest || count == middles.size()) return thinnest;
    }
    return std::nullopt;
  }

  /// For each middle, whether all points of its disc became worse.
  [[nodiscard]] std::vector<uint8_t> areDiscsWorse(const PlacedPoints& placed, std::span<const size_t> middles,
                                                   const RunControl& control) const {
    std::vector<Vec3d> points, normals;
    for (const size_t i : middles) {
      const Vec3d& normal = placed.normals[i];
      const Vec3d side = unitVector(cross(normal, std::abs(normal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
      const Vec3d other = cross(normal, side);
      for (size_t k = 0; k < kPointsPerDisc; ++k) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(k) / kPointsPerDisc;
        const double radius = kDiscRadius * placed.thickness[i].low;
        points.push_back(placed.points[i] + radius * (std::cos(angle) * side + std::sin(angle) * other));
        normals.push_back(normal);
      }
    }
    const PreparedScene& scene = now_.surface.scene();
    const Normalization& unit = scene.bvh.normalization;
    std::vector<SurfacePoint> nearest(points.size());
    findNearestPoints(scene, points, normals, control,
                      [&](size_t i, const SurfacePoint& found) { nearest[i] = found; });
    PlacedPoints around;
    std::vector<size_t> discOf;
    std::vector<uint8_t> isWorse(middles.size(), 1);
    for (size_t i = 0; i < points.size(); ++i) {
      const size_t disc = i / kPointsPerDisc;
      const double radius = kDiscRadius * placed.thickness[middles[disc]].low;
      // Farther away, the disc reaches beyond the surface.
      const bool isOn =
          nearest[i].face != kNoFace && unit.toMeshLength(nearest[i].distance) <= radius / 4 + unit.contactLength();
      if (!isOn) isWorse[disc] = 0;
      if (!isOn) continue;
      around.add(now_, nearest[i].face, unit.toMesh(nearest[i].point));
      discOf.push_back(disc);
    }
    measure(now_, around, control);
    const std::vector<Counterpart> counterparts = counterpartsOf(around, former_, control);
    for (size_t i = 0; i < around.size(); ++i)
      if (changeOf(around.thickness[i], counterparts[i]) == PointChange::None) isWorse[discOf[i]] = 0;
    return isWorse;
  }

  const MeasuredVersion& now_;
  const MeasuredVersion& former_;
  ThinPartsOfFaces partsOfNow_, partsOfFormer_;
  bool mayMissSurface_;  ///< Whether the former version may have had walls where it has no surface.
  bool isInsideKnown_;   ///< Whether the former version has a known thickness where it has surface.
};

}  // namespace

void setWallChanges(const MeasuredVersion& now, const MeasuredVersion& former, std::span<const Counterpart> ofFaces,
                    const RunControl& control) {
  WallComparison(now, former).run(ofFaces, control);
}

}  // namespace asdfvk
