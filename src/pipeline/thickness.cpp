#include "pipeline/thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/winding.h"
#include "trace/solids.h"

namespace asdfvk {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// Number of faces whose balls are shrunk at a time. They need 9 MiB.
constexpr size_t kBlockFaceCount = size_t{1} << 16;
// Progress after the greatest sections, and after the balls of all faces.
constexpr double kSectionsProgress = 0.2, kBallsProgress = 0.9;
// Large thin faces are divided into parts whose sides are at most as long as the larger of limit / kPartsPerLimit and
// kMinPartLength (normalised).
constexpr double kPartsPerLimit = 4, kMinPartLength = 0x1p-10;

class Measurement {
 public:
  Measurement(const Computation& computation, const JudgedSurface& surface)
      : computation_(computation),
        surface_(surface),
        scene_(computation.scene),
        mesh_(computation.prepared.mesh),
        unit_(scene_.bvh.normalization),
        opposing_(makeOpposingWalls(computation.options.thickness)),
        solids_(surface.solids()),
        fans_(mesh_) {
    // Coordinates in float32 do not resolve whether a wall is thinner than the limit by less than kContactDistance.
    if (const std::optional<double>& limit = computation.options.thickness.thinnerThan)
      limit_ = std::max(*limit * unit_.scale - kContactDistance, kContactDistance);
  }

  FaceThickness run(const RunControl& control) {
    const size_t count = mesh_.faceCount();
    thickness_ = {std::vector<double>(count, kNoValue),
                  std::vector<double>(count, kNoValue),
                  std::vector<uint32_t>(count, kNoFace),
                  std::vector<uint8_t>(count),
                  {},
                  {},
                  {},
                  {}};
    control.checkpoint(0);
    findDoubleSided();
    findSharp();
    const std::vector<GreatestSection> sections =
        findGreatestSections(scene_, solids_.solidOf, solids_.isClosed, control.part(0, kSectionsProgress));
    keepGreatest(sections);
    const WallTree tree(scene_, opposing_, &solids_, control.withoutProgress());
    const std::vector<FaceBalls> thin = measureFaces(tree, sections, control.part(kSectionsProgress, kBallsProgress));
    countUnjudged();
    if (limit_)
      thickness_.thinParts =
          findThinParts(tree, fans_, thickness_.sharp, thin, *limit_,
                        std::max(*limit_ / kPartsPerLimit, kMinPartLength), control.withoutProgress());
    takeSheets();
    control.checkpoint(1);
    return std::move(thickness_);
  }

 private:
  [[nodiscard]] bool isInDomain(uint32_t face) const { return computation_.domain.contains(mesh_.inputFaceOf(face)); }

  [[nodiscard]] const Component& componentOf(uint32_t face) const {
    const Components& components = computation_.prepared.components;
    return components.components[components.componentOf[face]];
  }

  [[nodiscard]] bool isWoundAgainst(uint32_t face) const {
    return componentOf(face).isClosed && !componentOf(face).isConsistentlyWound;
  }
  [[nodiscard]] bool isInverted(uint32_t face) const { return surface_.kindOf(face) == FaceKind::Inverted; }
  [[nodiscard]] bool isSheet(uint32_t face) const { return surface_.kindOf(face) == FaceKind::NoThickness; }
  [[nodiscard]] bool isDoubleSided(uint32_t face) const {
    return isDoubleSided_[computation_.prepared.components.componentOf[face]] != 0;
  }

  /// Marks the components that have a volume, but no material: each of their faces has a reversed copy.
  void findDoubleSided() {
    const Components& components = computation_.prepared.components;
    std::vector<double> areas(components.components.size(), 0);
    isDoubleSided_.assign(areas.size(), 1);
    for (uint32_t face = 0; face < mesh_.faceCount(); ++face) {
      areas[components.componentOf[face]] += computation_.prepared.geometry.areas[face];
      if (!isSheet(face) && !computation_.prepared.geometry.isDegenerate(face))
        isDoubleSided_[components.componentOf[face]] = 0;
    }
    for (size_t i = 0; i < areas.size(); ++i)
      if (std::abs(components.components[i].signedVolume) <= unit_.contactLength() * areas[i]) isDoubleSided_[i] = 0;
  }

  void findSharp() {
    SharpEdges& sharp = thickness_.sharp;
    sharp =
        findSharpEdges(mesh_, computation_.prepared.geometry, fans_, opposing_.cosine, unit_.contactLength(), &solids_);
    std::erase_if(sharp.lines, [&](const SharpLine& line) { return !isInDomain(line.face); });
    for (uint32_t face = 0; face < mesh_.faceCount(); ++face)
      if (!isInDomain(face)) sharp.faceBits[face] = 0;
  }

  void keepGreatest(std::span<const GreatestSection> sections) {
    std::optional<GreatestSection>& greatest = thickness_.greatestSection;
    for (const GreatestSection& section : sections)
      if (section.diameter < kUnlimited && !(greatest && section.diameter <= greatest->diameter)) greatest = section;
    if (greatest)
      greatest = {greatest->centre / unit_.scale + unit_.centre, unit_.toMeshLength(greatest->diameter),
                  unit_.toMeshLength(greatest->bound)};
  }

  /// Returns the balls of the faces that have a point below the limit.
  std::vector<FaceBalls> measureFaces(const WallTree& tree, std::span<const GreatestSection> sections,
                                      const RunControl& control) {
    std::vector<uint32_t> faces;
    faces.reserve(computation_.domain.traceableFaces.size());
    for (const Wall& wall : tree.walls())
      if (isInDomain(wall.face)) faces.push_back(wall.face);
    std::vector<FaceBalls> thin;
    for (size_t begin = 0; begin < faces.size(); begin += kBlockFaceCount) {
      const size_t end = std::min(faces.size(), begin + kBlockFaceCount);
      std::vector<FaceBalls> balls(end - begin);
      for (size_t i = begin; i < end; ++i) {
        balls[i - begin].face = faces[i];
        const double bound = sections[solids_.solidOf[faces[i]]].bound;
        balls[i - begin].atBarycentre.ball.diameter = balls[i - begin].least.ball.diameter = bound;
      }
      const auto share = [&](size_t count) { return static_cast<double>(count) / static_cast<double>(faces.size()); };
      shrinkFaceBalls(tree, balls, control.part(share(begin), share(end)));
      for (FaceBalls& each : balls) {
        const double greatest = sections[solids_.solidOf[each.face]].diameter;
        const double least = take(each, greatest);
        const bool isJudged =
            !std::isnan(least) && !isWoundAgainst(each.face) && !isInverted(each.face) && !isDoubleSided(each.face);
        thickness_.isJudged[each.face] = isJudged ? 1 : 0;
        const double surelyBelow =
            each.least.wall == kNoFace && least > 0 ? sections[solids_.solidOf[each.face]].bound : least * unit_.scale;
        if (!isJudged || !limit_ || surelyBelow >= *limit_) continue;
        if (isSheet(each.face))
          addSheet(each.face);
        else
          thin.push_back(each);
      }
    }
    return thin;
  }

  /// The sheets of one component are a region.
  void addSheet(uint32_t face) {
    ThinPart part{.face = face, .corners = triangleOf(scene_, face).corners, .isThinAtMiddle = true};
    part.least.ball.diameter = 0;
    part.region = computation_.prepared.components.componentOf[face];
    sheets_.push_back(part);
  }

  /// Adds the sheets after the other regions.
  void takeSheets() {
    uint32_t regionCount = 0;
    for (const ThinPart& part : thickness_.thinParts) regionCount = std::max(regionCount, part.region + 1);
    std::map<uint32_t, uint32_t> regions;
    for (ThinPart& part : sheets_) {
      part.region = regions.try_emplace(part.region, regionCount + static_cast<uint32_t>(regions.size())).first->second;
      thickness_.thinParts.push_back(part);
    }
  }

  /// Stores the values of a face and returns its least thickness.
  double take(FaceBalls& balls, double greatest) {
    if (isDoubleSided(balls.face)) return kNoValue;
    if (isSheet(balls.face)) return thickness_.atBarycentre[balls.face] = thickness_.least[balls.face] = 0;
    const auto lengthOf = [&](InscribedBall& ball) {
      if (ball.wall == kNoFace) ball.ball.diameter = greatest;
      return ball.ball.diameter < kUnlimited ? unit_.toMeshLength(ball.ball.diameter) : kNoValue;
    };
    const uint32_t face = balls.face;
    thickness_.atBarycentre[face] = lengthOf(balls.atBarycentre);
    thickness_.least[face] = lengthOf(balls.least);
    thickness_.leastWalls[face] = balls.least.wall;
    if (thickness_.sharp.faceBits[face] != 0) thickness_.least[face] = 0;
    return thickness_.least[face];
  }

  /// Counts the input faces of the domain that have a triangle for which holds(triangle) is true.
  template <typename Holds>
  [[nodiscard]] uint64_t countInputFaces(const Holds& holds) const {
    uint64_t count = 0, last = mesh_.inputFaceCount();
    for (uint32_t face = 0; face < mesh_.faceCount(); ++face) {
      const uint64_t inputFace = mesh_.inputFaceOf(face);
      if (inputFace == last || !computation_.domain.contains(inputFace) || !holds(face)) continue;
      last = inputFace;
      ++count;
    }
    return count;
  }

  void countUnjudged() {
    UnjudgedFaces& unjudged = thickness_.unjudged;
    const FaceGeometry& geometry = computation_.prepared.geometry;
    unjudged.degenerateCount = countInputFaces([&](uint32_t face) { return geometry.isDegenerate(face); });
    unjudged.invertedCount = countInputFaces([&](uint32_t face) { return isWoundAgainst(face) || isInverted(face); });
    unjudged.openCount = countInputFaces([&](uint32_t face) { return isOpen(face); });
    unjudged.crossedCount = surface_.crossedCount();
    unjudged.insideCount = surface_.insideCount();
    addReasons();
  }

  [[nodiscard]] bool isOpen(uint32_t face) const {
    return !computation_.prepared.geometry.isDegenerate(face) && !componentOf(face).isClosed;
  }

  void addReasons() {
    addReason(UnjudgedCause::Border, [&](uint32_t face) { return isOpen(face) && !componentOf(face).isBranching; });
    addReason(UnjudgedCause::Branching, [&](uint32_t face) { return isOpen(face) && componentOf(face).isBranching; });
    addReason(UnjudgedCause::WoundAgainst, [&](uint32_t face) { return isWoundAgainst(face); });
    addReason(UnjudgedCause::Inverted, [&](uint32_t face) { return isInverted(face); });
    addReason(UnjudgedCause::DoubleSided, [&](uint32_t face) { return isDoubleSided(face); });
  }

  /// Adds the cause with the first face of the domain for which holds(face) is true, if there is one.
  template <typename Holds>
  void addReason(UnjudgedCause cause, const Holds& holds) {
    UnjudgedReason reason{.cause = cause, .faceCount = countInputFaces(holds)};
    if (reason.faceCount == 0) return;
    uint32_t first = 0;
    while (!isInDomain(first) || !holds(first)) ++first;
    reason.face = mesh_.inputFaceOf(first);
    reason.place = computation_.prepared.geometry.barycentres[first];
    const PreparedMesh& prepared = computation_.prepared;
    const EdgeKind kind = cause == UnjudgedCause::Border         ? EdgeKind::Boundary
                          : cause == UnjudgedCause::Branching    ? EdgeKind::Branching
                          : cause == UnjudgedCause::WoundAgainst ? EdgeKind::Inconsistent
                                                                 : EdgeKind::Regular;
    if (const EdgesOfKind& edges = prepared.openEdges[static_cast<size_t>(kind)]; edges.count > 0) {
      reason.edgeCount = edges.count;
      reason.face = mesh_.inputFaceOf(edges.firstCorner / 3);
      reason.place = edges.place;
    }
    reason.isRepairable = cause == UnjudgedCause::Inverted || (cause == UnjudgedCause::WoundAgainst &&
                                                               canBeTurned(surface_.original().prepared.mesh, unit_));
    thickness_.unjudged.reasons.push_back(reason);
  }

  const Computation& computation_;
  const JudgedSurface& surface_;
  const TraceScene& scene_;
  const TriangleMesh& mesh_;
  const Normalization& unit_;
  OpposingWalls opposing_;
  const Solids& solids_;
  PointFans fans_;
  std::optional<double> limit_;         ///< Normalised.
  std::vector<uint8_t> isDoubleSided_;  ///< #components
  std::vector<ThinPart> sheets_;        ///< Faces without a thickness.
  FaceThickness thickness_;
};

}  // namespace

FaceThickness measureThickness(const Computation& computation, const JudgedSurface& surface,
                               const RunControl& control) {
  return Measurement(computation, surface).run(control);
}

std::vector<double> thicknessOfInputFaces(const TriangleMesh& mesh, std::span<const double> values) {
  if (mesh.polygons.isEmpty()) return {values.begin(), values.end()};
  std::vector<double> least(mesh.inputFaceCount(), kNoValue);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    double& value = least[mesh.inputFaceOf(face)];
    if (!(value <= values[face]) && !std::isnan(values[face])) value = values[face];
  }
  return least;
}

}  // namespace asdfvk
