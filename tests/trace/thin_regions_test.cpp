#include "trace/thin_regions.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <vector>

#include "core/random.h"
#include "generate/thickness_parts.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "trace/wall_rule.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

/// The thin pieces and regions of a mesh as the wall check finds them, without greatest sections. Lengths in the unit
/// of the mesh.
struct ThinMesh {
  TracedMesh traced;
  double unit;                    ///< Normalised units per unit of the mesh.
  std::vector<ThinPiece> pieces;  ///< The thin pieces that are not halved, before regions are looked for.
  std::vector<ConnectedThinParts> regions;

  ThinMesh(Mesh mesh, double limit, double maxLength, const RunControl& control = {})
      : traced(std::move(mesh)), unit(traced.bvh.normalization.scale) {
    const TraceScene scene = traced.scene();
    const WallTree tree(scene, makeOpposingWalls({}));
    const PointFans fans(traced.mesh);
    const double thinLimit = kThinShare * limit * unit;
    std::vector<FaceBalls> balls, thin;
    for (const uint32_t face : traced.seedFaces()) balls.push_back({face, {}, {}});
    shrinkFaceBalls(tree, balls, {});
    for (const FaceBalls& each : balls)
      if (each.least.ball.diameter < thinLimit) thin.push_back(each);
    ThinPieces divided(tree, fans, thin, thinLimit);
    divided.divide(maxLength * unit, control);
    for (uint32_t i = 0; i < divided.size(); ++i)
      if (divided.isThin(i) && divided[i].firstHalf == kNoPiece) pieces.push_back(divided[i]);
    regions = findThinRegions(divided, limit * unit, {}, control);
  }

  /// Area of the parts that are thin at their middle.
  [[nodiscard]] double thinArea() const {
    double area = 0;
    for (const ConnectedThinParts& region : regions)
      for (const ThinPart& part : region.parts)
        if (part.isThinAtMiddle)
          area += 0.5 * length(cross(part.corners[1] - part.corners[0], part.corners[2] - part.corners[0]));
    return area / unit / unit;
  }

  [[nodiscard]] Vec3d toMesh(const Vec3d& point) const { return point / unit + traced.bvh.normalization.centre; }

  /// Number of parts of a face that contain a point of it.
  [[nodiscard]] int partCountAt(uint32_t face, const Vec3d& point) const {
    const Vec3d p = traced.bvh.normalization.toNormalized(point);
    int count = 0;
    for (const ConnectedThinParts& region : regions)
      count += static_cast<int>(std::count_if(region.parts.begin(), region.parts.end(), [&](const ThinPart& part) {
        if (part.face != face) return false;
        for (size_t k = 0; k < 3; ++k) {
          const Vec3d &a = part.corners[k], &b = part.corners[(k + 1) % 3];
          if (dot(cross(b - a, p - a), traced.geometry.normals[face]) < 0) return false;
        }
        return true;
      }));
    return count;
  }

  [[nodiscard]] long countOf(ThinKind kind) const {
    return std::count_if(regions.begin(), regions.end(), [&](const auto& region) { return region.kind == kind; });
  }

  /// Number of regions that have a part in the faces [first, last).
  [[nodiscard]] long regionCountOf(uint32_t first, uint32_t last) const {
    return std::count_if(regions.begin(), regions.end(), [&](const ConnectedThinParts& region) {
      return std::any_of(region.parts.begin(), region.parts.end(),
                         [&](const ThinPart& part) { return first <= part.face && part.face < last; });
    });
  }
};

/// 60 x 20, 1 to 5 high: 12 faces.
Mesh wedge(double longestEdge = 1e9) { return makeThicknessPart("wedge").solid.surface({.longestEdge = longestEdge}); }

/// On a wall of the wedge, distances from the edge in which its walls would meet, 15 beyond its thin end: up to where
/// the ball between the walls has the diameter `limit`.
double thinEnd(double limit) { return 15 * limit * (1 + std::hypot(1, 1.0 / 15)) / 2; }

/// Both walls of the wedge, 20 wide; the upper one begins 15 sqrt(1 + 1 / 225) from that edge.
double thinAreaOfWedge(double limit) {
  return 20 * (thinEnd(limit) - 15) + 20 * (thinEnd(limit) - 15 * std::hypot(1, 1.0 / 15));
}

Mesh rectangle(double x0, double x1, double y0, double y1, double z, bool looksUp) {
  const Mesh up{{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  return looksUp ? up : shapes::inverted(up);
}

/// A bottom of two faces, 40 x 10, and above it at 0.5 two floors of pockets, and perhaps a groove between them. The
/// bottom looks down, the floors look up.
Mesh pockets(bool haveGroove) {
  Mesh mesh = shapes::joined(rectangle(0, 40, 0, 10, 0, false), rectangle(5, 10, 3, 7, 0.5, true));
  mesh = shapes::joined(std::move(mesh), rectangle(30, 35, 3, 7, 0.5, true));
  return haveGroove ? shapes::joined(std::move(mesh), rectangle(9, 31, 4, 6, 0.45, true)) : mesh;
}

}  // namespace

TEST_CASE("the thin area of a wedge is that of the strips at its thin end, at any triangulation") {
  for (const double limit : {1.5, 2.0, 3.0})
    for (const double longestEdge : {1e9, 7.0, 2.0}) {
      CAPTURE(limit);
      CAPTURE(longestEdge);
      const ThinMesh thin(wedge(longestEdge), limit, limit / 4);
      CHECK(thin.thinArea() == doctest::Approx(thinAreaOfWedge(kThinShare * limit)).epsilon(0.02));
      CHECK(thin.regions.size() == 1);  // Both sides of the wedge, which are not connected around its end.
      CHECK(thin.countOf(ThinKind::Wall) == 1);
    }
}

TEST_CASE("parts cover each thin point once, and no point twice") {
  constexpr double kLimit = 2;
  const ThinMesh thin(wedge(), kLimit, kLimit / 4);
  REQUIRE(thin.traced.mesh.faces.size() == 12);
  Random random(3);
  int thinCount = 0;
  for (uint32_t face = 0; face < 12; ++face)
    for (int i = 0; i < 300; ++i) {
      const auto [a, b, c] = thin.traced.mesh.faces[face];
      double s = random.real(), t = random.real();
      if (s + t > 1) s = 1 - s, t = 1 - t;
      const std::vector<Vec3d>& at = thin.traced.mesh.vertices;
      const Vec3d p = at[a] + s * (at[b] - at[a]) + t * (at[c] - at[a]);
      const double along = length(Vec3d{p.x + 15, 0, p.z});
      const bool isOfWall = std::abs(thin.traced.geometry.normals[face].z) > 0.5;
      const int count = thin.partCountAt(face, p);
      if (isOfWall && along < thinEnd(kThinShare * kLimit)) {
        CHECK(count == 1);
        ++thinCount;
      } else {
        CHECK(count <= (isOfWall && along < thinEnd(kLimit) + kLimit / 2 ? 1 : 0));
      }
    }
  CHECK(thinCount > 100);
}

TEST_CASE("a large face is divided only near the limit: half the length, twice as many pieces") {
  constexpr double kLimit = 2;
  const size_t coarse = ThinMesh(wedge(), kLimit, 0.5).pieces.size(),
               fine = ThinMesh(wedge(), kLimit, 0.125).pieces.size();
  CHECK(coarse < 1000);  // Pieces of 0.5 over the whole strips would be 4,800.
  CHECK(fine < 5 * coarse);
  CHECK(ThinMesh(wedge(), 0.9, 0.2).regions.empty());
  CHECK(ThinMesh(shapes::box({9, 9, 1}), 2, 0.5).pieces.size() == 4);  // Thin everywhere: whole faces.
}

TEST_CASE("pieces are not longer than asked for unless thin everywhere, and as thin as they say") {
  const ThinMesh thin(wedge(), 2, 0.5);
  for (const ThinPiece& piece : thin.pieces) {
    CHECK(piece.least.ball.diameter < 2 * kThinShare * thin.unit);
    CHECK(piece.least.ball.diameter <= piece.atMiddle);
    if (longestSideOf(piece.corners).second / thin.unit <= 0.5) continue;
    for (const Vec3d& corner : piece.corners) {
      const Vec3d p = thin.toMesh(corner);
      CHECK(length(Vec3d{p.x + 15, 0, p.z}) <= thinEnd(2) * (1 + 1e-9));
    }
  }
}

TEST_CASE("two pockets over one face are separate regions, a groove between them connects the other side only") {
  for (const bool haveGroove : {false, true}) {
    CAPTURE(haveGroove);
    const ThinMesh thin(pockets(haveGroove), 0.8, 0.2);
    CHECK(thin.regionCountOf(0, 2) == (haveGroove ? 1 : 2));  // The bottom.
    // The groove is the least wall above the bottom, and each pocket is a wall of its own.
    CHECK(thin.regions.size() == (haveGroove ? 3 : 2));
    CHECK(thin.countOf(ThinKind::Wall) == static_cast<long>(thin.regions.size()));
    // Each floor is one region of two faces.
    CHECK(thin.regionCountOf(2, 4) == 1);
    CHECK(thin.regionCountOf(4, 6) == 1);
    for (const ConnectedThinParts& region : thin.regions) {
      const double thickness = region.place.ball.ball.diameter / thin.unit;
      CHECK((thickness == doctest::Approx(0.5) || thickness == doctest::Approx(0.45)));
    }
  }
}

TEST_CASE("a face that is thin everywhere connects thin places of a face at a right angle to it") {
  const auto upright = [](Mesh mesh) {
    for (Vec3d& v : mesh.vertices) v = {v.x, -v.z, v.y};
    return mesh;
  };
  for (const bool hasStrip : {false, true}) {
    CAPTURE(hasStrip);
    // A wall with two pockets behind it, and a strip along its lower edge.
    Mesh mesh = shapes::joined(upright(rectangle(0, 40, 0, 10, 0, false)), rectangle(0, 40, -1, 0, 0, false));
    mesh = shapes::joined(std::move(mesh), upright(rectangle(5, 10, 0, 4, 0.5, true)));
    mesh = shapes::joined(std::move(mesh), upright(rectangle(30, 35, 0, 4, 0.5, true)));
    if (hasStrip) mesh = shapes::joined(std::move(mesh), rectangle(0, 40, -1, 0, 0.5, true));
    const ThinMesh thin(mesh, 0.6, 0.2);
    CHECK(thin.regionCountOf(0, 4) == (hasStrip ? 1 : 2));
  }
}

TEST_CASE("each pocket of a plate is one region, with both of its sides") {
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {5}, {10}, {25}, {30}, {40}}, {{0}, {5}, {10}, {15}}, {0, 0.5, 4},
                    [](uint32_t i, uint32_t j, uint32_t k) { return k == 0 || j != 1 || (i != 1 && i != 3); });
  for (const double longestEdge : {1e9, 3.0}) {
    const ThinMesh thin(solid.surface({.longestEdge = longestEdge}), 0.8, 0.2);
    CHECK(thin.regions.size() == 2);
    CHECK(thin.countOf(ThinKind::Wall) == 2);
    for (const ConnectedThinParts& region : thin.regions) {
      bool looksUp = false, looksDown = false;
      for (const ThinPart& part : region.parts)
        (thin.traced.geometry.normals[part.face].z > 0 ? looksUp : looksDown) = true;
      CHECK((looksUp && looksDown));
    }
    CHECK(ThinMesh(solid.surface({.longestEdge = longestEdge}), 0.49, 0.2).regions.empty());
  }
}

TEST_CASE("a blade of 5 degrees is a wall beside its pocket, sharp teeth of 45 degrees are edges") {
  const double limit = 0.8;
  for (const double longestEdge : {1e9, 4.0}) {
    const ThinMesh thin(makeThicknessPart("blade").solid.surface({.longestEdge = longestEdge}), limit, limit / 4);
    REQUIRE(thin.regions.size() == 2);  // Both sides of the edge; floor of the pocket and bottom below it.
    CHECK(thin.countOf(ThinKind::Wall) == 2);
    std::vector<double> leastXs;
    for (const ConnectedThinParts& region : thin.regions) {
      double least = 1e9;
      for (const ThinPart& part : region.parts)
        for (const Vec3d& corner : part.corners) least = std::min(least, thin.toMesh(corner).x);
      leastXs.push_back(least);
      const double leastBall = region.leastPlace.ball.ball.diameter, wall = region.place.ball.ball.diameter;
      CHECK(leastBall <= wall);
      CHECK((leastBall <= kUnresolved) == (least < 1));  // The thickness at the edge is 0.
      CHECK(wall > 0.2 * limit * thin.unit);
    }
    std::sort(leastXs.begin(), leastXs.end());
    CHECK(leastXs[0] == doctest::Approx(0).epsilon(0.02));
    CHECK(leastXs[1] == doctest::Approx(45).epsilon(0.02));
    const ThinMesh teeth(makeThicknessPart("sharp-thread").solid.surface({.longestEdge = longestEdge}), 1, 0.25);
    CHECK(teeth.regions.size() == 2);  // The crests of two teeth.
    CHECK(teeth.countOf(ThinKind::Edge) == 2);
  }
  CHECK(ThinMesh(makeThicknessPart("spike").solid.surface(), 1, 0.25).regions.size() == 1);  // A tip.
}

TEST_CASE("the surface around a point is connected to it within reach, at any triangulation") {
  // A plate from below z = 0.36 to a rib on it. Its underside ends at x = 0.6, where the rib ends above: there, the
  // part is 0.36 thick. The side of the rib turns to the other side of the plate within reach of the underside. It is
  // connected to the underside at the ends of the rib only, beyond reach.
  BlockSolid solid;
  addDraftedLattice(solid, {{-2}, {0}, {0.6}, {3}}, {{0}, {0.7}}, {-1.5, 0, 0.36, 1.1},
                    [](uint32_t i, uint32_t, uint32_t k) { return k == 1 || (k == 0) == (i != 1); });
  for (const double limit : {0.96, 1.0, 1.04})
    for (const double longestEdge : {1e9, 0.3, 0.1}) {
      CAPTURE(limit);
      CAPTURE(longestEdge);
      const ThinMesh thin(solid.surface({.longestEdge = longestEdge}), limit, limit / 4);
      double least = 1e9;
      for (const ConnectedThinParts& region : thin.regions)
        if (region.kind == ThinKind::Wall) least = std::min(least, region.place.ball.ball.diameter / thin.unit);
      CHECK(least == doctest::Approx(0.36).epsilon(0.05));
    }
}

TEST_CASE("a stop request ends the division") {
  std::stop_source stop;
  stop.request_stop();
  test::requireFailure([&] { ThinMesh(wedge(), 2, 0.5, {stop.get_token(), {}}); }, ErrorCode::Cancelled);
}
