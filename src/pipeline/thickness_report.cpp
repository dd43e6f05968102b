#include "pipeline/thickness_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

#include "core/check.h"
#include "core/elementary.h"
#include "core/weighted_sample.h"
#include "pipeline/value_report.h"
#include "trace/wall_rule.h"

namespace asdfvk {
namespace {

/// Coordinates of places are rounded to 0 below this share of the diameter, and below this number of contact lengths.
constexpr double kSmallShare = 1e-3, kLeastCoordinate = 0x1p-20;

class Description {
 public:
  Description(const Computation& computation, const JudgedSurface& surface, const FaceThickness& thickness,
              const BodyNames& names)
      : computation_(computation),
        surface_(surface),
        thickness_(thickness),
        names_(names),
        prepared_(computation.prepared),
        unit_(computation.scene.bvh.normalization) {}

  ThicknessReport run(uint32_t firstRegion, ThinSurface& thin) {
    const ThicknessOptions& options = computation_.options.thickness;
    report_.isOfGaps = surface_.isSpace();
    describePercentiles();
    report_.noValueCount =
        countWithoutValue(computation_.region, thicknessOfInputFaces(prepared_.mesh, thickness_.least));
    if (thickness_.greatestSection)
      report_.greatestSection = {thickness_.greatestSection->diameter, thickness_.greatestSection->centre};
    report_.unjudged = thickness_.unjudged;
    for (UnjudgedReason& reason : report_.unjudged.reasons)
      if (!concernsWholeMesh(reason.cause)) reason.bodies = names_.ofInputFace(reason.face);
    report_.thinnerThan = surface_.limitIn(options);
    report_.countsDetails = options.countsDetails;
    report_.countsEdges = options.countsEdges;
    if (report_.thinnerThan) describeRegions(firstRegion, thin);
    describeLeast();
    if (options.thickerThan && !surface_.isSpace()) report_.thick = describeThick(options.thickerThan->value);
    if (!report_.thinnerThan) return std::move(report_);
    report_.verdict = verdict();
    ASDFVK_CHECK(report_.verdict != ThicknessVerdict::Passed || !(report_.min < kThinShare * *report_.thinnerThan));
    return std::move(report_);
  }

 private:
  /// A point of a ball, with 0 for coordinates that are nearly 0 compared with the ball.
  [[nodiscard]] Vec3d placeInMesh(const Vec3d& p, double diameter) const {
    Vec3d place = unit_.toMesh(p);
    const double small = std::clamp(kSmallShare * unit_.toMeshLength(diameter),
                                    kLeastCoordinate * unit_.contactLength(), unit_.contactLength());
    for (size_t axis = 0; axis < 3; ++axis)
      if (std::abs(place[axis]) < small) place[axis] = 0;
    return place;
  }
  /// A thickness in the unit of the mesh; 0 if float32 does not resolve it.
  [[nodiscard]] double thicknessOf(const WallPlace& place) const {
    const double diameter = place.ball.ball.diameter;
    return diameter <= kUnresolved ? 0 : unit_.toMeshLength(diameter);
  }

  void describePercentiles() {
    WeightedSample sample;
    for (size_t face = 0; face < thickness_.atBarycentre.size(); ++face)
      if (!std::isnan(thickness_.atBarycentre[face]))
        sample.add(thickness_.atBarycentre[face], prepared_.geometry.areas[face]);
    if (sample.isEmpty()) return;
    sample.sort();
    report_.percentile1 = sample.quantile(0.01);
    report_.percentile5 = sample.quantile(0.05);
    report_.median = sample.quantile(0.5);
    report_.percentile95 = sample.quantile(0.95);
    report_.max = sample.max();
  }

  void describeRegions(uint32_t firstRegion, ThinSurface& thin) {
    const std::span<const ConnectedThinParts> found = thickness_.regions;
    std::vector<ThinRegion> regions;
    for (size_t i = 0; i < found.size(); ++i) {
      regions.push_back(describeRegion(found[i]));
      if (thickness_.wallChanges.empty()) continue;
      regions.back().change = thickness_.wallChanges[i];
      regions.back().changedPlace = thickness_.changedPlaces[i];
    }
    std::vector<uint32_t> order(regions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      const auto rank = [&](uint32_t i) { return std::tuple(regions[i].kind, regions[i].min, -regions[i].area); };
      return rank(a) < rank(b);
    });
    const double total = computedArea(computation_);
    report_.thinArea = report_.thinAreaShare = 0;
    for (const uint32_t i : order) {
      ThinRegion& region = regions[i];
      region.areaShare = total > 0 ? region.area / total : 0;
      report_.thinArea += region.area;
      report_.thinAreaShare += region.areaShare;
      for (const ThinPart* part : shownParts(found[i])) {
        thin.triangles.push_back(
            {unit_.toMesh(part->corners[0]), unit_.toMesh(part->corners[1]), unit_.toMesh(part->corners[2])});
        thin.regions.push_back(firstRegion + static_cast<uint32_t>(report_.regions.size()));
      }
      report_.regions.push_back(std::move(region));
    }
  }

  /// The parts that are thin at their middle, whose area is the area of the region. If there is none, the first part.
  static std::vector<const ThinPart*> shownParts(const ConnectedThinParts& region) {
    std::vector<const ThinPart*> shown;
    for (const ThinPart& part : region.parts)
      if (part.isThinAtMiddle) shown.push_back(&part);
    if (shown.empty()) shown.push_back(&region.parts.front());
    return shown;
  }

  [[nodiscard]] ThinRegion describeRegion(const ConnectedThinParts& found) const {
    ThinRegion region;
    region.kind = surface_.isSpace() && found.kind == ThinKind::Wall ? ThinKind::Gap : found.kind;
    region.min = thicknessOf(found.place);
    region.minFace = prepared_.mesh.inputFaceOf(found.place.face);
    region.place = placeInMesh(found.place.ball.ball.onFace, found.place.ball.ball.diameter);
    region.opposite = placeInMesh(found.place.ball.ball.onWall, found.place.ball.ball.diameter);
    const uint32_t wall = found.place.ball.wall, triangle = surface_.triangleOf(found.place.face);
    if (wall != kNoFace) region.oppositeFace = prepared_.mesh.inputFaceOf(wall);
    region.bodies = names_.of(triangle, wall == kNoFace ? triangle : surface_.triangleOf(wall));
    region.least = std::min(region.min, thicknessOf(found.leastPlace));
    region.angleDegrees = angleAt(found.leastPlace);
    std::set<uint64_t> inputFaces;
    for (const ThinPart& part : found.parts) inputFaces.insert(prepared_.mesh.inputFaceOf(part.face));
    region.faceCount = inputFaces.size();
    for (const ThinPart* part : shownParts(found)) region.area += areaOf(*part);
    if (found.perimeter > 0) region.width = 2 * region.area / unit_.toMeshLength(found.perimeter);
    return region;
  }

  /// Angle between the surfaces that the ball of a place touches.
  [[nodiscard]] double angleAt(const WallPlace& place) const {
    if (place.ball.wall == kNoFace) return 0;
    const double cosine = std::clamp(
        -dot(prepared_.geometry.normals[place.face], prepared_.geometry.normals[place.ball.wall]), -1.0, 1.0);
    return angleOf(std::sqrt((1 - cosine) * (1 + cosine)), cosine) * 180 / std::numbers::pi;
  }

  [[nodiscard]] double areaOf(const ThinPart& part) const {
    const auto& [a, b, c] = part.corners;
    return 0.5 * length(cross(b - a, c - a)) / unit_.scale / unit_.scale;
  }

  /// The least thickness of the regions that count, or the next wall.
  void describeLeast() {
    for (const ThinRegion& region : report_.regions)
      if (report_.counts(region.kind) && !(report_.min <= region.min))
        takeLeast(region.min, region.minFace, region.place, region.opposite);
    if (!std::isnan(report_.min) || !thickness_.nextWall) return;
    const WallPlace& next = *thickness_.nextWall;
    // A wall that tapers may be thinner than the limit at which it becomes a wall.
    const double limit = report_.thinnerThan.value_or(0), least = thicknessOf(next);
    takeLeast(least < kThinShare * limit ? std::max(unit_.toMeshLength(next.limit), limit) : least,
              prepared_.mesh.inputFaceOf(next.face), placeInMesh(next.ball.ball.onFace, next.ball.ball.diameter),
              placeInMesh(next.ball.ball.onWall, next.ball.ball.diameter));
  }

  void takeLeast(double least, uint64_t face, const Vec3d& place, const Vec3d& opposite) {
    report_.min = least;
    report_.minFace = face;
    report_.minPlace = place;
    report_.minOpposite = opposite;
  }

  /// The verdict if no place that counts was found, or if there is one.
  [[nodiscard]] ThicknessVerdict verdictIf(bool isFound) const {
    for (const UnjudgedReason& reason : report_.unjudged.reasons)
      if (concernsWholeMesh(reason.cause)) return ThicknessVerdict::NotJudged;
    if (isFound) return ThicknessVerdict::Failed;
    const bool hasValue =
        std::find(thickness_.isJudged.begin(), thickness_.isJudged.end(), 1) != thickness_.isJudged.end();
    return !hasValue || report_.unjudged.preventVerdict() ? ThicknessVerdict::NotJudged : ThicknessVerdict::Passed;
  }

  [[nodiscard]] ThicknessVerdict verdict() const {
    return verdictIf(std::any_of(report_.regions.begin(), report_.regions.end(),
                                 [&](const ThinRegion& region) { return report_.counts(region.kind); }));
  }

  [[nodiscard]] ThickReport describeThick(double limit) const {
    ThickReport thick{.thickerThan = limit};
    const double tooThick = limit / kThinShare;
    bool isDecided = true;
    std::vector<uint32_t> bodyOfSolid(thickness_.sections.size(), kNoFace), groupOf;
    for (uint32_t solid = 0; solid < thickness_.sections.size(); ++solid) {
      const GreatestSection& section = thickness_.sections[solid];
      if (!std::isfinite(section.diameter)) continue;
      const double diameter = unit_.toMeshLength(section.diameter);
      if (diameter > tooThick) {
        bodyOfSolid[solid] = static_cast<uint32_t>(thick.bodies.size());
        thick.bodies.push_back({{}, diameter, placeInMesh(section.centre, section.diameter)});
      } else if (unit_.toMeshLength(section.bound) > tooThick * (1 + kSectionTolerance)) {
        isDecided = false;
      }
    }
    for (const uint32_t solid : surface_.solids().solidOf) groupOf.push_back(bodyOfSolid[solid]);
    std::vector<std::vector<std::string>> names = names_.ofGroups(surface_, groupOf, thick.bodies.size());
    for (size_t i = 0; i < names.size(); ++i) thick.bodies[i].bodies = std::move(names[i]);
    std::stable_sort(thick.bodies.begin(), thick.bodies.end(),
                     [](const ThickBody& a, const ThickBody& b) { return a.diameter > b.diameter; });
    thick.verdict = verdictIf(!thick.bodies.empty());
    if (thick.verdict == ThicknessVerdict::Passed && !isDecided) thick.verdict = ThicknessVerdict::NotJudged;
    if (report_.greatestSection && report_.min > 0) thick.ratio = report_.greatestSection->diameter / report_.min;
    return thick;
  }

  const Computation& computation_;
  const JudgedSurface& surface_;
  const FaceThickness& thickness_;
  const BodyNames& names_;
  const PreparedMesh& prepared_;
  const Normalization& unit_;
  ThicknessReport report_;
};

}  // namespace

double computedArea(const Computation& computation) {
  const PreparedMesh& prepared = computation.prepared;
  double total = 0;
  for (uint32_t face = 0; face < prepared.mesh.faceCount(); ++face)
    if (computation.region.contains(prepared.mesh.inputFaceOf(face))) total += prepared.geometry.areas[face];
  return total;
}

ThicknessReport describeThickness(const Computation& computation, const JudgedSurface& surface,
                                  const FaceThickness& thickness, const BodyNames& names, uint32_t firstRegion,
                                  ThinSurface& thin) {
  return Description(computation, surface, thickness, names).run(firstRegion, thin);
}

}  // namespace asdfvk
