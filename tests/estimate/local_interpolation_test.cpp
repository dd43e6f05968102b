#include "estimate/local_interpolation.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "generate/shapes.h"
#include "mesh/arc_angles.h"
#include "mesh/face_geometry.h"
#include "poisson/poisson_solver.h"

using namespace asdfvk;

namespace {

/// An interpolation of a field on a mesh, with a constraint at one face in ten.
struct SampleProblem {
  Mesh mesh;
  FaceGeometry geometry;
  DualGraph graph;
  UnsetVector<double> weights;
  std::vector<double> constraints, guide;
  std::vector<uint32_t> heldOut;

  explicit SampleProblem(Mesh source)
      : mesh(std::move(source)),
        geometry(computeFaceGeometry(mesh)),
        graph(buildDualGraph(mesh)),
        weights(featureWeights(arcAngles(graph, geometry))),
        constraints(mesh.faces.size(), kNoValue),
        guide(mesh.faces.size()) {
    for (uint32_t face = 0; face < constraints.size(); ++face) {
      const Vec3d& centre = geometry.barycentres[face];
      const double value = 2 + std::sin(7 * centre.x) + centre.y;
      if (face % 10 == 0) constraints[face] = value;
      if (face % 97 == 5) heldOut.push_back(face);
      guide[face] = value + 0.3 * std::sin(20 * centre.z);
    }
  }

  [[nodiscard]] std::vector<double> solve(const std::vector<double>& values,
                                          const std::vector<double>& divergence) const {
    const std::vector<uint32_t> componentOf(values.size(), 0);
    std::vector<double> solution;
    const auto solver = makeEigenSolver(nullptr)->onGraph(graph, weights);
    (void)solver->solve({.constraints = values,
                         .firstGuess = std::vector<double>(values.size(), 2),
                         .guide = guide,
                         .divergence = divergence,
                         .componentOf = componentOf},
                        {.tolerance = 1e-12}, solution, {});
    return solution;
  }

  /// The constraints and further ones at the held-out faces.
  [[nodiscard]] std::vector<double> withHeldOut(double offset) const {
    std::vector<double> values = constraints;
    for (const uint32_t face : heldOut) values[face] = guide[face] + offset;
    return values;
  }
};

}  // namespace

TEST_CASE("local solutions are close to the solution on the whole mesh") {
  const SampleProblem sample(makeAnimal(3000).mesh);
  const std::vector<double> divergences[] = {{}, std::vector<double>(sample.mesh.faces.size(), 1e-3)};
  for (const std::vector<double>& divergence : divergences) {
    const std::vector<double> without = sample.solve(sample.constraints, divergence);
    const std::vector<double> with = sample.solve(sample.withHeldOut(0.5), divergence);
    const std::vector<double> local = interpolateLocally(
        {sample.graph, sample.weights, sample.constraints, sample.guide, divergence, with}, sample.heldOut);
    REQUIRE(local.size() == sample.heldOut.size());
    double error = 0, effect = 0;
    for (size_t i = 0; i < local.size(); ++i) {
      error += std::abs(local[i] - without[sample.heldOut[i]]);
      effect += std::abs(with[sample.heldOut[i]] - without[sample.heldOut[i]]);
    }
    MESSAGE("mean error ", error / effect, " of the effect of the held-out faces");
    CHECK(error < 0.06 * effect);
  }
}

TEST_CASE("a patch without a constraint is the whole component, and has no value") {
  const SampleProblem sample(makeSphere(80).mesh);
  const std::vector<double> none(80, kNoValue), two(80, 2.0);
  const std::vector<uint32_t> faces{3, 40};
  const auto valuesFor = [&](const std::vector<double>& constraints, const std::vector<double>& solution) {
    return interpolateLocally({sample.graph, sample.weights, constraints, {}, {}, solution}, faces);
  };
  for (const double value : valuesFor(none, none)) CHECK(std::isnan(value));
  std::vector<double> one = none;
  one[20] = 5;
  for (const double value : valuesFor(one, two)) CHECK(value == doctest::Approx(5).epsilon(0.01));
}

TEST_CASE("a face without neighbours has no value") {
  const DualGraph graph{{0, 0}, {}};
  const std::vector<double> one(1, kNoValue);
  const std::vector<uint32_t> faces{0};
  CHECK(std::isnan(interpolateLocally({graph, {}, one, {}, {}, one}, faces)[0]));
}
