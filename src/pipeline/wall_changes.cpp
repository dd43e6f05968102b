#include "pipeline/wall_changes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/vec3.h"
#include "pipeline/thin_part_index.h"

namespace asdfvk {
namespace {

/// Number of points of a wall besides those of its faces.
constexpr size_t kPointsPerWall = 64;
/// Numbers of worse points of a wall around which a disc is looked for: first, and if none of these has one.
constexpr size_t kFirstDiscCount = 8, kMaxDiscCount = 256;
constexpr size_t kPointsPerDisc = 6;
constexpr double kDiscRadius = 7.0 / 16;  // In units of the thickness.

enum class PointChange : uint8_t {
  None,
  Thinner,  ///< Thin before, and thinner now.
  Added,    ///< Thinner now, and not thin before; or without a place in the former version.
};

bool isOfCountedKind(const MeasuredVersion& version, size_t region) {
  return isCounted(version.computation.options.thickness, version.thickness.regions[region].kind);
}

/// Points of the counted regions of a version with their counterparts.
struct WallPoints {
  PlacedPoints placed;
  std::vector<uint32_t> regionOf;
  std::vector<Counterpart> counterparts;
};

/// Some of the parts, ascending by face: at most kPointsPerWall or, if `ofEachFace`, also one of each face. parts: by
/// ascending face.
std::vector<const ThinPart*> sampleOf(std::span<const ThinPart* const> parts, bool ofEachFace) {
  std::vector<const ThinPart*> sample;
  for (size_t i = 0; i < parts.size(); ++i) {
    const bool isChosen = i * kPointsPerWall / parts.size() != (i + 1) * kPointsPerWall / parts.size(),
               isFirst = i == 0 || parts[i]->face != parts[i - 1]->face;
    if (isChosen || (ofEachFace && isFirst)) sample.push_back(parts[i]);
  }
  return sample;
}

/// The place and the middles of some parts of each counted region. ofFaces: the counterparts of the barycentres, which
/// need not be found again; empty: none are known, and not every face has a point.
WallPoints wallPointsOf(const MeasuredVersion& version, const MeasuredVersion& other,
                        std::span<const Counterpart> ofFaces, const RunControl& control) {
  const Normalization& unit = version.surface.scene().bvh.normalization;
  const FaceGeometry& geometry = version.computation.prepared.geometry;
  WallPoints points, known;
  const auto add = [&](WallPoints& to, uint32_t region, uint32_t face, const Vec3d& point) {
    to.placed.add(version, face, point);
    to.regionOf.push_back(region);
  };
  const std::vector<ConnectedThinParts>& regions = version.thickness.regions;
  for (uint32_t region = 0; region < regions.size(); ++region) {
    if (!isOfCountedKind(version, region)) continue;
    const WallPlace& place = regions[region].place;
    add(points, region, place.face, unit.toMesh(place.ball.ball.onFace));
    std::vector<const ThinPart*> parts;
    for (const ThinPart& part : regions[region].parts)
      if (part.isThinAtMiddle) parts.push_back(&part);
    std::stable_sort(parts.begin(), parts.end(),
                     [](const ThinPart* a, const ThinPart* b) { return a->face < b->face; });
    for (const ThinPart* const part : sampleOf(parts, !ofFaces.empty())) {
      const Vec3d middle = unit.toMesh(middleOf(part->corners)), &barycentre = geometry.barycentres[part->face];
      const bool isKnown = !ofFaces.empty() && ofFaces[part->face].face != kNoFace &&
                           length(middle - barycentre) <= unit.contactLength();
      add(isKnown ? known : points, region, part->face, isKnown ? barycentre : middle);
    }
  }
  measure(version, points.placed, control);
  points.counterparts = counterpartsOf(points.placed, other, control);
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
      : now_(now), former_(former), partsOfNow_(now), partsOfFormer_(former) {}

  void run(std::span<const Counterpart> ofFaces, const RunControl& control) {
    const size_t count = now_.thickness.regions.size(), formerCount = former_.thickness.regions.size();
    now_.thickness.wallChanges.assign(count, std::nullopt);
    now_.thickness.changedPlaces.assign(count, std::nullopt);
    former_.thickness.wallChanges.assign(formerCount, std::nullopt);
    former_.thickness.changedPlaces.assign(formerCount, std::nullopt);
    std::vector<uint8_t> isMatched(count), isFormerMatched(formerCount);
    const WallPoints points = wallPointsOf(now_, former_, ofFaces, control);
    for (size_t i = 0; i < points.regionOf.size(); ++i)
      if (partsOfFormer_.forEachAt(points.counterparts[i], [&](uint32_t region) { isFormerMatched[region] = 1; }))
        isMatched[points.regionOf[i]] = 1;
    matchFormer(isMatched, isFormerMatched, control);
    for (size_t region = 0; region < count; ++region)
      if (isOfCountedKind(now_, region))
        now_.thickness.wallChanges[region] = isMatched[region] != 0 ? WallChange::Kept : WallChange::New;
    for (size_t region = 0; region < formerCount; ++region)
      if (isOfCountedKind(former_, region))
        former_.thickness.wallChanges[region] = isFormerMatched[region] != 0 ? WallChange::Kept : WallChange::Gone;
    findWorseParts(points, control);
  }

 private:
  /// Points of a region that changed alike.
  struct Candidates {
    uint32_t region = 0;
    PointChange change = PointChange::None;
    std::vector<size_t> points;
  };

  /// Former walls whose places are outside of the region that was computed count as matched, because the walls there
  /// are not known.
  void matchFormer(std::vector<uint8_t>& isMatched, std::vector<uint8_t>& isFormerMatched, const RunControl& control) {
    const WallPoints points = wallPointsOf(former_, now_, {}, control);
    std::vector<uint32_t> faces;
    for (const Counterpart& at : points.counterparts) faces.push_back(at.face);
    if (!now_.computation.region.hasAll())
      findNearestPoints(now_.surface.scene(), points.placed.points, control,
                        [&](size_t i, const SurfacePoint& nearest) {
                          if (faces[i] == kNoFace) faces[i] = nearest.face;
                        });
    for (size_t i = 0; i < points.regionOf.size(); ++i) {
      const bool isOutside = faces[i] != kNoFace &&
                             !now_.computation.region.contains(now_.computation.prepared.mesh.inputFaceOf(faces[i]));
      if (partsOfNow_.forEachAt(points.counterparts[i], [&](uint32_t region) { isMatched[region] = 1; }) || isOutside)
        isFormerMatched[points.regionOf[i]] = 1;
    }
  }

  [[nodiscard]] PointChange changeOf(const ThicknessRange& thickness, const Counterpart& at) const {
    if (at.face == kNoFace || std::isnan(at.thickness.low)) return PointChange::Added;
    if (!isThinner(thickness, at.thickness)) return PointChange::None;
    return partsOfFormer_.contains(at) ? PointChange::Thinner : PointChange::Added;
  }

  /// For walls that were matched: the points that became worse, a group per region and change.
  [[nodiscard]] std::vector<Candidates> candidatesOf(const WallPoints& points) const {
    std::vector<std::vector<size_t>> pointsOf(now_.thickness.regions.size());
    for (size_t i = 0; i < points.regionOf.size(); ++i) pointsOf[points.regionOf[i]].push_back(i);
    const auto isCapped = [&](size_t i) { return points.placed.thickness[i].isCapped; };
    std::vector<Candidates> groups;
    for (uint32_t region = 0; region < pointsOf.size(); ++region) {
      if (now_.thickness.wallChanges[region] != WallChange::Kept) continue;
      Candidates thinner{region, PointChange::Thinner, {}}, added{region, PointChange::Added, {}};
      const bool areAllCapped = std::all_of(pointsOf[region].begin(), pointsOf[region].end(), isCapped);
      for (const size_t i : pointsOf[region]) {
        if (!areAllCapped && isCapped(i)) continue;  // The section that limits a capped point may be far away.
        const PointChange change = changeOf(points.placed.thickness[i], points.counterparts[i]);
        if (change != PointChange::None) (change == PointChange::Thinner ? thinner : added).points.push_back(i);
      }
      for (Candidates& group : {std::ref(thinner), std::ref(added)})
        if (!group.points.empty()) groups.push_back(std::move(group));
    }
    return groups;
  }

  /// Finds the matched walls with a disc of points that became worse: first around a few points of each, then around
  /// more points of those without such a disc.
  void findWorseParts(const WallPoints& points, const RunControl& control) {
    std::vector<Candidates> groups = candidatesOf(points);
    for (const size_t maxCount : {kFirstDiscCount, kMaxDiscCount}) {
      std::vector<size_t> middles, ends;
      for (const Candidates& group : groups) {
        const size_t count = std::min(maxCount, group.points.size());
        for (size_t k = 0; k < count; ++k) middles.push_back(group.points[k * group.points.size() / count]);
        ends.push_back(middles.size());
      }
      if (middles.empty()) return;
      const std::vector<uint8_t> isWorse = areDiscsWorse(points.placed, middles, control);
      size_t begin = 0;
      for (size_t group = 0; group < groups.size(); begin = ends[group], ++group)
        for (size_t k = begin; k < ends[group]; ++k)
          if (isWorse[k] != 0) keepWorse(groups[group], points, middles[k]);
      std::erase_if(groups, [&](const Candidates& group) {
        return group.points.size() <= maxCount || now_.thickness.changedPlaces[group.region].has_value();
      });
    }
  }

  /// A wall with a part that became thinner is not also called new. Its place is the thinnest one.
  void keepWorse(const Candidates& group, const WallPoints& points, size_t i) {
    std::optional<WallChange>& change = now_.thickness.wallChanges[group.region];
    std::optional<ChangedPlace>& place = now_.thickness.changedPlaces[group.region];
    const bool isOfThinner = group.change == PointChange::Thinner;
    if (change == WallChange::Thinner && !isOfThinner) return;
    const ChangedPlace found = placeOf(points, i);
    if (!place || !(place->thickness <= found.thickness)) place = found;
    change = isOfThinner ? WallChange::Thinner : WallChange::New;
  }

  [[nodiscard]] ChangedPlace placeOf(const WallPoints& points, size_t i) const {
    const Counterpart& at = points.counterparts[i];
    return {points.placed.thickness[i].low,
            at.face == kNoFace || std::isnan(at.thickness.low) ? std::nullopt : std::optional(at.thickness.low),
            now_.computation.prepared.mesh.inputFaceOf(points.placed.faces[i]), points.placed.points[i]};
  }

  /// For each middle, whether the points on the border of its disc became worse, too.
  [[nodiscard]] std::vector<uint8_t> areDiscsWorse(const PlacedPoints& placed, std::span<const size_t> middles,
                                                   const RunControl& control) const {
    std::vector<Vec3d> points, normals;
    for (const size_t i : middles) {
      const Vec3d& normal = placed.normals[i];
      const Vec3d across = cross(normal, std::abs(normal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0});
      const Vec3d side = across / length(across), other = cross(normal, side);
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
  ThinPartIndex partsOfNow_, partsOfFormer_;
};

}  // namespace

void setWallChanges(const MeasuredVersion& now, const MeasuredVersion& former, std::span<const Counterpart> ofFaces,
                    const RunControl& control) {
  WallComparison(now, former).run(ofFaces, control);
}

}  // namespace asdfvk
