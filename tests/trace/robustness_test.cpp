#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "support/bits.h"
#include "support/shapes.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

std::vector<double> firstValues(const Mesh& mesh, size_t count) {
  std::vector<double> values = TracedMesh(mesh).values();
  values.resize(count);
  return values;
}

Mesh dentedSphere() { return shapes::jittered(shapes::icosphere(3), 0.04, 17); }

}  // namespace

TEST_CASE("oneFace and noFace have no value and do not crash") {
  Mesh mesh;
  CHECK(TracedMesh(mesh).values().empty());
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.faces = {{0, 1, 2}};
  CHECK(std::isnan(TracedMesh(mesh).values()[0]));
}

TEST_CASE("scaling by a power of two scales each value to the bit") {
  const std::vector<double> values = TracedMesh(dentedSphere()).values();
  for (const int exponent : {-200, -66, -1, 10, 300}) {
    std::vector<double> scaled =
        TracedMesh(shapes::scaledAndShifted(dentedSphere(), std::ldexp(1.0, exponent), {})).values();
    for (double& value : scaled) value = std::ldexp(value, -exponent);
    CHECK(test::haveSameBits(values, scaled));
  }
}

TEST_CASE("values scale with the mesh and do not move with it") {
  const std::vector<double> values = TracedMesh(dentedSphere()).values();
  struct Case {
    double scale;
    Vec3d shift;
    double tolerance;
  };
  for (const Case& c : {Case{1e-3, {}, 1e-10}, Case{1e3, {}, 1e-10}, Case{1e-20, {}, 1e-10}, Case{1e20, {}, 1e-10},
                        Case{1, {1000, -3000, 500}, 1e-9}, Case{1e-3, {1, 2, 3}, 1e-9}}) {
    CAPTURE(c.scale);
    const std::vector<double> moved = TracedMesh(shapes::scaledAndShifted(dentedSphere(), c.scale, c.shift)).values();
    size_t differing = 0;
    for (size_t f = 0; f < values.size(); ++f)
      differing += std::abs(moved[f] / c.scale - values[f]) > c.tolerance ? 1 : 0;
    CHECK(differing == 0);
  }
}

TEST_CASE("doubled faces, in either winding, change no value and have the value of their first copy") {
  const Mesh mesh = shapes::icosphere(3);
  const size_t count = mesh.faces.size();
  const std::vector<double> values = TracedMesh(mesh).values();
  Mesh doubled = mesh;
  for (size_t f = 0; f < count; f += 3) doubled.faces.push_back({mesh.faces[f][1], mesh.faces[f][2], mesh.faces[f][0]});
  for (size_t f = 1; f < count; f += 3) doubled.faces.push_back({mesh.faces[f][1], mesh.faces[f][0], mesh.faces[f][2]});
  const std::vector<double> doubledValues = TracedMesh(doubled).values();
  for (size_t f = 0; f < count; ++f) CHECK(doubledValues[f] == values[f]);
  size_t copy = count;
  for (size_t f = 0; f < count; f += 3) CHECK(doubledValues[copy++] == doctest::Approx(values[f]).epsilon(1e-9));
  for (; copy < doubled.faces.size(); ++copy) CHECK(std::isnan(doubledValues[copy]));  // They are oriented inwards.
}

TEST_CASE("zeroAreaFaces and faces with a NaN corner change no value of the others") {
  const Mesh mesh = dentedSphere();
  const std::vector<double> values = TracedMesh(mesh).values();
  Mesh defective = mesh;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  defective.vertices.insert(defective.vertices.end(), {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {nan, 0, 0}});
  const auto n = static_cast<uint32_t>(mesh.vertices.size());
  defective.faces.insert(defective.faces.end(), {{n, n + 1, n + 2}, {n, n, n}, {n, n + 1, n + 3}, {0, 0, 1}});
  CHECK(test::haveSameBits(firstValues(defective, values.size()), values));
}

TEST_CASE("values have the same bits with one thread and with more") {
  const TracedMesh traced(dentedSphere());
  std::vector<double> values[2];
  for (const size_t threadCount : {1, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threadCount);
    values[threadCount - 1] = traced.values();
  }
  CHECK(test::haveSameBits(values[0], values[1]));
  const Cone cone = makeCone({});
  for (uint32_t f = 0; f < traced.mesh.faceCount(); f += 17)
    CHECK(referenceCone(traced.scene(), cone, f) == values[0][f]);
}

TEST_CASE("progress rises to 1 on the calling thread and rays are counted") {
  const TracedMesh traced(dentedSphere());
  const Cone cone = makeCone({13, 100});
  const std::vector<uint32_t> seeds = traced.seedFaces();
  std::vector<double> values(seeds.size()), fractions;
  const std::thread::id caller = std::this_thread::get_id();
  bool calledElsewhere = false;
  RunControl control;
  control.progress = [&](double fraction) {
    fractions.push_back(fraction);
    calledElsewhere |= std::this_thread::get_id() != caller;
  };
  const TraceStatistics statistics = makeReferenceTracer(traced.scene(), cone)->trace(seeds, {values}, control);
  CHECK(statistics.rayCount == 13 * seeds.size());
  CHECK(statistics.redoneConeCount == 0);
  CHECK(!calledElsewhere);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.size() > 2);
  CHECK(fractions.front() == 0);
  CHECK(fractions.back() == 1);
}

TEST_CASE("a stop between chunks ends the trace") {
  const TracedMesh traced(dentedSphere());
  const Cone cone = makeCone({});
  const std::vector<uint32_t> seeds = traced.seedFaces();
  std::vector<double> values(seeds.size(), -1);
  std::stop_source stop;
  RunControl control{stop.get_token(), [&](double fraction) {
                       if (fraction > 0) stop.request_stop();
                     }};
  try {
    makeReferenceTracer(traced.scene(), cone)->trace(seeds, {values}, control);
    FAIL("the trace was not cancelled");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Cancelled);
  }
  CHECK(values.front() != -1);
  CHECK(values.back() == -1);
}

TEST_CASE("a degenerate seed and a short array of values are broken preconditions") {
  Mesh mesh = shapes::icosphere(0);
  mesh.faces.push_back({0, 0, 1});
  const TracedMesh traced(mesh);
  const Cone cone = makeCone({});
  CHECK_THROWS_AS((void)referenceCone(traced.scene(), cone, 20), CheckFailure);
  const std::vector<uint32_t> seeds = {0, 1};
  std::vector<double> values(1);
  CHECK_THROWS_AS(makeReferenceTracer(traced.scene(), cone)->trace(seeds, {values}, {}), CheckFailure);
}
