#include "estimate/held_out.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

using namespace asdfvk;

namespace {

std::vector<uint32_t> facesUpTo(uint32_t count) {
  std::vector<uint32_t> faces(count);
  std::iota(faces.begin(), faces.end(), 0u);
  return faces;
}

/// How often each face is chosen, of so many times.
std::vector<double> shareChosen(std::span<const double> density, uint64_t count, uint32_t runCount) {
  std::vector<double> shares(density.size());
  const std::vector<uint32_t> faces = facesUpTo(static_cast<uint32_t>(density.size()));
  for (uint32_t run = 0; run < runCount; ++run)
    for (const uint32_t face : chooseProbes(faces, density, count, run).faces) shares[face] += 1.0 / runCount;
  return shares;
}

}  // namespace

TEST_CASE("as many probes as asked for, all different, ascending and among the candidates") {
  std::vector<double> density(1000);
  for (size_t face = 0; face < 1000; ++face) density[face] = 0.1 + static_cast<double>(face * 7919 % 101);
  std::vector<uint32_t> candidates;
  for (uint32_t face = 0; face < 1000; face += 3) candidates.push_back(face);
  for (const uint64_t count : {0u, 1u, 2u, 50u, 300u, 333u, 334u, 5000u}) {
    const Probes probes = chooseProbes(candidates, density, count, 5);
    CHECK(probes.faces.size() == std::min<uint64_t>(count, 334));
    CHECK(probes.weights.size() == probes.faces.size());
    CHECK(std::adjacent_find(probes.faces.begin(), probes.faces.end(), std::greater_equal<>()) == probes.faces.end());
    CHECK(std::all_of(probes.faces.begin(), probes.faces.end(), [](uint32_t face) { return face % 3 == 0; }));
    CHECK(chooseProbes(candidates, density, count, 5).faces == probes.faces);
  }
  CHECK(chooseProbes(candidates, density, 50, 5).faces != chooseProbes(candidates, density, 50, 6).faces);
  CHECK(chooseProbes({}, density, 50, 5).faces.empty());
}

TEST_CASE("faces are chosen in proportion to their density, but no more than for certain") {
  const std::vector<double> density{1, 2, 3, 4, 100, 2, 4, 6, 8, 10};
  const std::vector<double> shares = shareChosen(density, 4, 20000);
  // The fifth is certain; three are left for densities that add up to 40.
  for (size_t face = 0; face < density.size(); ++face)
    CHECK(shares[face] == doctest::Approx(face == 4 ? 1 : density[face] * 3 / 40).epsilon(0.06));
}

TEST_CASE("weights tell for how many others a probe stands") {
  const std::vector<double> density{1, 2, 3, 4, 100, 2, 4, 6, 8, 10};
  const std::vector<uint32_t> faces = facesUpTo(10);
  for (uint64_t run = 0; run < 50; ++run) {
    const Probes probes = chooseProbes(faces, density, 4, run);
    for (size_t i = 0; i < probes.faces.size(); ++i) {
      const double probability = probes.faces[i] == 4 ? 1 : density[probes.faces[i]] * 3 / 40;
      CHECK(probes.weights[i] == doctest::Approx((1 / probability - 1) / 2.5));
    }
  }
  for (const double weight : chooseProbes(faces, density, 10, 1).weights) CHECK(weight == 0);
}

TEST_CASE("so weighted, probes tell the sum over the faces that were not chosen") {
  std::vector<double> density(300), value(300);
  for (size_t face = 0; face < 300; ++face) {
    density[face] = 1 + static_cast<double>(face * 37 % 11);
    value[face] = density[face] + static_cast<double>(face % 5);
  }
  const double all = std::accumulate(value.begin(), value.end(), 0.0);
  const std::vector<uint32_t> faces = facesUpTo(300);
  double told = 0, real = 0;
  for (uint64_t run = 0; run < 400; ++run) {
    const Probes probes = chooseProbes(faces, density, 60, run);
    real += all;
    for (size_t i = 0; i < 60; ++i) {
      told += probes.weights[i] * 5 * value[probes.faces[i]];
      real -= value[probes.faces[i]];
    }
  }
  CHECK(told == doctest::Approx(real).epsilon(0.01));
}

TEST_CASE("probes of one density are spread over the list") {
  const std::vector<double> density(1000, 1.0);
  const std::vector<uint32_t> faces = facesUpTo(1000);
  for (uint64_t run = 0; run < 20; ++run) {
    const std::vector<uint32_t> probes = chooseProbes(faces, density, 100, run).faces;
    for (uint32_t begin = 0; begin < 1000; begin += 100) {
      const auto count = std::count_if(probes.begin(), probes.end(),
                                       [&](uint32_t face) { return face >= begin && face < begin + 100; });
      CHECK(std::abs(count - 10) <= 1);
    }
  }
}
