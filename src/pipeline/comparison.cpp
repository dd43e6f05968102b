#include "pipeline/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/vec3.h"
#include "pipeline/surface_points.h"

namespace asdfvk {
namespace {

/// Number of points of a wall that are looked up in the other version.
constexpr size_t kPointsPerWall = 64;
/// A wall became thinner if more than one of so many points did.
constexpr uint32_t kPointsPerThinnerPoint = 8;
/// Points at most this far from a part of a wall are on it (normalised).
constexpr double kOnPart = 4 * kUnresolved;
// Progress after the former thickness of all faces, and after the walls of one version.
constexpr double kFacesProgress = 0.8, kWallsProgress = 0.9;

/// Points of a surface, in the unit of the mesh.
struct PlacedPoints {
  std::vector<Vec3d> points, normals;
  std::vector<uint32_t> faces;
  std::vector<double> thickness;

  void add(const MeasuredVersion& version, uint32_t face, const Vec3d& point) {
    points.push_back(point);
    normals.push_back(version.computation.prepared.geometry.normals[face]);
    faces.push_back(face);
  }
};

/// The point of a version that is at the same place as a point of the other version.
struct Counterpart {
  uint32_t face = kNoFace;  ///< A face of the surface; kNoFace if there is none.
  Vec3d point;              ///< Normalised.
  double distance = 0, thickness = kNoValue;
};

void measure(const MeasuredVersion& version, PlacedPoints& placed, const RunControl& control) {
  placed.thickness = thicknessAtPoints(version.surface, placed.points, placed.normals, placed.faces,
                                       version.computation.options.thickness, control);
}

std::vector<Counterpart> counterpartsOf(const PlacedPoints& placed, const MeasuredVersion& other,
                                        const RunControl& control) {
  std::vector<Counterpart> found(placed.points.size());
  const Normalization& unit = other.surface.scene().bvh.normalization;
  findNearestPoints(other.surface.scene(), placed.points, placed.normals, control.part(0, 0.5),
                    [&](size_t i, const SurfacePoint& nearest) {
                      if (nearest.face != kNoFace)
                        found[i] = {nearest.face, nearest.point, unit.toMeshLength(nearest.distance)};
                    });
  PlacedPoints opposite;
  std::vector<size_t> indices;
  for (size_t i = 0; i < found.size(); ++i) {
    if (found[i].face == kNoFace) continue;
    indices.push_back(i);
    opposite.add(other, found[i].face, unit.toMesh(found[i].point));
  }
  measure(other, opposite, control.part(0.5, 1));
  for (size_t k = 0; k < indices.size(); ++k) {
    Counterpart& each = found[indices[k]];
    const bool isSheet = other.surface.kindOf(each.face) == FaceKind::NoThickness;
    each.thickness = isSheet ? 0 : opposite.thickness[k];
    const double reach = std::max(each.thickness, placed.thickness[indices[k]]) / 2;
    if (!(each.distance <= reach + unit.contactLength())) each = {};
  }
  return found;
}

/// The parts of the counted regions of a version.
class CountedParts {
 public:
  explicit CountedParts(const MeasuredVersion& version) : version_(version) {
    const std::vector<ConnectedThinParts>& regions = version.thickness.regions;
    for (uint32_t region = 0; region < regions.size(); ++region)
      if (isCounted(version.computation.options.thickness, regions[region].kind))
        for (const ThinPart& part : regions[region].parts) parts_.push_back(rowOf(region, part));
    std::stable_sort(parts_.begin(), parts_.end(), [](const Row& a, const Row& b) { return a.face < b.face; });
  }

  /// Calls take(region) for the regions that have the point.
  template <typename Take>
  void forEachAt(const Counterpart& at, const Take& take) const {
    auto row = std::lower_bound(parts_.begin(), parts_.end(), at.face,
                                [](const Row& each, uint32_t face) { return each.face < face; });
    for (; row != parts_.end() && row->face == at.face; ++row) {
      if (squaredDistanceToBox(row->box, at.point) > 0) continue;  // Large faces have many parts.
      const PlaneTriangle triangle{row->part->corners, version_.computation.prepared.geometry.normals[at.face]};
      if (length(nearestPoint(triangle, at.point) - at.point) <= kOnPart) take(row->region);
    }
  }

 private:
  struct Row {
    uint32_t face = 0, region = 0;
    const ThinPart* part = nullptr;
    Box3d box;
  };
  static Row rowOf(uint32_t region, const ThinPart& part) {
    Row row{part.face, region, &part, {}};
    for (const Vec3d& corner : part.corners) {
      row.box.add(corner - Vec3d{kOnPart, kOnPart, kOnPart});
      row.box.add(corner + Vec3d{kOnPart, kOnPart, kOnPart});
    }
    return row;
  }

  const MeasuredVersion& version_;
  std::vector<Row> parts_;  // Ascending by face.
};

/// Points of the counted regions of a version.
struct WallPoints {
  PlacedPoints placed;
  std::vector<uint32_t> regionOf;
};

WallPoints wallPointsOf(const MeasuredVersion& version, const RunControl& control) {
  WallPoints points;
  const auto add = [&](uint32_t region, uint32_t face, const Vec3d& normalized) {
    points.placed.add(version, face, version.surface.scene().bvh.normalization.toMesh(normalized));
    points.regionOf.push_back(region);
  };
  const std::vector<ConnectedThinParts>& regions = version.thickness.regions;
  for (uint32_t i = 0; i < regions.size(); ++i) {
    if (!isCounted(version.computation.options.thickness, regions[i].kind)) continue;
    add(i, regions[i].place.face, regions[i].place.ball.ball.onFace);
    std::vector<const ThinPart*> parts;
    for (const ThinPart& part : regions[i].parts)
      if (part.isThinAtMiddle) parts.push_back(&part);
    const size_t count = std::min(parts.size(), kPointsPerWall);
    for (size_t k = 0; k < count; ++k) {
      const ThinPart& part = *parts[k * parts.size() / count];
      add(i, part.face, middleOf(part.corners));
    }
  }
  measure(version, points.placed, control);
  for (size_t i = 0; i < points.regionOf.size(); ++i)
    if (std::isnan(points.placed.thickness[i])) points.placed.thickness[i] = 0;  // A sheet.
  return points;
}

/// The walls of `from` that are also walls of `to`.
struct CommonWalls {
  std::vector<uint8_t> ofFrom, ofTo;  // By region.
  /// By region of `from`: whether the least thickness, or that at enough points, is below the share of that of `to`.
  std::vector<uint8_t> isThinner;
};

double leastOf(const ConnectedThinParts& region) { return region.place.ball.ball.diameter; }

CommonWalls findCommonWalls(const MeasuredVersion& from, const MeasuredVersion& to, const RunControl& control) {
  const std::vector<ConnectedThinParts>&regions = from.thickness.regions, &others = to.thickness.regions;
  CommonWalls common{std::vector<uint8_t>(regions.size()), std::vector<uint8_t>(others.size()),
                     std::vector<uint8_t>(regions.size())};
  const double scaleRatio = from.surface.scene().bvh.normalization.scale / to.surface.scene().bvh.normalization.scale;
  const WallPoints points = wallPointsOf(from, control);
  const std::vector<Counterpart> counterparts = counterpartsOf(points.placed, to, control);
  const CountedParts parts(to);
  std::vector<uint32_t> pointCounts(regions.size()), thinnerCounts(regions.size());
  std::vector<double> leastOfOthers(regions.size(), std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < counterparts.size(); ++i) {
    const Counterpart& at = counterparts[i];
    const uint32_t region = points.regionOf[i];
    ++pointCounts[region];
    if (at.face == kNoFace) continue;
    parts.forEachAt(at, [&](uint32_t other) {
      common.ofFrom[region] = common.ofTo[other] = 1;
      leastOfOthers[region] = std::min(leastOfOthers[region], leastOf(others[other]) * scaleRatio);
    });
    if (points.placed.thickness[i] < kThinnerShare * at.thickness) ++thinnerCounts[region];
  }
  for (size_t i = 0; i < regions.size(); ++i)
    common.isThinner[i] = leastOf(regions[i]) < kThinnerShare * leastOfOthers[i] ||
                                  thinnerCounts[i] * kPointsPerThinnerPoint > pointCounts[i]
                              ? 1
                              : 0;
  return common;
}

void setWallChanges(const MeasuredVersion& now, const MeasuredVersion& former, const RunControl& control) {
  const CommonWalls forward = findCommonWalls(now, former, control), back = findCommonWalls(former, now, control);
  const auto set = [](const MeasuredVersion& version, const auto& changeOf) {
    const std::vector<ConnectedThinParts>& regions = version.thickness.regions;
    version.thickness.wallChanges.assign(regions.size(), std::nullopt);
    for (size_t i = 0; i < regions.size(); ++i)
      if (isCounted(version.computation.options.thickness, regions[i].kind))
        version.thickness.wallChanges[i] = changeOf(i);
  };
  set(now, [&](size_t i) {
    if (forward.ofFrom[i] == 0 && back.ofTo[i] == 0) return WallChange::New;
    return forward.isThinner[i] != 0 ? WallChange::Thinner : WallChange::Kept;
  });
  set(former,
      [&](size_t i) { return forward.ofTo[i] == 0 && back.ofFrom[i] == 0 ? WallChange::Gone : WallChange::Kept; });
}

}  // namespace

std::vector<double> compareVersions(const MeasuredVersion& now, const MeasuredVersion& former,
                                    const RunControl& control) {
  const PreparedMesh& prepared = now.computation.prepared;
  PlacedPoints placed;
  std::vector<uint32_t> faces;
  for (const uint32_t face : prepared.traceableFaces) {
    if (std::isnan(now.thickness.atBarycentre[face])) continue;
    if (!now.computation.domain.contains(prepared.mesh.inputFaceOf(face))) continue;
    faces.push_back(face);
    placed.add(now, face, prepared.geometry.barycentres[face]);
    placed.thickness.push_back(now.thickness.atBarycentre[face]);
  }
  const std::vector<Counterpart> counterparts = counterpartsOf(placed, former, control.part(0, kFacesProgress));
  std::vector<double> thickness(prepared.mesh.faceCount(), kNoValue);
  for (size_t i = 0; i < faces.size(); ++i) thickness[faces[i]] = counterparts[i].thickness;
  setWallChanges(now, former, control.part(kFacesProgress, kWallsProgress).withoutProgress());
  control.checkpoint(1);
  return thickness;
}

}  // namespace asdfvk
