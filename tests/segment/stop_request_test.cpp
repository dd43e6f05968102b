// A stop request ends each step of a segmentation that takes long on large meshes.
#include <doctest/doctest.h>

#include <vector>

#include "generate/analytic_shapes.h"
#include "part_samples.h"
#include "segment/boundary_cut.h"
#include "segment/max_flow.h"
#include "segment/patches.h"
#include "segment/soft_clustering.h"
#include "support/require_failure.h"
#include "support/stopped_control.h"

using namespace asdfvk;
using test::requireFailure;
using test::stoppedControl;

TEST_CASE("patches and the cut of their boundaries end on request") {
  const Mesh mesh = makeSphere(320).mesh;
  const test::PartSample sample(mesh, std::vector<double>(mesh.faces.size(), 1));
  const PartSurface surface = makePartSurface(sample.mesh, sample.geometry, sample.edges.graph, sample.values);
  const std::vector<uint32_t> seeds{0}, counts{8};
  requireFailure([&] { (void)makePatches(surface, seeds, counts, stoppedControl()); }, ErrorCode::Cancelled);
  const std::vector<uint32_t> labels = makePatches(surface, seeds, counts)[0].patchOf;
  requireFailure([&] { (void)cutBoundaries(surface, labels, 8, stoppedControl()); }, ErrorCode::Cancelled);
}

TEST_CASE("a maximum flow ends on request, and the graph can be solved again") {
  MaxFlow flow;
  const auto setUp = [&] {
    flow.reset(2);
    flow.addTerminal(0, 3);
    flow.addTerminal(1, -3);
    flow.addEdge(0, 1, 2, 0);
  };
  setUp();
  requireFailure([&] { (void)flow.solve(stoppedControl()); }, ErrorCode::Cancelled);
  setUp();
  CHECK(flow.solve() == 2);
}

TEST_CASE("soft clustering ends on request") {
  requireFailure([] { (void)clusterSoftly(std::vector<double>{1, 2, 3}, 2, stoppedControl()); }, ErrorCode::Cancelled);
}
