#include "generate/thickness_parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "asdf_vk/error.h"
#include "core/text.h"

// The least thickness of a part is the diameter of the smallest ball between two of its planar walls. For parallel
// walls, the diameter is the distance of the walls. For walls that diverge from the edge of one wall, the diameter is
// the distance of this edge from the other wall. Walls that diverge from a top of width c, at the angle h to their
// middle plane, have the diameter c / cos(h).

namespace asdfvk {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

ThicknessPart soundPart(BlockSolid solid, double leastThickness) {
  return {.solid = std::move(solid), .leastThickness = leastThickness, .leastWall = leastThickness};
}

/// A wedge, 60 long and 20 wide, with a flat bottom and ends of the given heights. An end of height 0 is a sharp edge.
ThicknessPart makeWedge(double firstHeight, double lastHeight) {
  BlockSolid solid;
  solid.addLattice({1, 1, 1}, [&](uint32_t i, uint32_t j, uint32_t k) {
    return Vec3d{60.0 * i, 20.0 * j, k == 0 ? 0 : i == 0 ? firstHeight : lastHeight};
  });
  if (firstHeight > 0) return soundPart(std::move(solid), std::min(firstHeight, lastHeight));
  return {.solid = std::move(solid),
          .sharpAngleDegrees = std::atan(lastHeight / 60) / kRadiansPerDegree,
          .sharpLength = 20};
}

/// A wedge with a sharp edge, and with a pocket far from this edge. The floor of the pocket is 0.7 thick.
ThicknessPart makeBlade() {
  constexpr std::array<double, 4> kXs{0, 45, 55, 60}, kYs{0, 6, 14, 20};
  const auto position = [&](uint32_t i, uint32_t j, uint32_t k) {
    return Vec3d{kXs[i], kYs[j], k == 0 || i == 0 ? 0 : k == 1 ? 0.7 : kXs[i] / 12};
  };
  ThicknessPart part = makeWedge(0, 5);
  part.solid = {};
  part.solid.addLattice({3, 3, 2}, position,
                        [](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0; });
  part.leastWall = 0.7;
  return part;
}

/// A pyramid with its tip at the top.
ThicknessPart makeSpike() {
  BlockSolid solid;
  solid.addLattice({1, 1, 1}, [](uint32_t i, uint32_t j, uint32_t k) {
    return k == 1 ? Vec3d{0, 0, 20} : Vec3d{4.0 * i - 2, 4.0 * j - 2, 0};
  });
  return {.solid = std::move(solid), .sharpAngleDegrees = 2 * std::atan(2.0 / 20) / kRadiansPerDegree};
}

ThicknessPart makeThickCube() {
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {60}}, {{0}, {60}}, {0, 60});
  return soundPart(std::move(solid), 60);
}

ThicknessPart makeSteppedPlate() {
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {35}, {60}}, {{0}, {30}}, {0, 1.2, 3},
                    [](uint32_t i, uint32_t, uint32_t k) { return i == 0 || k == 0; });
  return soundPart(std::move(solid), 1.2);
}

/// A plate 2.5 thick with a boss of 8 x 8 and a rib whose top is 1.5 thick. slope: draft of both sides of the rib.
ThicknessPart makeRibbedPlate(double slope) {
  constexpr double kTop = 12.5;
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {20 - slope * kTop, slope}, {21.5 + slope * kTop, -slope}, {50}, {58}, {80}},
                    {{0}, {26}, {34}, {60}}, {0, 2.5, kTop},
                    [](uint32_t i, uint32_t j, uint32_t k) { return k == 0 || i == 1 || (i == 3 && j == 1); });
  return soundPart(std::move(solid), 1.5 * std::sqrt(1 + slope * slope));
}

ThicknessPart makePocket() {
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {10}, {30}, {40}}, {{0}, {8}, {22}, {30}}, {0, 0.6, 10},
                    [](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0; });
  return soundPart(std::move(solid), 0.6);
}

/// An open box of 40 x 30 x 25. wall: thickness at the rim, along x and y. outerSlope, innerSlope: draft of the walls.
ThicknessPart makeOpenBox(double outerSlope, double innerSlope, double wall, double floor) {
  constexpr double kHeight = 25;
  const auto planes = [&](double width) {
    const double outer = width / 2, inner = outer - wall;
    return std::vector<DraftedPlane>{{outerSlope * kHeight - outer, -outerSlope},
                                     {innerSlope * kHeight - inner, -innerSlope},
                                     {inner - innerSlope * kHeight, innerSlope},
                                     {outer - outerSlope * kHeight, outerSlope}};
  };
  BlockSolid solid;
  addDraftedLattice(solid, planes(40), planes(30), {0, floor, kHeight},
                    [](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0; });
  return soundPart(std::move(solid), std::min(floor, wall / std::sqrt(1 + outerSlope * outerSlope)));
}

/// Apothem of a regular polygon with `sideCount` sides, divided by the distance of its corners from the axis.
double apothemFactor(uint32_t sideCount) { return std::cos(std::numbers::pi / sideCount); }

/// The position function of a solid of revolution. radiusAt(i, k): radius at point (i, k) of the profile lattice.
template <typename Radius>
auto revolved(uint32_t sideCount, const std::vector<double>& heights, const Radius& radiusAt) {
  return [=](uint32_t i, uint32_t j, uint32_t k) {
    const double angle = 2 * std::numbers::pi * (j % sideCount) / sideCount, radius = radiusAt(i, k);
    return Vec3d{radius * std::cos(angle), radius * std::sin(angle), heights[k]};
  };
}

/// A drafted cup of 24 sides with an open top. The wall is 1 thick at the top; the inside has more draft.
ThicknessPart makeRoundCup() {
  constexpr uint32_t kSideCount = 24;
  constexpr double kHeight = 12, kOuterSlope = 0.02, kInnerSlope = 0.04;
  const double factor = apothemFactor(kSideCount);
  const std::vector<double> heights{0, 1.5, kHeight};
  const auto radiusAt = [=](uint32_t i, uint32_t k) {
    const double below = kHeight - heights[k];
    return i == 0 ? 0 : i == 1 ? 8 - 1 / factor - kInnerSlope * below : 8 - kOuterSlope * below;
  };
  BlockSolid solid;
  solid.addLattice({2, kSideCount, 2}, revolved(kSideCount, heights, radiusAt),
                   [](uint32_t i, uint32_t, uint32_t k) { return i == 1 || k == 0; });
  return soundPart(std::move(solid), 1 / std::hypot(1, factor * kOuterSlope));
}

/// Rings of teeth around a tube of 12 sides with a wall of 3. crest: width of a tooth at its top. With a crest, the
/// upper flank is horizontal, so that a tooth is thinnest at its top. crest 0: sharp teeth with two inclined flanks.
ThicknessPart makeThread(double crest) {
  constexpr uint32_t kSideCount = 12, kToothCount = 2;
  constexpr double kBase = 1.6, kLand = 1.4, kDepth = 2, kBore = 2, kEnd = 3.2;
  const double factor = apothemFactor(kSideCount), root = kBore + 3 / factor, crestRadius = root + kDepth;
  std::vector<double> heights{0}, radii{root};
  std::vector<bool> isTooth;  // One entry per layer.
  const auto add = [&](double height, double radius, bool tooth) {
    heights.push_back(heights.back() + height);
    radii.push_back(radius);
    isTooth.push_back(tooth);
  };
  for (uint32_t tooth = 0; tooth < kToothCount; ++tooth) {
    add(tooth == 0 ? kEnd : kLand, root, false);
    add(crest > 0 ? kBase - crest : kBase / 2, crestRadius, true);
    add(crest > 0 ? crest : kBase / 2, crest > 0 ? crestRadius : root, true);
  }
  add(kEnd, root, false);
  const auto radiusAt = [&](uint32_t i, uint32_t k) { return i == 0 ? kBore : i == 1 ? root : radii[k]; };
  BlockSolid solid;
  solid.addLattice({2, kSideCount, static_cast<uint32_t>(isTooth.size())}, revolved(kSideCount, heights, radiusAt),
                   [&](uint32_t i, uint32_t, uint32_t k) { return i == 0 || isTooth[k]; });
  if (crest > 0) return soundPart(std::move(solid), crest);
  const double slope = kBase / 2 / (kDepth * factor);
  return {.solid = std::move(solid),
          .leastWall = 3,
          .sharpAngleDegrees = 2 * std::atan(slope) / kRadiansPerDegree,
          .sharpLength = kToothCount * kSideCount * 2 * crestRadius * std::sin(std::numbers::pi / kSideCount)};
}

/// Two legs of thickness 2, and a fillet of radius 3 between them. sideCount: number of sides of the fillet, even.
ThicknessPart makeBracket(uint32_t sideCount) {
  constexpr double kWall = 2, kRadius = 3, kLeg = 16, kWidth = 10, kCentre = kWall + kRadius;
  const auto position = [&](uint32_t i, uint32_t j, uint32_t k) {
    const double share = (i - 1.0) / sideCount, angle = -std::numbers::pi / 2 * (1 + share), z = kWidth * k;
    if (i == 0) return Vec3d{kLeg, kWall * j, z};
    if (i == sideCount + 2) return Vec3d{kWall * j, kLeg, z};
    if (j == 1) return Vec3d{kCentre + kRadius * std::cos(angle), kCentre + kRadius * std::sin(angle), z};
    return Vec3d{kCentre * std::max(0.0, 1 - 2 * share), kCentre * std::max(0.0, 2 * share - 1), z};
  };
  BlockSolid solid;
  solid.addLattice({sideCount + 2, 1, 1}, position);
  return soundPart(std::move(solid), kWall);
}

/// A plate with a hole of radius 5 near an edge. sideCount: number of sides of the hole, a multiple of 4. If sideCount
/// is a multiple of 8, the hole has a corner at the ligament. For other counts, the middle of a side is at the
/// ligament.
ThicknessPart makeLigament(uint32_t sideCount) {
  constexpr double kRadius = 5, kLigament = 0.6, kThickness = 4;
  const double nearest = kRadius * (sideCount % 8 == 0 ? 1 : apothemFactor(sideCount));
  const std::array<Vec3d, 5> outline{{{nearest + kLigament, -9, 0},
                                      {nearest + kLigament, 9, 0},
                                      {-12, 9, 0},
                                      {-12, -9, 0},
                                      {nearest + kLigament, -9, 0}}};
  const auto position = [&](uint32_t i, uint32_t j, uint32_t k) {
    const uint32_t corner = j % sideCount, side = corner / (sideCount / 4);
    const double along = 4.0 * corner / sideCount, angle = std::numbers::pi / 2 * (along - 0.5);
    const Vec3d onOutline = outline[side] + (along - side) * (outline[side + 1] - outline[side]);
    const Vec3d onHole{kRadius * std::cos(angle), kRadius * std::sin(angle), 0};
    return (i == 0 ? onHole : onOutline) + Vec3d{0, 0, kThickness * k};
  };
  BlockSolid solid;
  solid.addLattice({1, sideCount, 1}, position);
  return soundPart(std::move(solid), kLigament);
}

struct NamedPart {
  std::string_view name;
  ThicknessPart (*make)();
};

constexpr std::array kParts{
    NamedPart{"wedge", [] { return makeWedge(1, 5); }},
    NamedPart{"thin-wedge", [] { return makeWedge(2, 0.3); }},
    NamedPart{"knife", [] { return makeWedge(0, 5); }},
    NamedPart{"blade", makeBlade},
    NamedPart{"spike", makeSpike},
    NamedPart{"thick-cube", makeThickCube},
    NamedPart{"stepped-plate", makeSteppedPlate},
    NamedPart{"ribbed-plate", [] { return makeRibbedPlate(0); }},
    NamedPart{"drafted-rib", [] { return makeRibbedPlate(std::tan(kRadiansPerDegree)); }},
    NamedPart{"pocket", makePocket},
    NamedPart{"shelled-box", [] { return makeOpenBox(0.03, 0.03, 2 * std::hypot(1, 0.03), 2); }},
    NamedPart{"drafted-box", [] { return makeOpenBox(0.02, 0.05, 1, 1.5); }},
    NamedPart{"round-cup", makeRoundCup},
    NamedPart{"bracket-4", [] { return makeBracket(4); }},
    NamedPart{"bracket-16", [] { return makeBracket(16); }},
    NamedPart{"ligament-12", [] { return makeLigament(12); }},
    NamedPart{"ligament-24", [] { return makeLigament(24); }},
    NamedPart{"ligament-96", [] { return makeLigament(96); }},
    NamedPart{"flat-thread", [] { return makeThread(0.9); }},
    NamedPart{"sharp-thread", [] { return makeThread(0); }},
};

}  // namespace

std::vector<std::string_view> thicknessPartNames() {
  std::vector<std::string_view> names;
  for (const NamedPart& part : kParts) names.push_back(part.name);
  return names;
}

ThicknessPart makeThicknessPart(std::string_view name) {
  for (const NamedPart& part : kParts)
    if (part.name == name) return part.make();
  throw Error(ErrorCode::OptionOutOfRange,
              fmt::format("unknown part {}; the parts are {}", name, joined(thicknessPartNames(), ", ")));
}

}  // namespace asdfvk
