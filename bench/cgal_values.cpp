// Compares the values of `--definition cgal` with CGAL's values before post-processing. Prints the share of faces whose
// values agree within a tolerance, per mesh and backend.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asdf_vk/files.h"
#include "asdf_vk/session.h"
#include "support/cgal_oracle.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

constexpr std::array kTolerances{1e-9, 1e-5, 1e-4};  ///< Tolerances, divided by the range of CGAL's values.

struct Agreement {
  std::array<double, kTolerances.size()> shares{};
  double largest = 0;          ///< Greatest difference, divided by the range of CGAL's values.
  uint64_t oneSidedCount = 0;  ///< Number of faces that have a value in only one of asdf-vk and CGAL.
};

Agreement agreementOf(const std::vector<double>& values, const std::vector<double>& expected) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const double value : expected)
    if (!std::isnan(value)) low = std::min(low, value), high = std::max(high, value);
  Agreement agreement;
  const double range = std::max(0.0, high - low);  // The range is 0 if no face has a value.
  std::array<uint64_t, kTolerances.size()> counts{};
  for (size_t face = 0; face < expected.size(); ++face) {
    const bool isMissing = std::isnan(values[face]), isExpectedMissing = std::isnan(expected[face]);
    const double difference = isMissing && isExpectedMissing ? 0 : std::abs(values[face] - expected[face]);
    agreement.oneSidedCount += isMissing != isExpectedMissing;
    if (isMissing != isExpectedMissing) continue;
    agreement.largest = std::max(agreement.largest, difference / std::max(range, 1e-300));
    for (size_t i = 0; i < kTolerances.size(); ++i) counts[i] += difference <= kTolerances[i] * range;
  }
  for (size_t i = 0; i < kTolerances.size(); ++i)
    agreement.shares[i] = static_cast<double>(counts[i]) / static_cast<double>(expected.size());
  return agreement;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-cgal-values", "Compares the values of --definition cgal with CGAL's values.");
  std::vector<std::string> meshes, backends{"reference", "cpu", "vulkan"};
  program.addMeshes(meshes);
  program.add("--backends", backends, "Backends to compare");
  return program.run(argc, argv, [&](const RunControl& control) {
    writeOutput(
        fmt::format("{}\n| mesh | faces | backend | 1e-9 | 1e-5 | 1e-4 | largest | one-sided | seconds of CGAL, "
                    "ours |\n|---|---|---|---|---|---|---|---|---|\n",
                    toText(thisMachine())));
    for (const std::string& path : meshes) {
      test::CgalOracle oracle(readMesh(path));
      const Timer cgalTimer(Clock::ProcessCpu);
      const std::vector<double> expected = oracle.rawValues();
      const double cgalSeconds = cgalTimer.seconds();
      for (const std::string& backend : backends) {
        control.checkpoint(0);
        Session session(sessionOptionsOf(backend, ""));
        Options options;
        applyDefinition(Definition::Cgal, options);
        const Timer timer(Clock::ProcessCpu);
        const std::vector<double> values = session.compute(oracle.mesh(), options, control).sdf();
        const double seconds = timer.seconds();
        const Agreement agreement = agreementOf(values, expected);
        writeOutput(fmt::format("| {} | {} | {} | {:.4f}% | {:.4f}% | {:.4f}% | {:.1e} | {} | {:.2f}, {:.2f} |\n",
                                path.substr(path.rfind('/') + 1), expected.size(), backend, 100 * agreement.shares[0],
                                100 * agreement.shares[1], 100 * agreement.shares[2], agreement.largest,
                                agreement.oneSidedCount, cgalSeconds, seconds));
      }
    }
  });
}
