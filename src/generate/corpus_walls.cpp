#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generate/block_solid.h"
#include "generate/corpus.h"
#include "generate/solids.h"
#include "generate/thickness_parts.h"

namespace asdfvk {
namespace {

using Place = std::array<Vec3d, 2>;

constexpr double kLimit = 0.8;

KnownAnswer answerOfWall(double limit, PartVerdict verdict, std::string reason) {
  return {.limit = limit, .verdict = verdict, .reason = std::move(reason)};
}

/// Answers on both sides of a wall of constant thickness.
std::vector<KnownAnswer> answersAround(double thickness, const std::optional<Place>& place, const std::string& what) {
  const auto answer = [&](double factor, PartVerdict verdict, const char* relation) {
    return KnownAnswer{.limit = factor * thickness,
                       .verdict = verdict,
                       .value = thickness,
                       .place = place,
                       .reason = fmt::format("{} is {:.6g} thick, {} the limit.", what, thickness, relation)};
  };
  return {answer(0.97, PartVerdict::Pass, "more than"), answer(1.03, PartVerdict::Fail, "less than")};
}

/// A plate of 40 x 30 x 10 with a pocket in its middle. The floor of the pocket is the least wall.
Mesh floorPlate(double floor) {
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {10}, {30}, {40}}, {{0}, {8}, {22}, {30}}, {0, floor, 10},
                    [](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0; });
  return solid.surface();
}

/// The parts of the generator at the limit 0.8, and some at a greater one.
void addThicknessParts(std::vector<KnownPart>& parts) {
  struct Row {
    std::string_view name;
    bool fails;
    double greater;  // A limit above the least wall, at which the part fails; 0: none.
    const char* reason;
  };
  for (const auto& [name, fails, greater, reason] :
       {Row{"wedge", false, 1.25, "The wedge is 1 thick at its thin end, and its angle is 4 degrees"},
        Row{"thin-wedge", true, 0, "The wedge is 0.3 thick at its thin end, and its angle is 2 degrees"},
        Row{"knife", true, 0, "The angle of the knife is 5 degrees, so its edge counts"},
        Row{"blade", true, 0, "The floor of the pocket is 0.7 thick, and the angle of the edge is 5 degrees"},
        Row{"spike", true, 0, "The angle of the tip is 11 degrees, so it counts"},
        Row{"thick-cube", false, 75, "The cube is 60 thick"},
        Row{"stepped-plate", false, 1.5, "The thin half of the plate is 1.2 thick"},
        Row{"ribbed-plate", false, 1.9, "The rib is 1.5 thick and 10 high"},
        Row{"drafted-rib", false, 1.9, "The rib is 1.5 thick at its top, and its draft is 1 degree"},
        Row{"pocket", true, 0, "The floor of the pocket is 0.6 thick"},
        Row{"shelled-box", false, 2.5, "Walls and floor are 2 thick"},
        Row{"drafted-box", false, 1.25, "The walls are 1 thick at the rim, and taper by less than 2 degrees"},
        Row{"round-cup", false, 1.25, "The wall is 1 thick at the rim, and tapers by 1 degree"},
        Row{"bracket-4", false, 2.5, "The legs are 2 thick"},
        Row{"bracket-16", false, 2.5, "The legs are 2 thick"},
        Row{"ligament-12", true, 0, "The ligament beside the hole is 0.6 thick"},
        Row{"ligament-24", true, 0, "The ligament beside the hole is 0.6 thick"},
        Row{"ligament-96", true, 0, "The ligament beside the hole is 0.6 thick"},
        Row{"flat-thread", false, 0, "The crests are 0.9 thick"},
        Row{"sharp-thread", false, 0, "The teeth are edges of 45 degrees; the tube is 3 thick"}}) {
    KnownPart& part = parts.emplace_back(KnownPart{.name = fmt::format("wall-{}", name),
                                                   .category = "walls",
                                                   .mesh = makeThicknessPart(name).solid.surface(),
                                                   .answers = {}});
    part.answers.push_back(
        answerOfWall(kLimit, fails ? PartVerdict::Fail : PartVerdict::Pass, fmt::format("{}.", reason)));
    if (greater > 0) part.answers.push_back(answerOfWall(greater, PartVerdict::Fail, fmt::format("{}.", reason)));
  }
}

/// A rib of an L: the profile of two legs of the given thickness.
solids::Outline angle(double leg, double thickness) {
  return {{0, 0}, {leg, 0}, {leg, thickness}, {thickness, thickness}, {thickness, leg}, {0, leg}};
}

/// Bodies that are thin as a whole, whose faces have no other face opposite.
void addThinBodies(std::vector<KnownPart>& parts) {
  const auto add = [&](std::string name, Mesh mesh, double section, const std::string& what) {
    std::vector<KnownAnswer> answers = answersAround(section, {}, what);
    answers[0].limit = 0.95 * section;
    answers[1].limit = 1.05 * section;
    for (KnownAnswer& answer : answers)
      answer.reason = fmt::format("The greatest ball inside of the {} has the diameter {:.6g}.", what, section);
    parts.push_back({std::move(name), "walls", std::move(mesh), std::move(answers)});
  };
  // The edge of the triangle is 1, and that of the tetrahedron 4.
  add("thin-body-triangular-rod", solids::extruded({{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}, 12), 1 / std::sqrt(3.0),
      "triangular rod");
  const double k = std::sqrt(2.0);
  add("thin-body-tetrahedron",
      {.vertices = {{k, k, k}, {-k, -k, k}, {-k, k, -k}, {k, -k, -k}},
       .faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
       .polygons = {}},
      4 / std::sqrt(6.0), "tetrahedron");
  add("thin-body-needle", solids::box({0, 0, 0}, {20, 0.5, 0.5}), 0.5, "needle");
}

}  // namespace

std::vector<KnownPart> wallParts() {
  std::vector<KnownPart> parts;
  addThicknessParts(parts);
  for (const double floor : {0.05, 0.2, 0.4, 0.79, 0.81, 2.0}) {
    const Place place{Vec3d{20, 15, 0}, Vec3d{20, 15, floor}};
    KnownPart& part = parts.emplace_back(KnownPart{.name = fmt::format("wall-floor-{:g}", floor),
                                                   .category = "walls",
                                                   .mesh = floorPlate(floor),
                                                   .answers = answersAround(floor, place, "The floor of the pocket")});
    part.answers.push_back({.limit = kLimit,
                            .verdict = floor < kLimit ? PartVerdict::Fail : PartVerdict::Pass,
                            .value = floor,
                            .place = place,
                            .reason = fmt::format("The floor of the pocket is {:g} thick.", floor)});
  }
  // An STL file holds float32 numbers, so 0.8 may be read as 0.79999995; below 0.999 of the limit counts.
  parts.push_back({"wall-floor-at-the-limit",
                   "walls",
                   floorPlate(0.79992),
                   {answerOfWall(kLimit, PartVerdict::Pass, "The floor is 0.79992 thick; below 0.7992 counts.")},
                   "stl"});
  const auto add = [&](std::string name, Mesh mesh, double thickness, const std::optional<Place>& place,
                       const std::string& what, std::string_view extension = "ply") {
    parts.push_back({std::move(name), "walls", std::move(mesh), answersAround(thickness, place, what), extension});
  };
  add("wall-plate", solids::box({0, 0, 0}, {30, 20, 0.7}), 0.7, Place{Vec3d{15, 10, 0}, Vec3d{15, 10, 0.7}},
      "The plate", "stl");
  add("wall-plate-turned", solids::turned(solids::box({0, 0, 0}, {30, 20, 0.7}), 0.5, 1.1), 0.7, {}, "The plate");
  add("wall-plate-inches", solids::scaled(solids::box({0, 0, 0}, {30, 20, 0.7}), 1 / 25.4), 0.7 / 25.4, {}, "The plate",
      "obj");
  add("wall-plate-refined", solids::refined(solids::box({0, 0, 0}, {30, 20, 0.7}), 2), 0.7, {}, "The plate");
  add("wall-sheet", solids::box({0, 0, 0}, {3000, 1500, 0.5}), 0.5, Place{Vec3d{1500, 750, 0}, Vec3d{1500, 750, 0.5}},
      "The sheet");
  add("wall-rod", solids::box({0, 0, 0}, {20000, 1, 1}), 1, {}, "The rod", "off");
  add("wall-angle", solids::extruded(angle(12, 0.9), 15), 0.9, Place{Vec3d{6, 0, 7}, Vec3d{6, 0.9, 7}},
      "Each leg of the angle");
  add("wall-rib-cut-at-45-degrees",
      solids::extruded({{-8, -4}, {8, -4}, {8, 0}, {0.2, 0}, {0.2, 9.8}, {-0.2, 10.2}, {-0.2, 0}, {-8, 0}}, 6), 0.4,
      Place{Vec3d{-0.2, 5, 3}, Vec3d{0.2, 5, 3}}, "The rib, whose top is an edge of 45 degrees,");
  add("wall-hollow-box",
      solids::joined(
          {solids::box({0, 0, 0}, {20, 20, 20}), solids::inverted(solids::box({0.6, 0.6, 0.6}, {19.4, 19.4, 19.4}))}),
      0.6, Place{Vec3d{10, 10, 0}, Vec3d{10, 10, 0.6}}, "The wall around the cavity");
  for (const uint32_t sideCount : {6u, 48u}) {
    // The sides of the two polygons are parallel, at the difference of the apothems.
    const double wall = 0.5 * std::cos(std::numbers::pi / sideCount);
    add(fmt::format("wall-tube-{}", sideCount), solids::tube(sideCount, 6, 6, 6.5, 0, 12), wall, {},
        "The wall of the tube");
  }
  std::vector<Mesh> stack;
  for (int i = 0; i < 9; ++i) stack.push_back(solids::box({0, 0, 3.0 * i}, {20, 20, 3.0 * i + 0.5}));
  add("wall-nine-plates", solids::joined(stack), 0.5, {}, "Each of the nine plates");
  // A crumb that lies beside a sound body.
  parts.push_back({"wall-crumb", "walls",
                   solids::joined({solids::box({0, 0, 0}, {10, 10, 10}), solids::box({12, 0, 0}, {12.3, 0.3, 0.3})}),
                   answersAround(0.3, {}, "The crumb beside the box")});
  addThinBodies(parts);
  return parts;
}

}  // namespace asdfvk
