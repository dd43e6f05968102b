#include <fmt/core.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generate/corpus.h"
#include "generate/solids.h"

namespace asdfvk {
namespace {

/// Adds a solid whose least wall is known, with answers on both sides.
class SoundParts {
 public:
  void add(const std::string& name, Mesh mesh, double least, const std::string& what,
           std::string_view extension = "ply", const std::optional<std::array<Vec3d, 2>>& place = {}) {
    const auto answer = [&](double factor, PartVerdict verdict) {
      return KnownAnswer{.limit = factor * least,
                         .verdict = verdict,
                         .value = least,
                         .place = place,
                         .reason = fmt::format("{} The least wall is {:.6g}.", what, least)};
    };
    parts_.push_back({"sound-" + name,
                      "sound",
                      std::move(mesh),
                      {answer(0.97, PartVerdict::Pass), answer(1.03, PartVerdict::Fail)},
                      extension});
  }
  std::vector<KnownPart> take() { return std::move(parts_); }

 private:
  std::vector<KnownPart> parts_;
};

/// Cubes of edge 1 at these cells, without the sides between neighbours, and with common vertices.
Mesh voxels(const std::vector<Vec3d>& cells) {
  std::vector<Mesh> cubes;
  cubes.reserve(cells.size());
  for (const Vec3d& cell : cells) cubes.push_back(solids::box(cell, cell + Vec3d{1, 1, 1}));
  return solids::welded(solids::joined(cubes));
}

/// A box whose top has two more vertices on its edges, which the sides do not have.
Mesh boxWithTJunctions(const Vec3d& size) {
  Mesh mesh = solids::without(solids::box({0, 0, 0}, size), 10, 2);
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{size.x / 2, 0, size.z}, {size.x / 2, size.y, size.z}});
  for (const Face& face :
       {Face{4, first, first + 1}, Face{4, first + 1, 6}, Face{first, 5, 7}, Face{first, 7, first + 1}})
    mesh.faces.push_back(face);
  return mesh;
}

/// The vertices of each face are moved by up to 2e-7 against those of other faces.
Mesh unequal(Mesh mesh) {
  mesh = solids::separated(mesh);
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    for (size_t axis = 0; axis < 3; ++axis) mesh.vertices[i][axis] += 1e-7 * (double((7 * i + 3 * axis) % 5) - 2);
  return mesh;
}

}  // namespace

std::vector<KnownPart> soundParts() {
  using solids::box;
  using solids::inverted;
  using solids::joined;
  const Mesh plate = box({0, 0, 0}, {10, 10, 1}), cube = box({0, 0, 0}, {10, 10, 10});
  const std::array middle{Vec3d{5, 5, 0}, Vec3d{5, 5, 1}};
  SoundParts parts;
  parts.add("plate", plate, 1, "A plate.", "ply", middle);
  parts.add("split-vertices", solids::separated(plate), 1, "Each face has its own vertices.", "ply", middle);
  parts.add("split-vertices-obj", solids::separated(plate), 1, "Each face has its own vertices.", "obj", middle);
  parts.add("unequal-vertices", unequal(plate), 1, "Each face has its own vertices, up to 4e-7 apart.");
  parts.add("t-junctions", boxWithTJunctions({10, 10, 1}), 1, "Vertices lie on edges of other faces.", "ply", middle);
  parts.add("t-junctions-turned", solids::turned(boxWithTJunctions({10, 10, 1}), 0.5, 1.1), 1,
            "Vertices lie on edges of other faces.");
  parts.add("touching-plates", joined({plate, box({10, 0, 0}, {20, 10, 1})}), 1, "Two plates have a side in common.",
            "ply", middle);
  parts.add("touching-plates-welded", solids::welded(joined({plate, box({10, 0, 0}, {20, 10, 1})})), 1,
            "Two plates have a side and its vertices in common.", "stl", middle);
  parts.add("stacked-plates", joined({plate, box({0, 0, 1}, {10, 10, 2})}), 2, "Two plates of 1 lie on each other.");
  parts.add("stacked-plates-offset", joined({plate, box({3, 3, 1}, {14, 14, 2.5})}), 1,
            "Two plates of 1 and 1.5 lie on each other in part.");
  parts.add("united-plates",
            solids::welded(joined({solids::without(plate, 2, 2), solids::without(box({10, 0, 0}, {20, 10, 1}), 0, 2)})),
            1, "Two plates without the side between them.", "ply", middle);
  parts.add("voxels-at-an-edge", voxels({{0, 0, 0}, {1, 1, 0}}), 1, "Two voxels have an edge in common.", "stl");
  parts.add("voxels-at-a-corner", voxels({{0, 0, 0}, {1, 1, 1}}), 1, "Two voxels have a corner in common.", "stl");
  parts.add("nested-shells", joined({cube, box({3, 3, 3}, {7, 7, 7})}), 10,
            "The inner box is wound outwards too, so it is inside of the material.");
  parts.add("nested-plate", joined({cube, box({3, 3, 3}, {7, 7, 3.5})}), 10, "A plate is inside of a cube.");
  parts.add("doubled-shell", joined({plate, plate}), 1, "The file has the plate twice.", "ply", middle);
  parts.add("doubled-shell-welded", solids::welded(joined({plate, plate})), 1, "The file has each face twice.", "stl",
            middle);
  parts.add("overlap", joined({plate, box({5, 5, 0.4}, {15, 15, 1.7})}), 1, "Two plates cross each other.");
  parts.add("coplanar-overlap", joined({plate, box({5, 2, 0}, {15, 8, 1})}), 1,
            "Two plates of the same height overlap, with bottom and top in common planes.");
  parts.add("label", joined({box({0, 0, 0}, {30, 20, 3}), box({10, 8, 2.7}, {20, 13, 3.6})}), 3,
            "A label is sunk into a plate of 3.");
  parts.add("label-on-top", joined({box({0, 0, 0}, {30, 20, 3}), box({10, 8, 3}, {20, 13, 3.6})}), 3,
            "A label lies on a plate of 3.");
  parts.add("cavity", joined({cube, inverted(box({2, 2, 2}, {8, 8, 8}))}), 2, "A cavity with walls of 2.");
  parts.add("body-in-cavity", joined({cube, inverted(box({2, 2, 2}, {8, 8, 8})), box({4, 4, 4}, {6, 6, 5.5})}), 1.5,
            "A plate of 1.5 lies in a cavity with walls of 2.");
  Mesh sheetOnTop = plate;
  sheetOnTop.faces.insert(sheetOnTop.faces.end(), {plate.faces[10], inverted(plate).faces[10]});
  parts.add("sheet-on-a-side", sheetOnTop, 1, "A face has a copy and its reverse on it.", "ply", middle);
  parts.add("sheet-in-material", joined({cube, {{{3, 3, 3}, {7, 3, 3}, {7, 7, 3}}, {{0, 1, 2}, {0, 2, 1}}, {}}}), 10,
            "A sheet of two sides is inside of a cube.");
  parts.add("unused-vertices", {[&] {
              Mesh mesh = plate;
              mesh.vertices.insert(mesh.vertices.end(), {{5, 5, 0.5}, {5, 5, 20}});
              return mesh;
            }()},
            1, "Two vertices belong to no face.", "ply", middle);
  parts.add("zero-area-faces", {[&] {
              Mesh mesh = plate;
              mesh.faces.insert(mesh.faces.end(), {{0, 0, 1}, {3, 3, 3}});
              return mesh;
            }()},
            1, "Two faces have no area.", "off", middle);
  return parts.take();
}

}  // namespace asdfvk
