#include "cli/lavapipe.h"
#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

TEST_CASE("processes on the Vulkan device give the same bytes, whatever their number of threads" *
          doctest::test_suite("slow")) {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(40));
  const auto resultOf = [&](const std::vector<std::string>& further) {
    std::vector<std::string> arguments{mesh, "--backend", "vulkan", "--quiet", "-o", folder / "result.npy"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const ChildOutcome outcome = runAsdf(arguments, *lavapipe);
    INFO(outcome.error);
    REQUIRE_EQ(outcome.exitCode, 0);
    return folder.read("result.npy");
  };
  for (const std::string solver : {"cg", "jacobi", "cpu", "eigen"}) {
    INFO(solver);
    const std::string first = resultOf({"--solver", solver});
    CHECK(resultOf({"--solver", solver}) == first);
    CHECK(resultOf({"--solver", solver, "--threads", "1"}) == first);
    CHECK(resultOf({"--solver", solver, "--threads", "2"}) == first);
    CHECK(resultOf({"--solver", solver, "--rng-seed", "2"}) != first);
  }
}

}  // namespace
}  // namespace asdfvk::test
