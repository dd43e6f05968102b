#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "core/disjoint_sets.h"
#include "core/weighted_sample.h"
#include "pipeline/thickness.h"
#include "pipeline/value_report.h"
#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

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
    describeSharpEdges();
    report_.unjudged = thickness_.unjudged;
    report_.thinnerThan = options.thinnerThan;
    report_.allowsSharpEdges = options.allowsSharpEdges;
    if (report_.thinnerThan) describeRegions(surface);
    describeLeast();
    if (report_.thinnerThan) report_.verdict = verdict();
    return std::move(report_);
  }

 private:
  /// The points at which the least thickness of a face is measured, in the unit of the mesh.
  struct Place {
    Vec3d onFace, onWall;
  };

  [[nodiscard]] Vec3d toMesh(const Vec3d& p) const { return p / unit_.scale + unit_.centre; }

  /// Upper bound of a least thickness. The greatest section is known only up to its tolerance; by this bound, a wall of
  /// the same thickness comes first.
  static double surelyBelow(double least, uint32_t wall) {
    return wall == kNoFace ? least * (1 + kSectionTolerance) : least;
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

  void describeSharpEdges() {
    for (const SharpLine& line : thickness_.sharp.lines)
      report_.sharpEdges.push_back({std::acos(std::clamp(line.cosine, -1.0, 1.0)) * 180 / std::numbers::pi, line.length,
                                    line.edgeCount, line.place, prepared_.mesh.inputFaceOf(line.face)});
  }

  /// Where the least ball of a face, or of a part of it, touches the face and the wall.
  [[nodiscard]] Place placeOf(uint32_t face, const std::array<Vec3d, 3>& corners, uint32_t wall) const {
    const Vec3d& normal = prepared_.geometry.normals[face];
    if (wall != kNoFace) {
      const TouchingBall ball =
          leastTouchingBall({corners, normal}, triangleOf(computation_.scene, wall), kContactDistance);
      return {toMesh(ball.onFace), toMesh(ball.onWall)};
    }
    const Vec3d middle = toMesh((corners[0] + corners[1] + corners[2]) / 3.0);
    return {middle, middle - thickness_.least[face] * normal};
  }

  /// A point of the sharp edge of a face, or its sharp corner.
  [[nodiscard]] Vec3d sharpPlaceOf(uint32_t face) const {
    const auto corner = [&](size_t k) { return prepared_.mesh.vertices[prepared_.mesh.faces[face][k % 3]]; };
    for (size_t k = 0; k < 3; ++k)
      if (thickness_.sharp.hasEdge(face, k)) return 0.5 * (corner(k) + corner(k + 1));
    for (size_t k = 0; k < 3; ++k)
      if (thickness_.sharp.hasCorner(face, k)) return corner(k);
    return prepared_.geometry.barycentres[face];
  }

  void describeRegions(ThinSurface& surface) {
    const std::span<const ThinPart> parts = thickness_.thinParts;
    std::vector<std::vector<uint32_t>> partsOf;
    for (uint32_t i = 0; i < parts.size(); ++i) {
      if (parts[i].region >= partsOf.size()) partsOf.resize(parts[i].region + 1);
      partsOf[parts[i].region].push_back(i);
    }
    joinSides(partsOf);
    std::vector<ThinRegion> regions;
    for (std::vector<uint32_t>& ofRegion : partsOf) regions.push_back(describeRegion(ofRegion));
    std::vector<uint32_t> order(regions.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      const ThinRegion &first = regions[a], &second = regions[b];
      if (first.isSharp != second.isSharp) return !first.isSharp;
      return first.isSharp || first.min == second.min ? first.area > second.area : first.min < second.min;
    });
    const double total = totalArea();
    report_.thinArea = report_.thinAreaShare = 0;
    for (const uint32_t region : order) {
      ThinRegion& described = regions[region];
      described.areaShare = total > 0 ? described.area / total : 0;
      report_.thinArea += described.area;
      report_.thinAreaShare += described.areaShare;
      for (const uint32_t i : partsOf[region]) {
        const std::array<Vec3d, 3>& corners = parts[i].corners;
        surface.triangles.push_back({toMesh(corners[0]), toMesh(corners[1]), toMesh(corners[2])});
        surface.regions.push_back(static_cast<uint32_t>(report_.regions.size()));
      }
      report_.regions.push_back(described);
    }
  }

  [[nodiscard]] bool isSharp(std::span<const uint32_t> ofRegion) const {
    return std::any_of(ofRegion.begin(), ofRegion.end(), [&](uint32_t i) { return thickness_.thinParts[i].isSharp; });
  }

  /// The part with the least ball. Sharp parts come first.
  [[nodiscard]] uint32_t thinnestOf(std::span<const uint32_t> ofRegion) const {
    const auto rank = [&](uint32_t i) {
      const ThinPart& part = thickness_.thinParts[i];
      return std::pair(part.isSharp ? 0.0 : surelyBelow(part.least.ball.diameter, part.least.wall), i);
    };
    return *std::min_element(ofRegion.begin(), ofRegion.end(),
                             [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
  }

  /// The region of the place on the wall that the least ball of a part touches; unset if this place is not thin.
  [[nodiscard]] std::optional<uint32_t> regionOpposite(const ThinPart& part) const {
    const std::vector<ThinPart>& parts = thickness_.thinParts;
    if (part.least.wall == kNoFace) return std::nullopt;
    const Vec3d touched = leastTouchingBall({part.corners, prepared_.geometry.normals[part.face]},
                                            triangleOf(computation_.scene, part.least.wall), kContactDistance)
                              .onWall;
    auto i = std::lower_bound(parts.begin(), parts.end(), part.least.wall,
                              [](const ThinPart& other, uint32_t face) { return other.face < face; });
    for (; i != parts.end() && i->face == part.least.wall; ++i)
      if (length(nearestPoint({i->corners, {}}, touched) - touched) <= kContactDistance) return i->region;
    return std::nullopt;
  }

  /// Joins the two sides of a wall into one region if the least ball of one side touches the other side. Sharp regions
  /// are not joined, because the verdict may leave them out.
  void joinSides(std::vector<std::vector<uint32_t>>& partsOf) const {
    DisjointSets regions(partsOf.size());
    for (const std::vector<uint32_t>& ofRegion : partsOf) {
      if (isSharp(ofRegion)) continue;
      const ThinPart& thinnest = thickness_.thinParts[thinnestOf(ofRegion)];
      const std::optional<uint32_t> opposite = regionOpposite(thinnest);
      if (opposite && !isSharp(partsOf[*opposite])) regions.join(thinnest.region, *opposite);
    }
    for (uint32_t region = 0; region < partsOf.size(); ++region) {
      std::vector<uint32_t>&from = partsOf[region], &to = partsOf[regions.lowestOf(region)];
      if (&from == &to) continue;
      to.insert(to.end(), from.begin(), from.end());
      from.clear();
    }
    std::erase_if(partsOf, [](const std::vector<uint32_t>& ofRegion) { return ofRegion.empty(); });
  }

  /// Reduces `ofRegion` to the parts that are thin at their middle, whose area is the area of the region. If there is
  /// no such part, the part with the least thickness remains.
  [[nodiscard]] ThinRegion describeRegion(std::vector<uint32_t>& ofRegion) const {
    const std::span<const ThinPart> parts = thickness_.thinParts;
    ThinRegion region;
    std::set<uint64_t> inputFaces;
    for (const uint32_t i : ofRegion) inputFaces.insert(prepared_.mesh.inputFaceOf(parts[i].face));
    region.isSharp = isSharp(ofRegion);
    region.faceCount = inputFaces.size();
    const uint32_t thinnest = thinnestOf(ofRegion);
    const ThinPart& part = parts[thinnest];
    region.minFace = prepared_.mesh.inputFaceOf(part.face);
    if (region.isSharp) {
      region.place = region.opposite = sharpPlaceOf(part.face);
    } else {
      region.min = unit_.toMeshLength(part.least.ball.diameter);
      const Place place = placeOf(part.face, part.corners, part.least.wall);
      region.place = place.onFace;
      region.opposite = place.onWall;
    }
    std::erase_if(ofRegion, [&](uint32_t i) { return !parts[i].isThinAtMiddle; });
    if (ofRegion.empty()) ofRegion.push_back(thinnest);
    for (const uint32_t i : ofRegion) region.area += areaOf(parts[i]);
    return region;
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

  /// The least thickness: of the first region that counts, or of all faces without a part in a sharp region that does
  /// not count.
  void describeLeast() {
    for (const ThinRegion& region : report_.regions) {
      if (region.isSharp && report_.allowsSharpEdges) continue;
      if (region.min < report_.min || std::isnan(report_.min))
        takeLeast(region.min, region.minFace, region.place, region.opposite);
    }
    if (!std::isnan(report_.min)) return;
    std::vector<uint8_t> isLeftOut(thickness_.least.size());
    for (const ThinPart& part : thickness_.thinParts) isLeftOut[part.face] = 1;
    std::optional<uint32_t> thinnest;
    const auto rank = [&](uint32_t face) { return surelyBelow(thickness_.least[face], thickness_.leastWalls[face]); };
    for (uint32_t face = 0; face < thickness_.least.size(); ++face)
      if (thickness_.isJudged[face] != 0 && isLeftOut[face] == 0 && !(thinnest && rank(*thinnest) <= rank(face)))
        thinnest = face;
    if (!thinnest) return;
    const double least = thickness_.least[*thinnest];
    Place place =
        placeOf(*thinnest, triangleOf(computation_.scene, *thinnest).corners, thickness_.leastWalls[*thinnest]);
    if (least == 0) place.onFace = place.onWall = sharpPlaceOf(*thinnest);
    takeLeast(least, prepared_.mesh.inputFaceOf(*thinnest), place.onFace, place.onWall);
  }

  void takeLeast(double least, uint64_t face, const Vec3d& place, const Vec3d& opposite) {
    report_.min = least;
    report_.minFace = face;
    report_.minPlace = place;
    report_.minOpposite = opposite;
  }

  [[nodiscard]] ThicknessVerdict verdict() const {
    for (const ThinRegion& region : report_.regions)
      if (!region.isSharp || !report_.allowsSharpEdges) return ThicknessVerdict::Failed;
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
