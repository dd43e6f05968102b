#include "pipeline/thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "pipeline/judgement.h"
#include "trace/nearest_point.h"
#include "trace/next_wall.h"
#include "trace/solids.h"
#include "trace/wall_rule.h"

namespace asdfvk {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// Number of faces whose balls are shrunk at a time. They need 9 MiB.
constexpr size_t kBlockFaceCount = size_t{1} << 16;
// Progress after the balls of all faces, and after the greatest sections.
constexpr double kBallsProgress = 0.6, kSectionsProgress = 0.8;
constexpr double kLeastLimit = 2 * kUnresolved;
/// Without a limit, walls are looked for at limits from this number on (normalised).
constexpr double kLeastWallLimit = 0x1p-8;
/// A body is the next wall as a whole if its greatest section is known to this factor.
constexpr double kSectionAccuracy = 1.05;
/// Gaps wider than this factor times the limit, or without a limit than the greatest gap (normalised), have no value:
/// nothing else would limit the search, and on convex surfaces each ball would meet most faces.
constexpr double kGapsPerLimit = 4, kGreatestGap = 1;
/// Limits of the next wall of a surface that bounds no body are at most this number (normalised).
constexpr double kLargestLimit = 2;

class Measurement {
 public:
  Measurement(const Computation& computation, const JudgedSurface& surface, bool isOfThinPlaces)
      : computation_(computation),
        surface_(surface),
        judgement_(computation, surface),
        scene_(computation.scene),
        mesh_(computation.prepared.mesh),
        unit_(scene_.bvh.normalization),
        opposing_(makeOpposingWalls(computation.options.thickness)),
        solids_(surface.solids()),
        isSpace_(surface.isSpace()),
        isOfThinPlaces_(isOfThinPlaces),
        fans_(mesh_) {
    if (const std::optional<double> limit = surface.limitIn(computation.options.thickness))
      limit_ = std::max(*limit * unit_.scale, kLeastLimit);
    if (isSpace_) greatest_ = limit_ ? kGapsPerLimit * *limit_ : kGreatestGap;
    if (isOfThinPlaces_) greatest_ = kCornerRange * limit_.value();
  }

  FaceThickness run(const RunControl& control) {
    const size_t count = mesh_.faceCount();
    thickness_.atBarycentre.assign(count, kNoValue);
    thickness_.least.assign(count, kNoValue);
    thickness_.isJudged.assign(count, 0);
    walls_.resize(count);
    control.checkpoint(0);
    std::vector<GreatestSection> sections =
        findGreatestSections(scene_, solids_.solidOf, solids_.isClosed, kFirstSection, control.withoutProgress());
    const WallTree tree(scene_, opposing_, &solids_, control.withoutProgress());
    const std::vector<FaceBalls> thin = measureFaces(tree, sections, control.part(0, kBallsProgress));
    if (!isOfThinPlaces_) searchCaps(sections, control.part(kBallsProgress, kSectionsProgress));
    keepGreatest(sections);
    finishValues(sections);
    thickness_.caps = sections;
    thickness_.unjudged = judgement_.unjudged();
    if (limit_) {
      ThinPieces pieces(tree, fans_, thin, kThinShare * *limit_);
      pieces.divide(std::max(*limit_ / kPiecesPerLimit, kMinPieceLength), control.withoutProgress());
      thickness_.regions = findThinRegions(pieces, *limit_, bodiesOfFaces(), control.withoutProgress());
      if (isSpace_) removeContacts();
      addThinBodies(sections, control.withoutProgress());
    }
    const auto isWall = [](const ConnectedThinParts& region) { return region.kind == ThinKind::Wall; };
    if (!isOfThinPlaces_ && !thickness_.unjudged.preventVerdict() &&
        std::none_of(thickness_.regions.begin(), thickness_.regions.end(), isWall))
      keepNextWall(tree, sections, control.withoutProgress());
    if (const auto& limit = computation_.options.thickness.thickerThan; limit && !isSpace_)
      findThickBodies(limit->value * unit_.scale / kThinShare, sections, control.withoutProgress());
    control.checkpoint(1);
    return std::move(thickness_);
  }

 private:
  /// The walls that limit the balls of a face. kNoFace: no wall limits the ball.
  struct FaceWalls {
    uint32_t atBarycentre = kNoFace, least = kNoFace;
  };

  /// The bodies of the faces of a space; empty for a material, whose walls are all of one body.
  [[nodiscard]] std::vector<uint32_t> bodiesOfFaces() const {
    std::vector<uint32_t> bodies(isSpace_ ? mesh_.faceCount() : 0);
    for (uint32_t face = 0; face < bodies.size(); ++face) bodies[face] = surface_.bodyOf(surface_.triangleOf(face));
    return bodies;
  }

  [[nodiscard]] bool isComputed(uint32_t face) const { return computation_.region.contains(mesh_.inputFaceOf(face)); }

  /// For each solid: whether it has a computed face for which holds(face) is true.
  template <typename Holds>
  [[nodiscard]] std::vector<uint8_t> computedSolids(const Holds& holds) const {
    std::vector<uint8_t> hasFace(solids_.isClosed.size());
    for (uint32_t face = 0; face < mesh_.faceCount(); ++face)
      if (isComputed(face) && holds(face)) hasFace[solids_.solidOf[face]] = 1;
    return hasFace;
  }

  /// Removes gaps that float32 does not tell from contact.
  void removeContacts() {
    std::erase_if(thickness_.regions, [](const ConnectedThinParts& region) {
      return region.kind == ThinKind::Wall && region.place.ball.ball.diameter <= kUnresolved;
    });
  }

  /// A body whose greatest section is below the limit is a wall as a whole, and so is a body of sheets.
  void addThinBodies(std::vector<GreatestSection>& sections, const RunControl& control) {
    for (ConnectedThinParts& region : thickness_.regions)
      if (judgement_.isInSheet(region.place.face)) region.kind = ThinKind::Wall;
    decideSections(sections, control);
    std::map<uint32_t, ConnectedThinParts> bodies;
    for (uint32_t face = 0; face < mesh_.faceCount(); ++face)
      if (const uint32_t solid = solids_.solidOf[face]; thickness_.isJudged[face] != 0 && isThinBody(sections[solid]))
        bodies[solid].parts.push_back({face, triangleOf(scene_, face).corners, true});
    for (auto& [solid, region] : bodies) {
      region.kind = ThinKind::Wall;
      region.place = region.leastPlace = placeOf(sections[solid]);
    }
    std::erase_if(thickness_.regions, [&](const ConnectedThinParts& region) {
      const auto body = bodies.find(solids_.solidOf[region.place.face]);
      if (body == bodies.end()) return false;
      const auto diameterOf = [](const WallPlace& place) { return place.ball.ball.diameter; };
      if (region.kind == ThinKind::Wall &&
          diameterOf(region.place) <= (1 + kSectionTolerance) * diameterOf(body->second.place))
        body->second.place = region.place;
      return true;
    });
    for (auto& [solid, region] : bodies) thickness_.regions.push_back(std::move(region));
  }

  /// Searches the greatest sections of bodies without a wall as far as the limit needs.
  void decideSections(std::vector<GreatestSection>& sections, const RunControl& control) {
    std::vector<uint8_t> isUndecided(sections.size());
    for (size_t solid = 0; solid < sections.size(); ++solid)
      isUndecided[solid] = solids_.isClosed[solid] != 0 && sections[solid].diameter < kThinShare * *limit_ &&
                                   !isThinBody(sections[solid])
                               ? 1
                               : 0;
    for (const ConnectedThinParts& region : thickness_.regions)
      if (region.kind == ThinKind::Wall) isUndecided[solids_.solidOf[region.place.face]] = 0;
    searchAgain(sections, isUndecided, {.enough = kThinShare * *limit_}, control);
  }

  void searchAgain(std::vector<GreatestSection>& sections, std::span<const uint8_t> isWanted,
                   const SectionSearch& search, const RunControl& control) const {
    searchInexactSections(scene_, solids_.solidOf, isWanted, search, control, sections);
  }

  [[nodiscard]] bool isThinBody(const GreatestSection& section) const {
    return limit_ && section.bound < kThinShare * *limit_;
  }

  /// The place of a body that is a wall as a whole: the point of the surface nearest to the centre of the greatest
  /// ball.
  [[nodiscard]] WallPlace placeOf(const GreatestSection& section) const {
    const SurfacePoint foot = nearestSurfacePoint(scene_, section.centre, 0, [](uint32_t face) { return face; });
    return {foot.face, {{section.diameter, foot.point, 2.0 * section.centre - foot.point}, kNoFace}, 0};
  }

  void keepNextWall(const WallTree& tree, std::span<const GreatestSection> sections, const RunControl& control) {
    const GreatestSection* thinnest = nullptr;
    std::vector<double> least(mesh_.faceCount(), kNoValue);
    for (uint32_t face = 0; face < mesh_.faceCount(); ++face) {
      if (thickness_.isJudged[face] == 0) continue;
      if (walls_[face].least != kNoFace || judgement_.isSheet(face)) least[face] = thickness_.least[face] * unit_.scale;
      const GreatestSection& section = sections[solids_.solidOf[face]];
      if (thinnest == nullptr || section.bound < thinnest->bound) thinnest = &section;
    }
    if (thinnest == nullptr) return;
    const double last = std::min({thinnest->bound / kThinShare, kLargestLimit, greatest_});
    const LeastLimit next = findNextWall(
        tree, fans_, least, [&](uint32_t face) { return ballsOf(face); }, limit_.value_or(kLeastWallLimit), last,
        computation_.options.thickness.findsNextWall ? kFullNextWall : quickNextWall(mesh_.faceCount()), control);
    thickness_.nextWall = next.wall;
    const bool isFound = thinnest->bound < kUnlimited && thinnest->bound <= kSectionAccuracy * thinnest->diameter;
    if (next.isKnown && !next.wall && isFound) thickness_.nextWall = placeOf(*thinnest);
  }

  /// Searches the greatest section of each body, and farther where the limit needs it.
  void findThickBodies(double limit, std::vector<GreatestSection>& sections, const RunControl& control) {
    const std::vector<uint8_t> isWanted = computedSolids(
        [&](uint32_t face) { return solids_.isClosed[solids_.solidOf[face]] != 0 && judgement_.isJudged(face); });
    std::vector<uint8_t> isUndecided(sections.size());
    for (size_t solid = 0; solid < sections.size(); ++solid)
      if (isWanted[solid] == 0) sections[solid] = {};
    searchAgain(sections, isWanted, kQuickSection, control);
    for (size_t solid = 0; solid < sections.size(); ++solid)
      isUndecided[solid] =
          isWanted[solid] != 0 && sections[solid].diameter <= limit && sections[solid].bound > limit ? 1 : 0;
    searchAgain(sections, isUndecided, {.enough = limit}, control);
    keepGreatest(sections);
    thickness_.sections = std::move(sections);
  }

  void keepGreatest(std::span<const GreatestSection> sections) {
    std::optional<GreatestSection>& greatest = thickness_.greatestSection;
    greatest.reset();
    const std::vector<uint8_t> isComputedSolid = computedSolids([](uint32_t) { return true; });
    for (size_t solid = 0; solid < sections.size(); ++solid)
      if (const GreatestSection& section = sections[solid]; isComputedSolid[solid] != 0 &&
                                                            section.diameter < kUnlimited &&
                                                            !(greatest && section.diameter <= greatest->diameter))
        greatest = section;
    if (greatest)
      greatest = {unit_.toMesh(greatest->centre), unit_.toMeshLength(greatest->diameter),
                  unit_.toMeshLength(greatest->bound)};
  }

  /// Returns the balls of the faces that have a point below the limit.
  std::vector<FaceBalls> measureFaces(const WallTree& tree, std::span<const GreatestSection> sections,
                                      const RunControl& control) {
    std::vector<uint32_t> faces;
    for (const Wall& wall : tree.walls())
      if (isComputed(wall.face)) faces.push_back(wall.face);
    std::vector<FaceBalls> thin;
    for (size_t begin = 0; begin < faces.size(); begin += kBlockFaceCount) {
      const size_t end = std::min(faces.size(), begin + kBlockFaceCount);
      std::vector<FaceBalls> balls(end - begin);
      for (size_t i = begin; i < end; ++i) {
        balls[i - begin].face = faces[i];
        const double bound = std::min(sections[solids_.solidOf[faces[i]]].bound, greatest_);
        balls[i - begin].atBarycentre.ball.diameter = balls[i - begin].least.ball.diameter = bound;
      }
      const auto share = [&](size_t count) { return static_cast<double>(count) / static_cast<double>(faces.size()); };
      shrinkFaceBalls(tree, balls, control.part(share(begin), share(end)));
      for (FaceBalls& each : balls) {
        keep(each);
        const bool isLimited = each.least.wall != kNoFace || judgement_.isSheet(each.face);
        if (limit_ && judgement_.isJudged(each.face) && isLimited && each.least.ball.diameter < kThinShare * *limit_)
          thin.push_back(each);
      }
    }
    return thin;
  }

  /// Stores the diameters of a face, infinite where no wall limits the ball.
  void keep(FaceBalls& balls) {
    const uint32_t face = balls.face;
    if (judgement_.isSheet(face)) balls = sheetBalls(face);
    // Contact is no gap. Beside it the gap has a taper, which also ends with 0.
    const bool isContact = isSpace_ && balls.atBarycentre.ball.diameter <= kUnresolved;
    const auto diameterOf = [&](InscribedBall& ball) {
      if (isContact) ball.wall = kNoFace;
      return ball.wall == kNoFace && !judgement_.isSheet(face) ? kUnlimited : ball.ball.diameter;
    };
    thickness_.atBarycentre[face] = diameterOf(balls.atBarycentre);
    thickness_.least[face] = diameterOf(balls.least);
    walls_[face] = {balls.atBarycentre.wall, balls.least.wall};
  }

  [[nodiscard]] FaceBalls sheetBalls(uint32_t face) const {
    const Vec3d place = scene_.originOf(face);
    const InscribedBall ball{{0, place, place}, kNoFace};
    return {face, ball, ball};
  }

  /// The balls of a face again, from the walls that limit them. Precondition: a wall limits the least ball.
  [[nodiscard]] FaceBalls ballsOf(uint32_t face) const {
    if (judgement_.isSheet(face)) return sheetBalls(face);
    const auto [atBarycentre, least] = walls_[face];
    const PlaneTriangle triangle = triangleOf(scene_, face);
    const Vec3d origin = scene_.originOf(face);
    FaceBalls balls{face, {{kUnlimited, origin, origin}, kNoFace}, {}};
    if (atBarycentre != kNoFace)
      balls.atBarycentre = {
          leastTouchingBall(origin, triangle.normal, triangleOf(scene_, atBarycentre), kContactDistance, kUnlimited),
          atBarycentre};
    balls.least = {leastTouchingBall(triangle, triangleOf(scene_, least), kContactDistance), least};
    return balls;
  }

  /// Searches the greatest sections that are less than the balls of a face, because they cap the thickness there.
  void searchCaps(std::vector<GreatestSection>& sections, const RunControl& control) const {
    const std::vector<uint8_t> isWanted = computedSolids([&](uint32_t face) {
      const uint32_t solid = solids_.solidOf[face];
      return solids_.isClosed[solid] != 0 && sections[solid].caps(thickness_.atBarycentre[face]);
    });
    searchAgain(sections, isWanted, kQuickSection, control);
  }

  /// Caps the thicknesses, and converts them to the unit of the mesh.
  void finishValues(std::span<const GreatestSection> sections) {
    for (uint32_t face = 0; face < mesh_.faceCount(); ++face) {
      double &atBarycentre = thickness_.atBarycentre[face], &least = thickness_.least[face];
      if (std::isnan(least)) continue;
      if (isSpace_ && judgement_.isJudged(face)) thickness_.isJudged[face] = 1;  // Also without a wall in front of it.
      const GreatestSection& section = sections[solids_.solidOf[face]];
      const bool isUnresolved = least <= kUnresolved;
      for (double* value : {&atBarycentre, &least}) {
        *value = section.capped(*value);
        *value = *value < kUnlimited && !judgement_.isDoubleSided(face) ? unit_.toMeshLength(*value) : kNoValue;
      }
      if (std::isnan(least)) continue;
      if (isUnresolved) least = 0;
      thickness_.isJudged[face] = judgement_.isJudged(face) ? 1 : 0;
    }
  }

  const Computation& computation_;
  const JudgedSurface& surface_;
  Judgement judgement_;
  const TraceScene& scene_;
  const TriangleMesh& mesh_;
  const Normalization& unit_;
  OpposingWalls opposing_;
  const Solids& solids_;
  bool isSpace_;
  bool isOfThinPlaces_;
  double greatest_ = kUnlimited;  ///< Greater diameters are not measured.
  PointFans fans_;
  std::optional<double> limit_;   ///< Normalised.
  std::vector<FaceWalls> walls_;  ///< #F
  FaceThickness thickness_;
};

}  // namespace

FaceThickness measureThickness(const Computation& computation, const JudgedSurface& surface,
                               const RunControl& control) {
  return Measurement(computation, surface, false).run(control);
}

FaceThickness findThinPlaces(const Computation& computation, const JudgedSurface& surface, const RunControl& control) {
  return Measurement(computation, surface, true).run(control);
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
