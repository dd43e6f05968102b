#include "trace/thin_parts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stop_token>
#include <vector>

#include "core/random.h"
#include "generate/thickness_parts.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

/// The thin parts of a mesh as the wall check finds them, without greatest sections. Lengths in the unit of the mesh.
struct ThinMesh {
  TracedMesh traced;
  double unit;  ///< Normalised units per unit of the mesh.
  std::vector<ThinPart> parts;

  ThinMesh(Mesh mesh, double limit, double maxLength, const RunControl& control = {})
      : traced(std::move(mesh)), unit(traced.bvh.normalization.scale) {
    const TraceScene scene = traced.scene();
    const WallTree tree(scene, makeOpposingWalls({}));
    const PointFans fans(traced.mesh);
    const SharpEdges sharp =
        findSharpEdges(traced.mesh, traced.geometry, fans, tree.opposing().cosine, kContactDistance / unit);
    std::vector<FaceBalls> balls, thin;
    for (const uint32_t face : traced.seedFaces()) balls.push_back({face, {}, {}});
    shrinkFaceBalls(tree, balls, {});
    for (const FaceBalls& each : balls)
      if (sharp.faceBits[each.face] != 0 || each.least.ball.diameter < limit * unit) thin.push_back(each);
    parts = findThinParts(tree, fans, sharp, thin, limit * unit, maxLength * unit, control);
  }

  [[nodiscard]] double areaOf(const ThinPart& part) const {
    const auto& [a, b, c] = part.corners;
    return 0.5 * length(cross(b - a, c - a)) / unit / unit;
  }

  /// Area of the parts that are thin at their middle.
  [[nodiscard]] double thinArea() const {
    double area = 0;
    for (const ThinPart& part : parts) area += part.isThinAtMiddle ? areaOf(part) : 0;
    return area;
  }

  [[nodiscard]] std::set<uint32_t> regions() const {
    std::set<uint32_t> regions;
    for (const ThinPart& part : parts) regions.insert(part.region);
    return regions;
  }

  /// Number of parts of a face that contain a point of it.
  [[nodiscard]] int partCountAt(uint32_t face, const Vec3d& point) const {
    const Vec3d p = traced.bvh.normalization.toNormalized(point);
    return static_cast<int>(std::count_if(parts.begin(), parts.end(), [&](const ThinPart& part) {
      if (part.face != face) return false;
      for (size_t k = 0; k < 3; ++k) {
        const Vec3d &a = part.corners[k], &b = part.corners[(k + 1) % 3];
        if (dot(cross(b - a, p - a), traced.geometry.normals[face]) < 0) return false;
      }
      return true;
    }));
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

std::set<uint32_t> regionsOfFaces(const ThinMesh& thin, uint32_t first, uint32_t last) {
  std::set<uint32_t> regions;
  for (const ThinPart& part : thin.parts)
    if (first <= part.face && part.face < last) regions.insert(part.region);
  return regions;
}

}  // namespace

TEST_CASE("the thin area of a wedge is that of the strips at its thin end, at any triangulation") {
  for (const double limit : {1.5, 2.0, 3.0})
    for (const double longestEdge : {1e9, 7.0, 2.0}) {
      CAPTURE(limit);
      CAPTURE(longestEdge);
      const ThinMesh thin(wedge(longestEdge), limit, limit / 4);
      CHECK(thin.thinArea() == doctest::Approx(thinAreaOfWedge(limit)).epsilon(0.02));
      CHECK(thin.regions() == std::set<uint32_t>{0, 1});  // Connected over the faces of one wall, not around the end.
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
      if (isOfWall && along < thinEnd(kLimit)) {
        CHECK(count == 1);
        ++thinCount;
      } else {
        CHECK(count <= (isOfWall && along < thinEnd(kLimit) + kLimit / 2 ? 1 : 0));
      }
    }
  CHECK(thinCount > 100);
}

TEST_CASE("a large face is divided only near the limit: half the length, twice as many parts") {
  constexpr double kLimit = 2;
  const size_t coarse = ThinMesh(wedge(), kLimit, 0.5).parts.size(),
               fine = ThinMesh(wedge(), kLimit, 0.125).parts.size();
  CHECK(coarse < 1000);  // Pieces of 0.5 over the whole strips would be 4,800.
  CHECK(fine < 5 * coarse);
  CHECK(ThinMesh(wedge(), 0.9, 0.2).parts.empty());
  CHECK(ThinMesh(shapes::box({9, 9, 1}), 2, 0.5).parts.size() == 4);  // Thin everywhere: whole faces.
}

TEST_CASE("parts are of their faces, not longer than asked for unless thin everywhere, and as thin as they say") {
  const ThinMesh thin(wedge(), 2, 0.5);
  for (const ThinPart& part : thin.parts) {
    CHECK(part.least.ball.diameter < 2 * thin.unit);
    CHECK_FALSE(part.isSharp);
    double longest = 0;
    for (size_t k = 0; k < 3; ++k)
      longest = std::max(longest, length(part.corners[(k + 1) % 3] - part.corners[k]) / thin.unit);
    if (longest <= 0.5) continue;
    for (const Vec3d& corner : part.corners) {
      const Vec3d p = corner / thin.unit + thin.traced.bvh.normalization.centre;
      CHECK(length(Vec3d{p.x + 15, 0, p.z}) <= thinEnd(2) * (1 + 1e-9));
    }
  }
  CHECK(std::is_sorted(thin.parts.begin(), thin.parts.end(),
                       [](const ThinPart& a, const ThinPart& b) { return a.face < b.face; }));
}

TEST_CASE("two pockets over one face are separate regions, a groove between them connects these") {
  for (const bool haveGroove : {false, true}) {
    CAPTURE(haveGroove);
    const ThinMesh thin(pockets(haveGroove), 0.8, 0.2);
    const std::set<uint32_t> bottom = regionsOfFaces(thin, 0, 2);
    CHECK(bottom.size() == (haveGroove ? 1 : 2));
    // Each floor is one region of two faces.
    CHECK(regionsOfFaces(thin, 2, 4).size() == 1);
    CHECK(regionsOfFaces(thin, 4, 6).size() == 1);
    CHECK(thin.regions().size() == bottom.size() + (haveGroove ? 3 : 2));
    // Numbers ascend by the first parts.
    uint32_t next = 0;
    for (const ThinPart& part : thin.parts) {
      CHECK(part.region <= next);
      next = std::max(next, part.region + 1);
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
    CHECK(regionsOfFaces(thin, 0, 4).size() == (hasStrip ? 1 : 2));
  }
}

TEST_CASE("pockets of a plate are regions on both of its sides") {
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {5}, {10}, {25}, {30}, {40}}, {{0}, {5}, {10}, {15}}, {0, 0.5, 4},
                    [](uint32_t i, uint32_t j, uint32_t k) { return k == 0 || j != 1 || (i != 1 && i != 3); });
  for (const double longestEdge : {1e9, 3.0}) {
    const ThinMesh thin(solid.surface({.longestEdge = longestEdge}), 0.8, 0.2);
    CHECK(thin.regions().size() == 4);
    CHECK(ThinMesh(solid.surface({.longestEdge = longestEdge}), 0.49, 0.2).parts.empty());
  }
}

TEST_CASE("the region at a sharp edge is sharp, around the edge, and the pocket of the same part is not") {
  const double limit = 0.8;
  for (const double longestEdge : {1e9, 4.0}) {
    const ThinMesh thin(makeThicknessPart("blade").solid.surface({.longestEdge = longestEdge}), limit, limit / 4);
    std::map<uint32_t, bool> isSharp;
    std::map<uint32_t, double> leastX;
    for (const ThinPart& part : thin.parts) {
      isSharp[part.region] = isSharp[part.region] || part.isSharp;
      double& least = leastX.try_emplace(part.region, 1e9).first->second;
      bool isAtEdge = false;
      for (const Vec3d& corner : part.corners) {
        const double x = corner.x / thin.unit + thin.traced.bvh.normalization.centre.x;
        least = std::min(least, x);
        isAtEdge = isAtEdge || x < 1e-9;
      }
      CHECK(part.isSharp == isAtEdge);
    }
    REQUIRE(isSharp.size() == 3);  // Both walls at the edge; floor of the pocket; bottom below it.
    for (const auto& [region, sharp] : isSharp) CHECK(leastX[region] == doctest::Approx(sharp ? 0 : 45).epsilon(0.02));
    CHECK(std::count_if(isSharp.begin(), isSharp.end(), [](const auto& each) { return each.second; }) == 1);
  }
  // A tip.
  const ThinMesh spike(makeThicknessPart("spike").solid.surface(), 1, 0.25);
  CHECK(spike.regions().size() == 1);
  CHECK(std::count_if(spike.parts.begin(), spike.parts.end(), [](const ThinPart& part) { return part.isSharp; }) >= 4);
}

TEST_CASE("a stop request ends the division") {
  std::stop_source stop;
  stop.request_stop();
  test::requireFailure([&] { ThinMesh(wedge(), 2, 0.5, {stop.get_token(), {}}); }, ErrorCode::Cancelled);
}
