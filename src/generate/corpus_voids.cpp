#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generate/block_solid.h"
#include "generate/corpus.h"
#include "generate/solids.h"

namespace asdfvk {
namespace {

using solids::box;
using solids::inverted;
using solids::joined;

KnownPart partWithVoids(std::string name, Mesh mesh, double volume, std::string reason,
                        std::string_view extension = "ply") {
  return {std::move(name),
          "voids",
          std::move(mesh),
          {{.check = PartCheck::Voids,
            .verdict = volume > 0 ? PartVerdict::Fail : PartVerdict::Pass,
            .value = volume > 0 ? std::optional(volume) : std::nullopt,
            .reason = std::move(reason)}},
          extension};
}

/// Six plates around a space of 8 x 8 x (8 - overlap). lift: shift of the first plate away from the others.
Mesh platesAround(double overlap, double lift) {
  const double h = overlap / 2;
  return joined({box({0, 0, -lift}, {10, 10, 1 + h - lift}), box({0, 0, 9 - h}, {10, 10, 10}),
                 box({0, 0, 1}, {10, 1, 9}), box({0, 9, 1}, {10, 10, 9}), box({0, 1, 1}, {1, 9, 9}),
                 box({9, 1, 1}, {10, 9, 9})});
}

/// A box of 10 x 10 x 10 with a cavity of 4 x 4 x 4, and a channel of this width from the cavity to the top.
Mesh vented(double channel) {
  const double low = 5 - channel / 2, high = 5 + channel / 2;
  BlockSolid solid;
  addDraftedLattice(solid, {{0}, {3}, {low}, {high}, {7}, {10}}, {{0}, {3}, {low}, {high}, {7}, {10}}, {0, 3, 7, 10},
                    [](uint32_t i, uint32_t j, uint32_t k) {
                      const bool isInCavity = k == 1 && i >= 1 && i <= 3 && j >= 1 && j <= 3;
                      return !isInCavity && !(k == 2 && i == 2 && j == 2);
                    });
  return solid.surface();
}

KnownPart thickPart(std::string name, Mesh mesh, double greatest, const std::string& reason,
                    std::string_view extension = "ply") {
  const auto answer = [&](double factor, PartVerdict verdict) {
    return KnownAnswer{.check = PartCheck::Thicker,
                       .limit = factor * greatest,
                       .verdict = verdict,
                       .value = greatest,
                       .reason = fmt::format("{} The greatest ball has the diameter {:.6g}.", reason, greatest)};
  };
  return {std::move(name),
          "thick",
          std::move(mesh),
          {answer(0.97, PartVerdict::Fail), answer(1.03, PartVerdict::Pass)},
          extension};
}

}  // namespace

std::vector<KnownPart> voidParts() {
  const Mesh block = box({0, 0, 0}, {10, 10, 10}), cavity = inverted(box({3, 3, 3}, {7, 7, 7}));
  std::vector<KnownPart> parts;
  const auto add = [&](std::string name, Mesh mesh, double volume, std::string reason,
                       std::string_view extension = "ply") {
    parts.push_back(partWithVoids(std::move(name), std::move(mesh), volume, std::move(reason), extension));
  };
  add("void-none", block, 0, "A solid box.");
  add("void-cavity", joined({block, cavity}), 64, "A cavity of 4 x 4 x 4.", "stl");
  add("void-cavity-turned", solids::turned(joined({block, cavity}), 0.5, 1.1), 64, "A cavity of 4 x 4 x 4.");
  add("void-two-cavities", joined({block, inverted(box({1, 1, 1}, {3, 3, 3})), inverted(box({5, 5, 5}, {9, 9, 9}))}),
      72, "Cavities of 2 x 2 x 2 and of 4 x 4 x 4.");
  for (const double channel : {2.0, 0.01})
    add(fmt::format("void-vented-{:g}", channel), vented(channel), 0,
        fmt::format("A channel of the width {:g} leads from the cavity to the outside.", channel));
  add("void-loose-box", joined({block, cavity, box({4, 4, 4}, {6, 6, 6})}), 56,
      "A cavity of 4 x 4 x 4 with a loose box of 2 x 2 x 2 inside.");
  add("void-filled", joined({block, cavity, box({3, 3, 3}, {7, 7, 7})}), 0, "Another body fills the cavity.");
  add("void-nested",
      joined({box({-10, -10, -10}, {10, 10, 10}), inverted(box({-8, -8, -8}, {8, 8, 8})), box({-5, -5, -5}, {5, 5, 5}),
              inverted(box({-3, -3, -3}, {3, 3, 3}))}),
      16 * 16 * 16 - 1000 + 216, "A hollow box lies in the cavity of another one.");
  add("void-plates", platesAround(0, 0), 512, "Six plates touch each other around a space of 8 x 8 x 8.");
  add("void-plates-overlapping", platesAround(1, 0), 448, "Six plates overlap around a space of 8 x 8 x 7.", "off");
  add("void-plates-apart", platesAround(0, 0.1), 0, "One of the six plates is 0.1 away from the others.");
  add("void-tube", solids::tube(24, 3, 3, 5, 0, 10), 0, "A tube is open at both ends.");
  add("void-tube-with-lids",
      joined({solids::tube(24, 3, 3, 5, 0, 10), box({-6, -6, -1}, {6, 6, 0}), box({-6, -6, 10}, {6, 6, 11})}),
      10 * 24 / 2.0 * 9 * std::sin(2 * std::numbers::pi / 24), "Plates close both ends of a tube.");
  add("void-tube-with-one-lid", joined({solids::tube(24, 3, 3, 5, 0, 10), box({-6, -6, -1}, {6, 6, 0})}), 0,
      "A plate closes only one end of a tube.");
  add("void-small-bubble", joined({block, inverted(box({5, 5, 5}, {5.02, 5.02, 5.02}))}), 8e-6,
      "A bubble of 0.02 x 0.02 x 0.02.");
  parts.push_back({"void-open-cavity",
                   "voids",
                   joined({block, solids::without(cavity, 10, 2)}),
                   {{.check = PartCheck::Voids,
                     .verdict = PartVerdict::NotJudged,
                     .reason = "A side of the cavity is missing, so the space has no boundary there."}}});
  return parts;
}

std::vector<KnownPart> thickParts() {
  const double root = std::sqrt(2.0);
  std::vector<KnownPart> parts{
      thickPart("thick-cube", box({0, 0, 0}, {10, 10, 10}), 10, "A cube of 10 x 10 x 10."),
      thickPart("thick-plate", box({0, 0, 0}, {30, 20, 3}), 3, "A plate of 30 x 20 x 3.", "stl"),
      thickPart("thick-prism", solids::regularPrism(12, 4, 0, 20), 8 * std::cos(std::numbers::pi / 12),
                "A prism over a polygon of 12 corners at the radius 4."),
      thickPart("thick-two-bodies", joined({box({0, 0, 0}, {8, 8, 2}), box({10, 0, 0}, {14, 5, 5})}), 4,
                "Boxes of 8 x 8 x 2 and of 4 x 5 x 5."),
      // The ball touches the two outer walls and the inner edge: r = sqrt(2) (t - r).
      thickPart("thick-angle", solids::extruded({{0, 0}, {12, 0}, {12, 2}, {2, 2}, {2, 12}, {0, 12}}, 15),
                2 * 2 * root / (1 + root), "An angle with legs 2 thick."),
      // The ball touches the wall and two inner edges: (t / 2)^2 + (t - r)^2 = r^2.
      thickPart("thick-tee",
                solids::extruded({{-10, 0}, {10, 0}, {10, 2}, {1, 2}, {1, 12}, {-1, 12}, {-1, 2}, {-10, 2}}, 15),
                1.25 * 2, "A rib 2 thick on a plate 2 thick."),
      // The ball touches the four inner edges.
      thickPart("thick-cross",
                solids::extruded({{-1, -9},
                                  {1, -9},
                                  {1, -1},
                                  {9, -1},
                                  {9, 1},
                                  {1, 1},
                                  {1, 9},
                                  {-1, 9},
                                  {-1, 1},
                                  {-9, 1},
                                  {-9, -1},
                                  {-1, -1}},
                                 15),
                2 * root, "Two plates 2 thick cross each other."),
      // The ball touches three outer walls and the corner of the cavity: r = sqrt(3) (t - r).
      thickPart("thick-hollow-box", joined({box({0, 0, 0}, {20, 20, 20}), inverted(box({2, 2, 2}, {18, 18, 18}))}),
                2 * 2 * std::sqrt(3.0) / (1 + std::sqrt(3.0)), "A hollow box with walls 2 thick.")};
  parts.push_back({"thick-open-box",
                   "thick",
                   solids::without(box({0, 0, 0}, {10, 10, 10}), 10, 2),
                   {{.check = PartCheck::Thicker,
                     .limit = 20,
                     .verdict = PartVerdict::NotJudged,
                     .reason = "A side of the box is missing, so its body has no boundary there."}}});
  return parts;
}

}  // namespace asdfvk
