#include "predict/seed_cells.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <set>

#include "generate/shapes.h"
#include "predict/seeded_mesh.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

constexpr uint32_t kFar = UINT32_MAX;
constexpr double kTie = 1 - 1e-7;  // Distances whose ratio is greater may count as equal; see comparableSquare().

std::vector<uint32_t> stepsFrom(const DualGraph& graph, uint32_t start) {
  std::vector<uint32_t> steps(graph.faceCount(), kFar);
  std::vector<uint32_t> front{start};
  steps[start] = 0;
  for (uint32_t step = 1; !front.empty(); ++step) {
    std::vector<uint32_t> next;
    for (const uint32_t face : front)
      for (const uint32_t neighbour : graph.neighboursOf(face))
        if (steps[neighbour] == kFar) {
          steps[neighbour] = step;
          next.push_back(neighbour);
        }
    front = std::move(next);
  }
  return steps;
}

std::vector<uint32_t> randomSeeds(uint32_t faceCount, size_t count, uint64_t randomSeed) {
  std::vector<uint32_t> faces(faceCount);
  for (uint32_t face = 0; face < faceCount; ++face) faces[face] = face;
  Random(randomSeed).shuffle(std::span(faces));
  faces.resize(count);
  return faces;
}

void checkCells(const DualGraph& graph, const std::vector<uint32_t>& seeds) {
  const SeedCells cells = buildSeedCells(graph, seeds);
  REQUIRE(cells.cellOf.size() == graph.faceCount());
  REQUIRE(cells.faces.bucketCount() == seeds.size());

  std::vector<uint32_t> nearest(graph.faceCount(), kFar), toOwnSeed(graph.faceCount(), kFar);
  for (uint32_t cell = 0; cell < seeds.size(); ++cell) {
    CHECK(cells.cellOf[seeds[cell]] == cell);
    const std::vector<uint32_t> steps = stepsFrom(graph, seeds[cell]);
    for (uint32_t face = 0; face < steps.size(); ++face) {
      nearest[face] = std::min(nearest[face], steps[face]);
      if (cells.cellOf[face] == cell) toOwnSeed[face] = steps[face];
    }
  }
  // Without a reachable seed both are kFar, and there is no cell.
  CHECK(toOwnSeed == nearest);
  for (uint32_t face = 0; face < nearest.size(); ++face)
    CHECK((cells.cellOf[face] == kNoCell) == (nearest[face] == kFar));

  std::vector<uint32_t> timesListed(graph.faceCount(), 0);
  std::set<std::pair<uint32_t, uint32_t>> touching;
  for (uint32_t cell = 0; cell < seeds.size(); ++cell) {
    CHECK(std::is_sorted(cells.faces[cell].begin(), cells.faces[cell].end()));
    for (const uint32_t face : cells.faces[cell]) {
      CHECK(cells.cellOf[face] == cell);
      ++timesListed[face];
      for (const uint32_t neighbour : graph.neighboursOf(face))
        if (cells.cellOf[neighbour] != cell) touching.emplace(cell, cells.cellOf[neighbour]);
    }
  }
  for (uint32_t face = 0; face < timesListed.size(); ++face)
    CHECK(timesListed[face] == (cells.cellOf[face] == kNoCell ? 0 : 1));

  const NearestCells touched(cells, graph, {.barycentres = UnsetVector<Vec3d>(graph.faceCount(), Vec3d{})}, seeds, 200);
  std::set<std::pair<uint32_t, uint32_t>> listed;
  size_t listedCount = 0;
  for (uint32_t cell = 0; cell < seeds.size(); ++cell)
    for (const uint32_t other : touched.of(cell).subspan(1)) {
      listed.emplace(cell, other);
      ++listedCount;
    }
  CHECK(listedCount == listed.size());  // No repeats.
  CHECK(listed == touching);
  for (const auto& [cell, other] : listed) CHECK(listed.contains({other, cell}));
}

}  // namespace

TEST_CASE("each face is in the cell of a nearest seed") {
  for (const size_t seedCount : {size_t{1}, size_t{2}, size_t{17}, size_t{160}}) {
    CAPTURE(seedCount);
    checkCells(buildDualGraph(makeTorus(900).mesh), randomSeeds(makeTorus(900).mesh.faceCount(), seedCount, seedCount));
  }
}

TEST_CASE("with every face a seed each cell is one face") {
  const DualGraph graph = buildDualGraph(makeSphere(180).mesh);
  checkCells(graph, randomSeeds(graph.faceCount(), graph.faceCount(), 3));
}

TEST_CASE("components without a seed and isolated faces have no cell") {
  Mesh mesh = shapes::joined(makeSphere(320).mesh, makeSphere(80).mesh, {5, 0, 0});
  const auto vertex = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3d& corner : {Vec3d{9, 0, 0}, Vec3d{10, 0, 0}, Vec3d{9, 1, 0}}) mesh.vertices.push_back(corner);
  mesh.faces.push_back({vertex, vertex + 1, vertex + 2});
  const DualGraph graph = buildDualGraph(mesh);
  const std::vector<uint32_t> seeds{7, 300, 20};
  checkCells(graph, seeds);
  const SeedCells cells = buildSeedCells(graph, seeds);
  CHECK(std::count(cells.cellOf.begin(), cells.cellOf.end(), kNoCell) == 80 + 1);

  const std::vector<uint32_t> alone{mesh.faceCount() - 1};
  checkCells(graph, alone);
  CHECK(buildSeedCells(graph, alone).faces[0].size() == 1);
}

TEST_CASE("without seeds there are no cells") {
  const DualGraph graph = buildDualGraph(makeSphere(80).mesh);
  const SeedCells cells = buildSeedCells(graph, {});
  CHECK(std::count(cells.cellOf.begin(), cells.cellOf.end(), kNoCell) == graph.faceCount());
  CHECK(cells.faces.bucketCount() == 0);
}

TEST_CASE("a seed marked with kNoFace has an empty cell and does not affect the other cells") {
  const DualGraph graph = buildDualGraph(makeTorus(900).mesh);
  const FaceGeometry geometry = computeFaceGeometry(makeTorus(900).mesh);
  std::vector<uint32_t> seeds = randomSeeds(graph.faceCount(), 60, 4), used;
  for (size_t i = 0; i < seeds.size(); ++i) {
    if (i % 7 == 3)
      seeds[i] = kNoFace;
    else
      used.push_back(seeds[i]);
  }
  const SeedCells all = buildSeedCells(graph, seeds), without = buildSeedCells(graph, used);
  const NearestCells nearest(all, graph, geometry, seeds, 6);
  for (uint32_t face = 0; face < graph.faceCount(); ++face)
    CHECK(seeds[all.cellOf[face]] == used[without.cellOf[face]]);
  for (uint32_t cell = 0; cell < seeds.size(); ++cell) {
    CHECK(all.faces[cell].empty() == (seeds[cell] == kNoFace));
    CHECK(nearest.of(cell).empty() == (seeds[cell] == kNoFace));
    for (const uint32_t other : nearest.of(cell)) CHECK(seeds[other] != kNoFace);
  }
}

TEST_CASE("the nearest cells are the cell itself, then its neighbours by the distance of their seeds") {
  const Mesh mesh = makeTorus(900).mesh;
  const DualGraph graph = buildDualGraph(mesh);
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  const std::vector<uint32_t> seeds = randomSeeds(mesh.faceCount(), 60, 5);
  const SeedCells cells = buildSeedCells(graph, seeds);
  const NearestCells allCells(cells, graph, geometry, seeds, 100);
  for (const size_t neighbourCount : {size_t{0}, size_t{1}, size_t{6}, size_t{1000}}) {
    const NearestCells nearestCells(cells, graph, geometry, seeds, neighbourCount);
    for (uint32_t cell = 0; cell < seeds.size(); ++cell) {
      const std::span<const uint32_t> nearest = nearestCells.of(cell);
      const std::span<const uint32_t> all = allCells.of(cell).subspan(1);
      REQUIRE(nearest.size() == 1 + std::min(neighbourCount, all.size()));
      CHECK(nearest[0] == cell);
      const auto distance = [&](uint32_t other) {
        return length(geometry.barycentres[seeds[other]] - geometry.barycentres[seeds[cell]]);
      };
      std::set<uint32_t> left(all.begin(), all.end());
      for (size_t i = 1; i < nearest.size(); ++i) {
        CHECK(left.erase(nearest[i]) == 1);
        if (i > 1) CHECK(distance(nearest[i]) >= kTie * distance(nearest[i - 1]));
      }
      for (const uint32_t other : left) CHECK(distance(other) >= kTie * distance(nearest.back()));
    }
  }
}

TEST_CASE("equally near cells have the same order in every unit") {
  const Mesh mesh = shapes::grid(40);
  const DualGraph graph = buildDualGraph(mesh);
  const std::vector<uint32_t> seeds = randomSeeds(mesh.faceCount(), 400, 3);
  const SeedCells cells = buildSeedCells(graph, seeds);
  const auto nearestIn = [&](double unit) {
    return NearestCells(cells, graph, computeFaceGeometry(shapes::scaledAndShifted(mesh, unit, {unit / 3, 0, 0})),
                        seeds, 5);
  };
  const NearestCells expected = nearestIn(1);
  for (const double unit : {0.001, 25.4, 1000.0, 1 + 1e-13}) {
    CAPTURE(unit);
    const NearestCells nearest = nearestIn(unit);
    for (uint32_t cell = 0; cell < seeds.size(); ++cell) CHECK(std::ranges::equal(nearest.of(cell), expected.of(cell)));
  }
}

TEST_CASE("cells do not depend on the number of threads") {
  const DualGraph graph = buildDualGraph(makeTorus(20'000).mesh);
  const std::vector<uint32_t> seeds = randomSeeds(graph.faceCount(), 900, 2);
  const SeedCells many = buildSeedCells(graph, seeds);
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const SeedCells one = buildSeedCells(graph, seeds);
  CHECK(many.cellOf == one.cellOf);
  CHECK(many.faces.entries == one.faces.entries);
}
