#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generate/corpus.h"
#include "generate/solids.h"

// Shapes on both sides of the thresholds of the rule for walls (docs/thickness.md). Outlines are in units of the limit.
// The rule: p is a wall if the surface around p is thin out to 1/3, and nowhere out to 3/8 thinner than 7/8 of the
// thickness T at p.
//   wedge of the angle a: T(s) = 2 s tan(a / 2) at the distance s from its edge. T(s - 3/8) >= 7/8 T(s) from s = 3 on.
//     T(3 + 1/3) < 1 if tan(a / 2) < 0.15: below 17 degrees.
//   rib of the height h: 1/3 from its top and 1/3 from its foot: h >= 2/3.
//   ligament t between round notches of radius R = 2: T at the angle f is 2 ((R + t / 2) / cos f - R). At f = 1/3 / R,
//     it is below 1 if t < 0.93.
//   run-out of radius R into a plane: T(x) = x^2 / (2 R). T(x - 3/8) >= 7/8 T(x) from x = 5.8 on. T(5.8 + 1/3) < 1 if
//     R > 18.9.

namespace asdfvk {
namespace {

using solids::arc;
using solids::Outline;

constexpr double kRuleLimit = 0.8, kRadiansOfDegree = std::numbers::pi / 180;

/// A wedge of 10 length that ends in an edge, or in a side of thickness `cut`.
Outline wedgeOutline(double degrees, double cut) {
  const double slope = std::tan(degrees / 2 * kRadiansOfDegree), height = 10 * slope, begin = cut / 2 / slope;
  if (cut == 0) return {{0, 0}, {10, -height}, {10, height}};
  return {{begin, -cut / 2}, {10, -height}, {10, height}, {begin, cut / 2}};
}

/// A plate with ribs, 0.5 thick and 1.5 apart.
Outline ribOutline(double height, int count) {
  Outline outline{{-8, -4}, {8, -4}, {8, 0}};
  for (int i = count; i-- > 0;) {
    const double x = 2.0 * i - (count - 1);
    outline.insert(outline.end(), {{x + 0.25, 0}, {x + 0.25, height}, {x - 0.25, height}, {x - 0.25, 0}});
  }
  outline.emplace_back(-8, 0);
  return outline;
}

/// A body on whose flat bottom a fillet runs out tangentially.
Outline runOutOutline(double radius) {
  Outline outline = arc(0, radius, radius, -90, -26, 96);
  const double x = outline.back().first;
  outline.insert(outline.end(), {{x, 3 * radius}, {8 + radius, 3 * radius}, {8 + radius, 0}});
  return outline;
}

/// A plate with round notches of radius 2 in two opposite sides, and a ligament between them.
Outline notchOutline(double ligament) {
  const double y = 2 + ligament / 2;
  Outline outline = arc(0, -y, 2, 180, 0, 48);
  const Outline upper = arc(0, y, 2, 0, -180, 48);
  outline.insert(outline.end(), {{10, -y}, {10, y}});
  outline.insert(outline.end(), upper.begin(), upper.end());
  outline.insert(outline.end(), {{-10, y}, {-10, -y}});
  return outline;
}

/// A plate, 4 thick, whose sides are cut at this angle from the bottom to an edge at the top.
Outline chamferOutline(double degrees) {
  const double run = 4 / std::tan(degrees * kRadiansOfDegree);
  return {{run, 0}, {run + 10, 0}, {2 * run + 10, 4}, {0, 4}};
}

KnownPart edgePart(std::string name, const Mesh& mesh, bool isWall, std::string reason) {
  return {
      std::move(name),
      "edges",
      solids::scaled(mesh, kRuleLimit),
      {{.limit = kRuleLimit, .verdict = isWall ? PartVerdict::Fail : PartVerdict::Pass, .reason = std::move(reason)}}};
}

void addOutlines(std::vector<KnownPart>& parts) {
  const auto add = [&](std::string name, const Outline& outline, bool isWall, std::string reason) {
    parts.push_back(edgePart(std::move(name), solids::extruded(outline, 6), isWall, std::move(reason)));
  };
  for (const double degrees : {8.0, 12.0, 16.0, 18.0, 25.0, 45.0}) {
    add(fmt::format("edge-wedge-{:g}", degrees), wedgeOutline(degrees, 0), degrees < 17,
        fmt::format("A wedge of {:g} degrees; below 17 degrees counts.", degrees));
    if (degrees > 8 && degrees < 45)
      add(fmt::format("edge-cut-wedge-{:g}", degrees), wedgeOutline(degrees, 0.125), degrees < 17,
          fmt::format("A wedge of {:g} degrees, cut off 0.1 thick; below 17 degrees counts.", degrees));
  }
  for (const double height : {0.3, 0.5, 0.62, 0.72, 1.0, 3.0})
    add(fmt::format("edge-rib-{:g}", height), ribOutline(height, 1), height > 0.66,
        fmt::format("A rib 0.4 thick and {:g} high; from 0.533 on counts.", height * kRuleLimit));
  add("edge-letters", ribOutline(0.35, 5), false, "Raised bars, 0.4 thick and 0.28 high, are details.");
  for (const double ligament : {0.7, 0.85, 0.98})
    add(fmt::format("edge-ligament-{:g}", ligament), notchOutline(ligament), ligament < 0.93,
        fmt::format("A ligament of {:g} between notches of radius 1.6; up to 0.74 counts.", ligament * kRuleLimit));
  for (const double radius : {4.0, 16.0, 24.0, 40.0})
    add(fmt::format("edge-run-out-{:g}", radius), runOutOutline(radius), radius > 20,
        fmt::format("A fillet of radius {:g} runs out into a plane; from about 15.5 on counts.", radius * kRuleLimit));
  for (const double degrees : {12.0, 30.0, 45.0})
    add(fmt::format("edge-chamfer-{:g}", degrees), chamferOutline(degrees), degrees < 17,
        fmt::format("The sides are cut at {:g} degrees to an edge; below 17 degrees counts.", degrees));
}

}  // namespace

std::vector<KnownPart> edgeParts() {
  std::vector<KnownPart> parts;
  addOutlines(parts);
  // The thickness of a cone is that of a wedge of the same angle.
  for (const double degrees : {12.0, 22.0, 60.0}) {
    const double radius = 20 * std::tan(degrees / 2 * kRadiansOfDegree);
    parts.push_back(edgePart(fmt::format("edge-cone-{:g}", degrees), solids::cone(48, radius, 20), degrees < 17,
                             fmt::format("The tip of a cone of {:g} degrees; below 17 degrees counts.", degrees)));
  }
  parts.push_back(edgePart("edge-countersink", solids::tube(48, 2, 6, 12, 0, 4), false,
                           "A countersink of 45 degrees goes through the plate to an edge of 45 degrees."));
  for (const bool isWall : {false, true}) {
    const char* const name = isWall ? "16" : "18";
    const Mesh wedge = solids::extruded(wedgeOutline(isWall ? 16 : 18, 0), 6);
    const std::string reason = fmt::format("A wedge of {} degrees; below 17 degrees counts.", name);
    parts.push_back(
        edgePart(fmt::format("edge-wedge-{}-turned", name), solids::turned(wedge, 0.5, 1.1), isWall, reason));
    parts.push_back(edgePart(fmt::format("edge-wedge-{}-refined", name), solids::refined(wedge, 1), isWall, reason));
  }
  return parts;
}

}  // namespace asdfvk
