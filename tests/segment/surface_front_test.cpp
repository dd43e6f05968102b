#include "segment/surface_front.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/random.h"

using namespace asdfvk;

namespace {

using Arc = PartSurface::Arc;

/// A random graph with arcs in both directions.
struct Graph {
  std::vector<uint32_t> offsets{0};
  std::vector<Arc> arcs;
};

Graph randomGraph(uint32_t count, double lengthExponent) {
  Random random(5);
  std::vector<std::vector<Arc>> rows(count);
  for (uint32_t i = 1; i < count; ++i)
    for (int edge = 0; edge < 2; ++edge) {
      const auto j = static_cast<uint32_t>(random.real() * i);
      const auto length = static_cast<float>(std::pow(random.real(), lengthExponent));
      rows[i].push_back({j, length});
      rows[j].push_back({i, length});
    }
  Graph graph;
  for (const std::vector<Arc>& row : rows) {
    graph.arcs.insert(graph.arcs.end(), row.begin(), row.end());
    graph.offsets.push_back(static_cast<uint32_t>(graph.arcs.size()));
  }
  return graph;
}

/// Bellman and Ford's algorithm.
std::vector<float> plainDistances(const Graph& graph, std::vector<float> distances, uint32_t closedFace) {
  for (bool changes = true; changes;) {
    changes = false;
    for (uint32_t face = 0; face + 1 < graph.offsets.size(); ++face)
      for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
        const auto& [other, length] = graph.arcs[arc];
        if (other == closedFace || !(distances[face] + length < distances[other])) continue;
        distances[other] = distances[face] + length;
        changes = true;
      }
  }
  return distances;
}

std::vector<float> copyOf(std::span<const float> distances) { return {distances.begin(), distances.end()}; }

}  // namespace

TEST_CASE("distances are those of a plain algorithm, also where lengths differ by orders of magnitude") {
  for (const double exponent : {0.5, 1.0, 8.0, 40.0}) {
    CAPTURE(exponent);
    const Graph graph = randomGraph(300, exponent);
    SurfaceFront front(graph.offsets, graph.arcs);
    std::vector<float> sources(300, SurfaceFront::kUnreached);
    for (const uint32_t source : {7u, 100u, 211u}) {  // One after another: the earlier distances decrease.
      sources[source] = source == 100 ? 0.25f : 0;
      front.add(source, sources[source], source);
      front.advance();
      CHECK(copyOf(front.distances()) == plainDistances(graph, sources, 1000));
    }
    CHECK(front.labels()[7] == 7);
    CHECK(front.reached().size() == 300);
    front.clear();
    CHECK(front.distances()[7] == SurfaceFront::kUnreached);
    CHECK(front.reached().empty());
  }
}

TEST_CASE("a limit and closed faces end the front") {
  const Graph graph = randomGraph(200, 1);
  SurfaceFront front(graph.offsets, graph.arcs);
  std::vector<float> sources(200, SurfaceFront::kUnreached);
  sources[0] = 0;
  front.add(0, 0, 0);
  front.advance(0.5f, [](uint32_t face) { return face != 20; });
  std::vector<float> expected = plainDistances(graph, sources, 20);
  for (float& distance : expected)
    if (distance > 0.5f) distance = SurfaceFront::kUnreached;
  CHECK(copyOf(front.distances()) == expected);
  CHECK(front.distances()[20] == SurfaceFront::kUnreached);
}

TEST_CASE("no arcs, and arcs of no length") {
  const std::vector<uint32_t> noArcs{0, 0, 0};
  SurfaceFront lonely(noArcs, {});
  lonely.add(1, 0, 3);
  lonely.advance();
  CHECK(lonely.labels()[1] == 3);
  CHECK(lonely.distances()[0] == SurfaceFront::kUnreached);
  const std::vector<Arc> arcs{{1, 0}, {0, 0}};
  const std::vector<uint32_t> offsets{0, 1, 2};
  SurfaceFront flat(offsets, arcs);
  flat.add(0, 0, 1);
  flat.advance();
  CHECK(flat.distances()[1] == 0);
}
