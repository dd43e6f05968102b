#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generate/corpus.h"
#include "generate/solids.h"

namespace asdfvk {
namespace {

constexpr double kGapLimit = 0.5, kRadiansEachDegree = std::numbers::pi / 180;

KnownAnswer gapAnswer(double limit, bool fails, std::optional<double> value, std::string reason) {
  return {.check = PartCheck::Closer,
          .limit = limit,
          .verdict = fails ? PartVerdict::Fail : PartVerdict::Pass,
          .value = value,
          .reason = std::move(reason)};
}

/// Answers on both sides of a gap of constant width.
std::vector<KnownAnswer> gapAnswers(double width, const std::string& what,
                                    const std::optional<std::array<Vec3d, 2>>& place = {}) {
  std::vector<KnownAnswer> answers{
      gapAnswer(0.97 * width, false, width, fmt::format("{} is {:.6g} wide, more than the limit.", what, width)),
      gapAnswer(1.03 * width, true, width, fmt::format("{} is {:.6g} wide, less than the limit.", what, width))};
  for (KnownAnswer& answer : answers) answer.place = place;
  return answers;
}

/// A block, 10 wide and 6 high, with a slot in the middle of its top.
solids::Outline slotOutline(double width, double depth) {
  const double w = width / 2;
  return {{-5, -6}, {5, -6}, {5, 0}, {w, 0}, {w, -depth}, {-w, -depth}, {-w, 0}, {-5, 0}};
}

/// A block with a groove of this angle, 3 deep.
solids::Outline grooveOutline(double degrees) {
  const double w = 3 * std::tan(degrees / 2 * kRadiansEachDegree);
  return {{-8, -6}, {8, -6}, {8, 0}, {w, 0}, {0, -3}, {-w, 0}, {-8, 0}};
}

/// A plate, and above it another one that is turned around one edge, 0.02 above the first.
Mesh tiltedPlates(double degrees) {
  const double c = std::cos(degrees * kRadiansEachDegree), s = std::sin(degrees * kRadiansEachDegree);
  return solids::joined(
      {solids::box({0, -3, 0}, {10, 0, 6}),
       solids::extruded(
           {{0, 0.02}, {10 * c, 0.02 + 10 * s}, {10 * c - 3 * s, 0.02 + 10 * s + 3 * c}, {-3 * s, 0.02 + 3 * c}}, 6)});
}

/// A prism in a hole of the same number of sides.
Mesh pinInHole(uint32_t sideCount, double pinRadius, double shift) {
  return solids::joined({solids::tube(sideCount, 5, 5, 8, 0, 4),
                         solids::moved(solids::regularPrism(sideCount, pinRadius, -1, 5), {shift, 0, 0})});
}

void addSlots(std::vector<KnownPart>& parts) {
  for (const double width : {0.1, 0.3, 2.0})
    parts.push_back({fmt::format("gap-slot-{:g}", width), "gaps", solids::extruded(slotOutline(width, 4), 6),
                     gapAnswers(width, "The slot", std::array{Vec3d{-width / 2, -2, 3}, Vec3d{width / 2, -2, 3}})});
  parts.push_back({"gap-slot-turned", "gaps", solids::turned(solids::extruded(slotOutline(0.3, 4), 6), 0.5, 1.1),
                   gapAnswers(0.3, "The slot")});
  parts.push_back({"gap-slot-inches", "gaps", solids::scaled(solids::extruded(slotOutline(0.3, 4), 6), 1 / 25.4),
                   gapAnswers(0.3 / 25.4, "The slot"), "stl"});
  for (const double depth : {0.2, 0.3, 0.37, 0.8})
    parts.push_back({fmt::format("gap-slot-{:g}-deep", depth),
                     "gaps",
                     solids::extruded(slotOutline(0.3, depth), 6),
                     {gapAnswer(kGapLimit, depth > 0.34, 0.3,
                                fmt::format("A slot 0.3 wide and {:g} deep; from 0.333 on counts.", depth))}});
  for (const double degrees : {8.0, 15.5, 18.5, 30.0, 60.0}) {
    const Mesh groove = solids::extruded(grooveOutline(degrees), 6);
    const KnownAnswer answer =
        gapAnswer(0.25, degrees < 17, {}, fmt::format("A groove of {:g} degrees; below 17 degrees counts.", degrees));
    parts.push_back({fmt::format("gap-groove-{:g}", degrees), "gaps", groove, {answer}});
    if (degrees > 10 && degrees < 20)
      parts.push_back({fmt::format("gap-groove-{:g}-refined", degrees), "gaps", solids::refined(groove, 1), {answer}});
  }
}

void addClearances(std::vector<KnownPart>& parts) {
  for (const double width : {0.05, 0.4, 1.5})
    parts.push_back(
        {fmt::format("gap-boxes-{:g}", width), "gaps",
         solids::joined({solids::box({0, 0, 0}, {4, 4, 4}), solids::box({4 + width, 0, 0}, {9, 4, 4})}),
         gapAnswers(width, "The clearance of the boxes", std::array{Vec3d{4, 2, 2}, Vec3d{4 + width, 2, 2}})});
  for (const uint32_t sideCount : {12u, 64u}) {
    // The sides of pin and hole are parallel.
    const double clearance = 0.2 * std::cos(std::numbers::pi / sideCount);
    parts.push_back({fmt::format("gap-pin-{}", sideCount), "gaps", pinInHole(sideCount, 4.8, 0),
                     gapAnswers(clearance, "The clearance of the pin")});
    // The two sides at the first corner, +x, are the nearest ones.
    const double nearest = clearance - 0.1 * std::cos(std::numbers::pi / sideCount);
    parts.push_back({fmt::format("gap-eccentric-pin-{}", sideCount),
                     "gaps",
                     pinInHole(sideCount, 4.8, 0.1),
                     {gapAnswer(0.95 * nearest, false, nearest, "The pin is 0.1 beside the axis of its hole."),
                      gapAnswer(1.4 * nearest, true, nearest, "The pin is 0.1 beside the axis of its hole.")}});
  }
  std::vector<KnownAnswer> ofBore = gapAnswers(0.4 * std::cos(std::numbers::pi / 24), "The bore");
  for (KnownAnswer& answer : ofBore) answer.value.reset();  // At the ends of its flat faces balls are smaller.
  parts.push_back({"gap-tube", "gaps", solids::tube(24, 0.2, 0.2, 5, 0, 10), ofBore});
  for (const double degrees : {10.0, 15.5, 18.5, 25.0})
    parts.push_back(
        {fmt::format("gap-tilted-plates-{:g}", degrees),
         "gaps",
         tiltedPlates(degrees),
         {gapAnswer(0.25, degrees < 17, {},
                    fmt::format("The plates have an angle of {:g} degrees; below 17 degrees counts.", degrees))}});
  for (const double width : {0.24, 0.4, 2.0})
    parts.push_back(
        {fmt::format("gap-crossing-bars-{:g}", width),
         "gaps",
         solids::joined({solids::box({-5, -width / 2, 0}, {5, width / 2, 1}),
                         solids::box({-width / 2, -5, 1.15}, {width / 2, 5, 2.15})}),
         {gapAnswer(kGapLimit, width > 0.34, 0.15,
                    fmt::format("The bars are {:g} wide and 0.15 apart; from 0.333 wide on counts.", width))}});
  parts.push_back({"gap-balls",
                   "gaps",
                   solids::joined({solids::ball({0, 0, 0}, 5), solids::ball({10.2, 0, 0}, 5)}),
                   {gapAnswer(0.15, false, {}, "The balls are at least 0.2 apart."),
                    gapAnswer(0.5, true, {}, "The balls are 0.2 to 0.3 apart.")}});
  parts.push_back(
      {"gap-loose-box", "gaps",
       solids::joined({solids::box({0, 0, 0}, {10, 10, 10}), solids::inverted(solids::box({3, 3, 3}, {7, 7, 7})),
                       solids::box({3.2, 3.2, 3.2}, {6.8, 6.8, 6.8})}),
       gapAnswers(0.2, "The clearance around the loose box")});
  parts.push_back({"gap-bubble", "gaps",
                   solids::joined({solids::box({0, 0, 0}, {10, 10, 10}),
                                   solids::inverted(solids::box({4, 4, 4}, {4.3, 4.3, 4.3}))}),
                   gapAnswers(0.3, "The bubble")});
  std::vector<Mesh> comb{solids::box({0, 0, 0}, {10, 1, 5})};
  for (const double x : {0.0, 1.3, 2.6, 3.9}) comb.push_back(solids::box({x, 0.5, 0}, {x + 1, 4, 5}));
  parts.push_back(
      {"gap-comb", "gaps", solids::joined(comb), gapAnswers(0.3, "Each slot of the comb, a union of boxes,")});
}

void addContacts(std::vector<KnownPart>& parts) {
  const auto add = [&](std::string name, Mesh mesh, std::string reason, std::string_view extension = "ply") {
    parts.push_back(
        {std::move(name), "gaps", std::move(mesh), {gapAnswer(kGapLimit, false, {}, std::move(reason))}, extension});
  };
  add("gap-none", solids::box({0, 0, 0}, {4, 4, 4}), "A box has no gap.");
  add("gap-contact", solids::joined({solids::box({0, 0, 0}, {4, 4, 4}), solids::box({4, 0, 0}, {9, 4, 4})}),
      "The boxes touch; contact is no gap.", "stl");
  add("gap-contact-off-centre", solids::joined({solids::box({0, 0, 0}, {4, 4, 4}), solids::box({4, 1, 1}, {9, 7, 7})}),
      "The boxes touch; contact is no gap.");
  add("gap-overlap", solids::joined({solids::box({0, 0, 0}, {4, 4, 4}), solids::box({3.7, 1, 1}, {9, 3, 3})}),
      "The boxes overlap by 0.3, which is no gap.");
  add("gap-contact-at-an-edge", solids::joined({solids::box({0, 0, 0}, {4, 4, 4}), solids::box({4, 4, 0}, {8, 8, 4})}),
      "The boxes touch at an edge, in angles of 90 degrees.");
  parts.push_back(
      {"gap-beside-contact", "gaps",
       solids::joined({solids::box({0, -6, 0}, {10, 0, 2}),
                       solids::turned(solids::extruded({{0, 2}, {4, 2}, {4, 2.3}, {10, 2.3}, {10, 4}, {0, 4}}, 6), 0,
                                      std::numbers::pi / 2)}),
       gapAnswers(0.3, "The clearance beside the contact of two bodies")});
  parts.push_back({"gap-open-surface",
                   "gaps",
                   solids::without(solids::box({0, 0, 0}, {4, 4, 4}), 10, 2),
                   {{.check = PartCheck::Closer,
                     .limit = kGapLimit,
                     .verdict = PartVerdict::NotJudged,
                     .reason = "A side of the box is missing, so the space has no boundary there."}}});
}

}  // namespace

std::vector<KnownPart> gapParts() {
  std::vector<KnownPart> parts;
  addSlots(parts);
  addClearances(parts);
  addContacts(parts);
  return parts;
}

}  // namespace asdfvk
