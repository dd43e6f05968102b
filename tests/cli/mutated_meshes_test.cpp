#include <fmt/format.h>

#include <array>

#include "asdf_vk/session.h"
#include "cli/lavapipe.h"
#include "cli/mutation.h"
#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

constexpr int kMeshCount = 2000;
constexpr int kDeviceMeshCount = 100;
constexpr int kMeshesPerRun = 50;
constexpr double kSecondsPerRun = 120;  // A run takes well under a second; this is for sanitizers on a busy machine.

struct Counts {
  int done = 0, refused = 0;
};

/// Further options of the batches, in turn. The backends with 100 meshes use the first two.
const std::array<std::vector<std::string>, 5> kFurtherOptions{
    {{"--segment", "parts"}, {"--measure", "thickness", "--thinner-than", "0.5", "--seeds", "20%"}, {}, {}, {}}};

/// Runs the program on all of `meshes`: each must have its line, and its result exactly when the line has no error.
Counts runMutated(const std::vector<std::string>& meshes, const std::string& backend,
                  const std::vector<std::string>& further, const ChildOptions& options) {
  const ScratchFolder results;
  std::vector<std::string> arguments = meshes;
  arguments.insert(arguments.end(), further.begin(), further.end());
  for (const char* option : {"--backend", backend.c_str(), "--rays", "8", "--json", "--quiet", "--format", "csv", "-o"})
    arguments.emplace_back(option);
  arguments.push_back(results / "");
  ChildProcess child(ASDFVK_PROGRAM, arguments, options);
  const ChildOutcome outcome = child.finish(kSecondsPerRun);
  INFO(outcome.error);
  const std::vector<std::string> lines = linesOf(outcome.output);
  INFO("stopped at mesh " << (lines.size() < meshes.size() ? meshes[lines.size()] : "none"));
  REQUIRE_EQ(outcome.signal, 0);
  REQUIRE_EQ(lines.size(), meshes.size());
  Counts counts;
  for (size_t i = 0; i < lines.size(); ++i) {
    const nlohmann::json line = nlohmann::json::parse(lines[i]);
    CHECK_EQ(line.at("mesh").get<std::string>(), meshes[i]);
    if (line.contains("error")) {
      CHECK(line.at("error").get<std::string>().find("validation layers") == std::string::npos);
      ++counts.refused;
      continue;
    }
    ++counts.done;
    const std::string result = std::filesystem::path(meshes[i]).stem().string() + ".asdf.csv";
    CHECK_EQ(linesOf(results.read(result)).size(), line.at("faceCount").get<size_t>() + 1);
  }
  CHECK_EQ(results.names().size(), counts.done);
  CHECK_EQ(linesOf(outcome.error).size(), counts.refused);
  CHECK_EQ(outcome.exitCode, counts.refused == 0 ? 0 : counts.done == 0 ? 2 : 7);
  return counts;
}

Counts runMutated(int meshCount, const std::string& backend, const ChildOptions& options) {
  struct Sample {
    const char* extension;
    std::string bytes;
  };
  const std::array<Sample, 5> samples{{{"ply", cubeAsciiPly()},
                                       {"ply", cubeBinaryPly()},
                                       {"off", cubeOff()},
                                       {"obj", cubeObj()},
                                       {"stl", cubeBinaryStl()}}};
  Random random(20);
  Counts total;
  for (int first = 0; first < meshCount; first += kMeshesPerRun) {
    const size_t batch = static_cast<size_t>(first / kMeshesPerRun);
    const ScratchFolder folder;
    std::vector<std::string> meshes;
    for (int i = first; i < first + kMeshesPerRun; ++i) {
      const Sample& sample = samples[static_cast<size_t>(i) % samples.size()];
      meshes.push_back(folder.write(fmt::format("mesh{:04}.{}", i, sample.extension), mutate(sample.bytes, random)));
    }
    const Counts counts = runMutated(meshes, backend, kFurtherOptions[batch % kFurtherOptions.size()], options);
    total.done += counts.done;
    total.refused += counts.refused;
  }
  MESSAGE(total.done << " meshes computed, " << total.refused << " refused");
  return total;
}

TEST_CASE("2,000 mutated meshes each end in a result or in a documented exit code") {
  const Counts total = runMutated(kMeshCount, "reference", {});
  CHECK(total.done > kMeshCount / 10);
  CHECK(total.refused > kMeshCount / 10);
}

TEST_CASE("100 mutated meshes do so on the CPU") {
  const Counts total = runMutated(kDeviceMeshCount, "cpu", {});
  CHECK(total.done > kDeviceMeshCount / 10);
  CHECK(total.refused > kDeviceMeshCount / 10);
}

TEST_CASE("100 mutated meshes do so on a Vulkan device under the validation layers, which stay silent") {
  auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  lavapipe->environment.emplace_back("ASDF_VK_VALIDATION", "1");
  const Counts total = runMutated(kDeviceMeshCount, "vulkan", *lavapipe);
  CHECK(total.done > kDeviceMeshCount / 10);
  CHECK(total.refused > kDeviceMeshCount / 10);
}

}  // namespace
}  // namespace asdfvk::test
