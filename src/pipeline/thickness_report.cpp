#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

#include "core/check.h"
#include "core/weighted_sample.h"
#include "pipeline/thickness.h"
#include "pipeline/value_report.h"
#include "trace/wall_rule.h"

namespace asdfvk {
namespace {

/// In contact lengths.
constexpr double kPlaceResolution = 64;

class Description {
 public:
  Description(const Computation& computation, const FaceThickness& thickness)
      : computation_(computation),
        thickness_(thickness),
        prepared_(computation.prepared),
        unit_(computation.scene.bvh.normalization) {}

  ThicknessReport run(ThinSurface& surface) {
    const ThicknessOptions& options = computation_.options.thickness;
    describePercentiles();
    report_.noValueCount =
        countWithoutValue(computation_.domain, thicknessOfInputFaces(prepared_.mesh, thickness_.least));
    if (thickness_.greatestSection)
      report_.greatestSection = {thickness_.greatestSection->diameter, thickness_.greatestSection->centre};
    report_.unjudged = thickness_.unjudged;
    report_.thinnerThan = options.thinnerThan;
    report_.countsDetails = options.countsDetails;
    report_.countsEdges = options.countsEdges;
    if (report_.thinnerThan) describeRegions(surface);
    describeLeast();
    if (!report_.thinnerThan) return std::move(report_);
    report_.verdict = verdict();
    ASDFVK_CHECK(report_.verdict != ThicknessVerdict::Passed || !(report_.min < kThinShare * *report_.thinnerThan));
    return std::move(report_);
  }

 private:
  [[nodiscard]] Vec3d toMesh(const Vec3d& p) const { return p / unit_.scale + unit_.centre; }
  /// A place, with 0 for coordinates that are 0 up to the size of the smallest balls.
  [[nodiscard]] Vec3d placeInMesh(const Vec3d& p) const {
    Vec3d place = toMesh(p);
    for (size_t axis = 0; axis < 3; ++axis)
      if (std::abs(place[axis]) < kPlaceResolution * unit_.contactLength()) place[axis] = 0;
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

  void describeRegions(ThinSurface& surface) {
    const std::span<const ConnectedThinParts> found = thickness_.regions;
    std::vector<ThinRegion> regions;
    for (const ConnectedThinParts& region : found) regions.push_back(describeRegion(region));
    std::vector<uint32_t> order(regions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      const auto rank = [&](uint32_t i) { return std::tuple(regions[i].kind, regions[i].min, -regions[i].area); };
      return rank(a) < rank(b);
    });
    const double total = totalArea();
    report_.thinArea = report_.thinAreaShare = 0;
    for (const uint32_t i : order) {
      ThinRegion& region = regions[i];
      region.areaShare = total > 0 ? region.area / total : 0;
      report_.thinArea += region.area;
      report_.thinAreaShare += region.areaShare;
      for (const ThinPart* part : shownParts(found[i])) {
        surface.triangles.push_back({toMesh(part->corners[0]), toMesh(part->corners[1]), toMesh(part->corners[2])});
        surface.regions.push_back(static_cast<uint32_t>(report_.regions.size()));
      }
      report_.regions.push_back(region);
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
    region.kind = found.kind;
    region.min = thicknessOf(found.place);
    region.minFace = prepared_.mesh.inputFaceOf(found.place.face);
    region.place = placeInMesh(found.place.ball.ball.onFace);
    region.opposite = placeInMesh(found.place.ball.ball.onWall);
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
    const double cosine = -dot(prepared_.geometry.normals[place.face], prepared_.geometry.normals[place.ball.wall]);
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  }

  [[nodiscard]] double areaOf(const ThinPart& part) const {
    const auto& [a, b, c] = part.corners;
    return 0.5 * length(cross(b - a, c - a)) / unit_.scale / unit_.scale;
  }

  /// Area of the faces of the domain.
  [[nodiscard]] double totalArea() const {
    double total = 0;
    for (uint32_t face = 0; face < prepared_.mesh.faceCount(); ++face)
      if (computation_.domain.contains(prepared_.mesh.inputFaceOf(face))) total += prepared_.geometry.areas[face];
    return total;
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
              prepared_.mesh.inputFaceOf(next.face), placeInMesh(next.ball.ball.onFace),
              placeInMesh(next.ball.ball.onWall));
  }

  void takeLeast(double least, uint64_t face, const Vec3d& place, const Vec3d& opposite) {
    report_.min = least;
    report_.minFace = face;
    report_.minPlace = place;
    report_.minOpposite = opposite;
  }

  [[nodiscard]] ThicknessVerdict verdict() const {
    for (const UnjudgedReason& reason : report_.unjudged.reasons)
      if (concernsWholeMesh(reason.cause)) return ThicknessVerdict::NotJudged;
    for (const ThinRegion& region : report_.regions)
      if (report_.counts(region.kind)) return ThicknessVerdict::Failed;
    const bool hasValue =
        std::find(thickness_.isJudged.begin(), thickness_.isJudged.end(), 1) != thickness_.isJudged.end();
    return !hasValue || report_.unjudged.preventVerdict() ? ThicknessVerdict::NotJudged : ThicknessVerdict::Passed;
  }

  const Computation& computation_;
  const FaceThickness& thickness_;
  const PreparedMesh& prepared_;
  const Normalization& unit_;
  ThicknessReport report_;
};

}  // namespace

ThicknessReport describeThickness(const Computation& computation, const FaceThickness& thickness,
                                  ThinSurface& surface) {
  return Description(computation, thickness).run(surface);
}

}  // namespace asdfvk
