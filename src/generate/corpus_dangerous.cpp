#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generate/corpus.h"
#include "generate/solids.h"

namespace asdfvk {

std::vector<KnownPart> dangerousParts() {
  using solids::box;
  using solids::inverted;
  using solids::joined;
  const Mesh block = box({0, 0, 0}, {10, 10, 10}), plate = box({0, 0, 0}, {10, 10, 1});
  std::vector<KnownPart> parts;
  const auto add = [&](const std::string& name, Mesh mesh, double limit, PartVerdict verdict, std::string reason,
                       std::optional<double> value = {}, std::string_view extension = "ply") {
    parts.push_back({"danger-" + name,
                     "dangerous",
                     std::move(mesh),
                     {{.limit = limit, .verdict = verdict, .value = value, .reason = std::move(reason)}},
                     extension});
  };
  const Mesh sheet{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}, {}};
  add("sheet-beside", joined({block, solids::moved(sheet, {20, 0, 0})}), 0.5, PartVerdict::Fail,
      "A sheet of two sides at no distance lies beside the block.", 0);
  add("two-sheets", joined({block, solids::moved(sheet, {20, 0, 5}), solids::moved(sheet, {20, 0, 0})}), 0.5,
      PartVerdict::Fail, "Two sheets without thickness lie beside the block.", 0, "stl");
  const auto withRib = [](double width) {
    Mesh mesh = solids::extruded({{-8, -4}, {8, -4}, {8, 0}, {0.5, 0}, {0.5, 5}, {-0.5, 5}, {-0.5, 0}, {-8, 0}}, 12);
    for (Vec3d& p : mesh.vertices)
      if (std::abs(p.x) < 1) p.x *= width;
    return mesh;
  };
  add("fin", withRib(0), 0.5, PartVerdict::Fail, "A fin without thickness, 5 high, stands on the plate.", 0);
  add("fin-1e-6", withRib(1e-6), 0.5, PartVerdict::Fail, "A fin 1e-6 thick, 5 high, stands on the plate.");
  add("fin-1e-4", withRib(1e-4), 0.5, PartVerdict::Fail, "A fin 1e-4 thick, 5 high, stands on the plate.", 1e-4);
  add("fin-0.05", withRib(0.05), 0.5, PartVerdict::Fail, "A fin 0.05 thick, 5 high, stands on the plate.", 0.05);
  add("slab-1e-4", box({0, 0, 0}, {20, 20, 1e-4}), 0.5, PartVerdict::Fail, "A slab 1e-4 thick.", 1e-4);
  add("coarse-coordinates", solids::moved(box({0, 0, 0}, {40, 40, 10}), {3e6, 3e6, 0}), 0.8, PartVerdict::NotJudged,
      "The coordinates have steps of 0.25, more than a quarter of the limit.", {}, "stl");
  const Mesh open = solids::without(block, 10, 2);
  add("open-box", open, 0.5, PartVerdict::NotJudged, "A side is missing.");
  add("open-box-stl", open, 0.5, PartVerdict::NotJudged, "A side is missing.", {}, "stl");
  add("open-plate", solids::without(plate, 0, 2), 0.5, PartVerdict::NotJudged, "A side is missing.");
  add("open-plate-thin", solids::without(plate, 0, 2), 1.1, PartVerdict::Fail,
      "A side is missing, but bottom and top are 1 apart.", 1);
  add("one-face-missing", solids::without(solids::refined(plate, 3), 17, 1), 0.5, PartVerdict::NotJudged,
      "A face is missing.");
  add("open-beside-sound", joined({plate, solids::moved(open, {20, 0, 0})}), 0.5, PartVerdict::NotJudged,
      "The second body has no top.");
  add("inverted", inverted(plate), 0.5, PartVerdict::NotJudged, "All faces are wound inwards.");
  add("inverted-open", inverted(open), 0.5, PartVerdict::NotJudged,
      "A side is missing, and all faces are wound inwards.");
  add("inverted-beside-sound", joined({plate, inverted(box({20, 0, 0}, {30, 10, 1}))}), 0.5, PartVerdict::NotJudged,
      "The second body is wound inwards.");
  Mesh turnedFace = plate;
  std::swap(turnedFace.faces[7][0], turnedFace.faces[7][1]);
  add("one-turned-face", turnedFace, 0.5, PartVerdict::NotJudged, "A face is wound against its neighbours.");
  add("one-turned-face-stl", turnedFace, 0.5, PartVerdict::NotJudged, "A face is wound against its neighbours.", {},
      "stl");
  Mesh turnedAll = inverted(turnedFace);
  add("all-but-one-turned", std::move(turnedAll), 0.5, PartVerdict::NotJudged, "All faces but one are wound inwards.");
  add("double-sided", joined({plate, inverted(plate)}), 0.5, PartVerdict::NotJudged,
      "Each face has a reversed copy, so there is no material.");
  add("double-sided-ball", joined({solids::ball({0, 0, 0}, 5, 320), inverted(solids::ball({0, 0, 0}, 5, 320))}), 0.5,
      PartVerdict::NotJudged, "Each face has a reversed copy, so there is no material.", {}, "stl");
  add("common-side-once", solids::welded(joined({plate, solids::without(box({10, 0, 0}, {20, 10, 1}), 0, 2)})), 0.5,
      PartVerdict::NotJudged, "The side between two plates is there once, so its edges have three faces.");
  // The outline crosses itself in the middle of the bow tie, where the caps have a vertex.
  add("bow-tie",
      {{{0, 0, 0},
        {9, 4, 0},
        {9, 0, 0},
        {0, 4, 0},
        {0, 0, 4},
        {9, 4, 4},
        {9, 0, 4},
        {0, 4, 4},
        {4.5, 2, 0},
        {4.5, 2, 4}},
       {{3, 8, 0},
        {8, 2, 1},
        {7, 4, 9},
        {9, 5, 6},
        {0, 1, 5},
        {0, 5, 4},
        {1, 2, 6},
        {1, 6, 5},
        {2, 3, 7},
        {2, 7, 6},
        {3, 0, 4},
        {3, 4, 7}},
       {}},
      0.5, PartVerdict::NotJudged, "Half of the bow tie is wound backwards.");
  Mesh undefined = plate;
  undefined.vertices[7].z = kNoValue;
  add("undefined-vertex", undefined, 0.5, PartVerdict::NotJudged,
      "A corner is not a number, so its faces are missing.");
  add("inverted-shell", joined({block, inverted(box({-1, -1, -1}, {11, 11, 11}))}), 0.5, PartVerdict::NotJudged,
      "The shell around the block is wound inwards.");
  return parts;
}

}  // namespace asdfvk
