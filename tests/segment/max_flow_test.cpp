#include "segment/max_flow.h"

#include <doctest/doctest.h>

#include <bit>
#include <vector>

#include "core/random.h"
#include "plain_max_flow.h"
#include "sample_problems.h"

using namespace asdfvk;

namespace {

struct Edge {
  uint32_t a, b;
  double capacity, reverse;
};

struct Network {
  std::vector<double> terminals;
  std::vector<Edge> edges;
};

/// Whole numbers, so that every algorithm finds the same flow exactly; some capacities are 0.
Network randomNetwork(uint32_t nodeCount, uint32_t edgeCount, uint32_t maxCapacity, uint64_t seed) {
  Random random(seed);
  Network network;
  for (uint32_t node = 0; node < nodeCount; ++node)
    network.terminals.push_back(static_cast<double>(random.index(2 * maxCapacity + 1)) - maxCapacity);
  for (uint32_t edge = 0; edge < edgeCount; ++edge) {
    const uint32_t a = random.index(nodeCount), b = (a + 1 + random.index(nodeCount - 1)) % nodeCount;
    network.edges.push_back({a, b, double(random.index(maxCapacity)), double(random.index(maxCapacity))});
  }
  return network;
}

/// flows: the flow of each edge with which the search begins.
double solve(MaxFlow& flow, const Network& network, const std::vector<double>& flows = {}) {
  flow.reset(static_cast<uint32_t>(network.terminals.size()));
  for (uint32_t node = 0; node < network.terminals.size(); ++node) flow.addTerminal(node, network.terminals[node]);
  for (size_t i = 0; i < network.edges.size(); ++i) {
    const Edge& edge = network.edges[i];
    flow.addEdge(edge.a, edge.b, edge.capacity, edge.reverse, flows.empty() ? 0 : flows[i]);
  }
  return flow.solve();
}

struct Cut {
  double value;
  uint32_t sources;  ///< A bit per node; of the least cuts the one with the fewest nodes.
};

Cut leastCut(const Network& network) {
  Cut best{std::numeric_limits<double>::infinity(), 0};
  for (uint32_t sources = 0; sources < 1u << network.terminals.size(); ++sources) {
    const auto isSource = [&](uint32_t node) { return (sources >> node & 1) != 0; };
    double value = 0;
    for (uint32_t node = 0; node < network.terminals.size(); ++node)
      value += std::max(0.0, isSource(node) ? -network.terminals[node] : network.terminals[node]);
    for (const Edge& edge : network.edges)
      if (isSource(edge.a) != isSource(edge.b)) value += isSource(edge.a) ? edge.capacity : edge.reverse;
    if (value < best.value || (value == best.value && std::popcount(sources) < std::popcount(best.sources)))
      best = {value, sources};
  }
  return best;
}

}  // namespace

TEST_CASE("no nodes, no terminals and no edges have no flow") {
  MaxFlow flow;
  CHECK(solve(flow, {}) == 0);
  CHECK(solve(flow, {{0, 0}, {{0, 1, 5, 5}}}) == 0);
  CHECK_FALSE(flow.isSource(0));
  CHECK(solve(flow, {{3, -4}, {}}) == 0);
  CHECK(flow.isSource(0));
  CHECK_FALSE(flow.isSource(1));
}

TEST_CASE("a path carries its narrowest edge, and the cut is there") {
  MaxFlow flow;
  const Network path{{9, 0, 0, -9}, {{0, 1, 5, 0}, {1, 2, 2, 0}, {2, 3, 5, 0}}};
  CHECK(solve(flow, path) == 2);
  CHECK(flow.isSource(0));
  CHECK(flow.isSource(1));
  CHECK_FALSE(flow.isSource(2));
  CHECK_FALSE(flow.isSource(3));
}

TEST_CASE("nodes between equal cuts are not source") {
  MaxFlow flow;
  CHECK(solve(flow, {{2, 0, 0, -2}, {{0, 1, 2, 2}, {1, 2, 2, 2}, {2, 3, 2, 2}}}) == 2);
  for (uint32_t node = 0; node < 4; ++node) CHECK_FALSE(flow.isSource(node));
}

TEST_CASE("terminals of one node add up and cancel out") {
  MaxFlow flow;
  flow.reset(2);
  flow.addTerminal(0, 7);
  flow.addTerminal(0, -3);
  flow.addTerminal(1, -9);
  flow.addEdge(0, 1, 100, 0);
  CHECK(flow.solve() == 4);
}

TEST_CASE("small random networks: the flow is the least cut of all, with the fewest nodes on the source's side") {
  MaxFlow flow;  // Reused throughout.
  for (uint64_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    const uint32_t nodeCount = 2 + static_cast<uint32_t>(seed % 8);
    const Network network =
        randomNetwork(nodeCount, static_cast<uint32_t>(seed % 23), 1 + static_cast<uint32_t>(seed % 7), seed);
    const Cut cut = leastCut(network);
    REQUIRE(solve(flow, network) == cut.value);
    for (uint32_t node = 0; node < nodeCount; ++node) REQUIRE(flow.isSource(node) == ((cut.sources >> node & 1) != 0));
  }
}

TEST_CASE("large random networks: the flow and the cut of Dinic's algorithm") {
  MaxFlow flow;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    const uint32_t nodeCount = 50 + 40 * static_cast<uint32_t>(seed % 20);
    const Network network =
        randomNetwork(nodeCount, nodeCount * (1 + static_cast<uint32_t>(seed % 4)), seed % 2 == 0 ? 1000 : 3, seed);
    test::PlainMaxFlow plain(nodeCount);
    for (uint32_t node = 0; node < nodeCount; ++node)
      plain.addTerminal(node, std::max(0.0, network.terminals[node]), std::max(0.0, -network.terminals[node]));
    for (const Edge& edge : network.edges) plain.addEdge(edge.a, edge.b, edge.capacity, edge.reverse);
    REQUIRE(solve(flow, network) == plain.solve());
    for (uint32_t node = 0; node < nodeCount; ++node) REQUIRE(flow.isSource(node) == plain.isSource(node));
  }
}

TEST_CASE("a search that begins with the flow of another network has the same cut as a search without") {
  MaxFlow flow, plain;
  for (uint64_t seed = 0; seed < 41; ++seed) {
    CAPTURE(seed);
    const uint32_t nodeCount = seed == 40 ? 20'000 : 100 + 50 * static_cast<uint32_t>(seed % 7);
    const Network network = randomNetwork(nodeCount, 3 * nodeCount, seed % 2 == 0 ? 1000 : 3, seed);
    static_cast<void>(solve(flow, network));
    std::vector<double> flows(network.edges.size());
    for (size_t edge = 0; edge < flows.size(); ++edge) flows[edge] = network.edges[edge].capacity - flow.residual(edge);
    // The flow of the same network is the maximum.
    REQUIRE(solve(flow, network, flows) == 0);
    Network changed = network;
    for (size_t edge = 0; edge < flows.size(); edge += 10) changed.edges[edge].capacity += 2;
    for (size_t node = 0; node < nodeCount; node += 15) changed.terminals[node] *= -1;
    static_cast<void>(solve(flow, changed, flows));
    static_cast<void>(solve(plain, changed));
    for (uint32_t node = 0; node < nodeCount; ++node) REQUIRE(flow.isSource(node) == plain.isSource(node));
  }
}

TEST_CASE("a grid with fractional capacities has the flow of Dinic's algorithm up to rounding") {
  constexpr uint32_t kWidth = 60;
  Random random(5);
  MaxFlow flow;
  flow.reset(kWidth * kWidth);
  test::PlainMaxFlow plain(kWidth * kWidth);
  for (uint32_t node = 0; node < kWidth * kWidth; ++node) {
    const double terminal = random.real() - 0.5;
    flow.addTerminal(node, terminal);
    plain.addTerminal(node, std::max(0.0, terminal), std::max(0.0, -terminal));
    for (const uint32_t step : {1u, kWidth}) {
      if (step == 1 ? node % kWidth == kWidth - 1 : node + kWidth >= kWidth * kWidth) continue;
      const double capacity = 0.3 * random.real();
      flow.addEdge(node, node + step, capacity, capacity);
      plain.addEdge(node, node + step, capacity, capacity);
    }
  }
  CHECK(flow.solve() == doctest::Approx(plain.solve()).epsilon(1e-12));
}

TEST_CASE("graphs of several ranges have the flow and the cut of Dinic's algorithm, on any number of threads") {
  // Two and three levels of ranges; edges to near nodes, to far nodes, and to nodes of the next range.
  for (const uint32_t nodeCount : {20'000u, 70'000u}) {
    CAPTURE(nodeCount);
    Random random(nodeCount);
    Network network;
    for (uint32_t node = 0; node < nodeCount; ++node)
      network.terminals.push_back(static_cast<double>(random.index(21)) - 10);
    for (uint32_t node = 0; node + 1 < nodeCount; ++node)
      for (const uint32_t step : {1u, 150u, 1 + random.index(nodeCount - 1)}) {
        if (node + step >= nodeCount || (step > 150 && node % 50 != 0)) continue;
        network.edges.push_back({node, node + step, double(random.index(12)), double(random.index(12))});
      }
    test::PlainMaxFlow plain(nodeCount);
    for (uint32_t node = 0; node < nodeCount; ++node)
      plain.addTerminal(node, std::max(0.0, network.terminals[node]), std::max(0.0, -network.terminals[node]));
    for (const Edge& edge : network.edges) plain.addEdge(edge.a, edge.b, edge.capacity, edge.reverse);
    const double value = plain.solve();
    for (const size_t threadCount : {1u, 4u}) {
      MaxFlow flow;
      REQUIRE(test::onThreads(threadCount, [&] { return solve(flow, network); }) == value);
      for (uint32_t node = 0; node < nodeCount; ++node) REQUIRE(flow.isSource(node) == plain.isSource(node));
    }
  }
}
