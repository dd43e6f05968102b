#include <filesystem>

#include "asdf_vk/session.h"
#include "cli/lavapipe.h"
#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"
#include "support/fake_device.h"

namespace asdfvk::test {
namespace {

const ChildOptions kNoDriver = withDrivers("/nonexistent.json");

TEST_CASE("without a Vulkan device auto selects the CPU tracer, with the reasons") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome = runAsdf({mesh, "--json"}, kNoDriver);
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  CHECK_EQ(nlohmann::json::parse(outcome.output).at("backend").get<std::string>(), "cpu");
  const std::vector<std::string> lines = linesOf(outcome.error);
  CHECK(lines.at(0).starts_with("asdf-vk: cpu: CPU, "));
  CHECK(lines.at(1).starts_with("asdf-vk: vulkan: not available: "));
  // The default of a kernel option does not require Vulkan.
  CHECK_EQ(runAsdf({mesh, "--quiet", "--kernel", "auto", "--fetch", "auto"}, kNoDriver).exitCode, 0);
}

TEST_CASE("a required Vulkan device, kernel or GPU that is missing gives 3 and no result") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  checkFailure(runAsdf({mesh, "--backend", "vulkan", "--quiet"}, kNoDriver), 3, "--backend");
  checkFailure(runAsdf({mesh, "--require-gpu", "--quiet"}, kNoDriver), 3,
               "install the driver of the GPU, or drop --require-gpu");
  checkFailure(runAsdf({mesh, "--kernel", "ray", "--quiet"}, kNoDriver), 3, "");
  const ChildOutcome json = runAsdf({mesh, "--backend", "vulkan", "--quiet", "--json"}, kNoDriver);
  CHECK_EQ(json.exitCode, 3);
  const nlohmann::json failure = nlohmann::json::parse(json.output);
  CHECK_FALSE(failure.at("error").get<std::string>().empty());
  CHECK_EQ(failure.at("code").get<std::string>(), "noVulkanDriver");
  CHECK_EQ(folder.names(), std::vector<std::string>{"cube.off"});
}

TEST_CASE("a mesh with too few rays for a GPU, and a thickness, are computed without a device") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  ChildOptions few = kNoDriver;
  few.environment.emplace_back("ASDF_VK_GPU_RAYS", "1000");
  const ChildOutcome outcome = runAsdf({mesh, "--json"}, few);
  CHECK_EQ(outcome.exitCode, 0);
  CHECK_EQ(nlohmann::json::parse(outcome.output).at("leastRaysForGpu").get<int>(), 1000);
  const std::string line = linesOf(outcome.error).at(0);
  CHECK(line.starts_with("asdf-vk: cpu: CPU, "));
  CHECK(line.ends_with(": fewer than the 1,000 rays from which a GPU is faster"));
  CHECK(outcome.error.find("not available") == std::string::npos);
  for (const char* const backend : {"auto", "vulkan", "cpu"}) {
    const ChildOutcome thickness = runAsdf({mesh, "--measure", "thickness", "--backend", backend, "--json"}, kNoDriver);
    CHECK_EQ(thickness.exitCode, 0);
    CHECK(thickness.error.find("not available") == std::string::npos);
    CHECK_EQ(nlohmann::json::parse(thickness.output).at("backend").get<std::string>(), "cpu");
  }
  checkFailure(runAsdf({mesh, "--measure", "thickness", "--require-gpu", "--quiet"}, kNoDriver), 3, "--require-gpu");
}

TEST_CASE("the list of devices is empty with a reason where there is none") {
  const ChildOutcome text = runAsdf({"--list-devices"}, kNoDriver);
  CHECK_EQ(text.exitCode, 0);
  CHECK(text.output.starts_with("no Vulkan device: "));
  const ChildOutcome json = runAsdf({"--list-devices", "--json"}, kNoDriver);
  CHECK(nlohmann::json::parse(json.output).at("devices").empty());
  CHECK_FALSE(nlohmann::json::parse(json.output).at("reason").get<std::string>().empty());
  const ChildOutcome required = runAsdf({"--list-devices", "--require-gpu"}, kNoDriver);
  CHECK_EQ(required.output, text.output);
  checkFailure(required, 3, "no GPU is usable");
}

TEST_CASE("the report on a device is JSON; without a device it has the reason and the exit code is 3") {
  const ChildOutcome none = runAsdf({"--device-report"}, kNoDriver);
  CHECK_EQ(none.exitCode, 3);
  const nlohmann::json missing = nlohmann::json::parse(none.output);
  CHECK_FALSE(missing.at("passed").get<bool>());
  CHECK(missing.at("device").is_null());
  CHECK(none.error.find(missing.at("reason").get<std::string>()) != std::string::npos);
  CHECK_EQ(missing.at("tracers").size(), 1);
  checkFailure(runAsdf({"--device-report", "--backend", "vulkan"}, kNoDriver), 3, "mesa-vulkan-drivers");

  const ChildOutcome reference = runAsdf({"--device-report", "--backend", "reference"}, kNoDriver);
  CHECK_EQ(reference.exitCode, 0);
  const nlohmann::json report = nlohmann::json::parse(reference.output);
  CHECK(report.at("passed").get<bool>());
  CHECK_EQ(report.at("tracers").at(0).at("backend").get<std::string>(), "reference");
  CHECK(report.at("tracers").at(0).at("raysPerSecond").get<double>() > 0);
}

TEST_CASE("lavapipe is listed, runs, and is no GPU") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const ChildOutcome list = runAsdf({"--list-devices", "--json"}, *lavapipe);
  const nlohmann::json devices = nlohmann::json::parse(list.output).at("devices");
  REQUIRE_EQ(devices.size(), 1);
  CHECK(devices[0].at("usable").get<bool>());
  CHECK(devices[0].at("name").get<std::string>().find("llvmpipe") != std::string::npos);
  CHECK_EQ(devices[0].at("reason").get<std::string>(), "chosen");
  const ChildOutcome required = runAsdf({"--list-devices", "--json", "--require-gpu"}, *lavapipe);
  checkFailure(required, 3, "no GPU is usable");
  const nlohmann::json refused = nlohmann::json::parse(required.output).at("devices").at(0);
  CHECK_FALSE(refused.at("usable").get<bool>());
  CHECK_EQ(refused.at("reason").get<std::string>(), "is a CPU device and a GPU was required");

  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  checkFailure(runAsdf({mesh, "--require-gpu", "--quiet"}, *lavapipe), 3, "");
  checkFailure(runAsdf({mesh, "--device", "no such device", "--quiet"}, *lavapipe), 3, "no such device");
  for (const char* device : {"0", "llvmpipe"}) {
    const ChildOutcome outcome = runAsdf({mesh, "--backend", "vulkan", "--device", device, "--json"}, *lavapipe);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 0);
    const nlohmann::json json = nlohmann::json::parse(outcome.output);
    CHECK_EQ(json.at("backend").get<std::string>(), "vulkan");
    CHECK(json.at("device").get<std::string>().find("llvmpipe") != std::string::npos);
  }
}

TEST_CASE("a requested kernel variant runs, on Vulkan, and is in the report") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(16));
  const auto choiceWith = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{mesh, "--json", "--check=all"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ChildOutcome outcome = runAsdf(arguments, *lavapipe);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 0);
    const nlohmann::json report = nlohmann::json::parse(outcome.output);
    const nlohmann::json choice = report.at("traceChoice");
    return choice.at("kernel").get<std::string>() + " " + choice.at("fetch").get<std::string>();
  };
  CHECK_EQ(choiceWith({"--kernel", "packet"}), "packet texel");
  CHECK_EQ(choiceWith({"--kernel", "ray", "--fetch", "storage"}), "ray storage");
  CHECK_EQ(choiceWith({"--backend", "vulkan"}), "seed texel");
}

TEST_CASE("auto selects Vulkan also on a CPU device, and mentions --backend cpu") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome = runAsdf({mesh, "--json", "--verbose"}, *lavapipe);
  CHECK_EQ(outcome.exitCode, 0);
  CHECK_EQ(nlohmann::json::parse(outcome.output).at("backend").get<std::string>(), "vulkan");
  const std::string first = linesOf(outcome.error).at(0);
  CHECK(first.find("llvmpipe") != std::string::npos);
  CHECK(first.find("--backend cpu") != std::string::npos);
}

TEST_CASE("--backend cpu agrees with the reference and names its threads") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome = runAsdf({mesh, "--backend", "cpu", "--threads", "1", "--check", "--json"});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  const nlohmann::json json = nlohmann::json::parse(outcome.output);
  CHECK_EQ(json.at("backend").get<std::string>(), "cpu");
  CHECK_EQ(json.at("device").get<std::string>(), "CPU, 1 thread, single precision");
  CHECK(json.at("check").at("independent").get<bool>());
}

TEST_CASE("each rejected device has its line with the reason") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  // Two manifests of one driver are two devices.
  const ScratchFolder folder;
  const std::string driver = lavapipe->environment.front().second;
  std::filesystem::copy_file(driver, folder / "second.json");
  const ChildOptions twice = withDrivers(driver + ":" + (folder / "second.json"));
  const std::vector<std::string> list = linesOf(runAsdf({"--list-devices"}, twice).output);
  REQUIRE_EQ(list.size(), 2);
  CHECK(list[0].starts_with("0  llvmpipe"));
  CHECK(list[0].ends_with("   chosen"));
  CHECK(list[1].starts_with("1  llvmpipe"));
  CHECK(list[1].find("   usable but ranks behind device 0, llvmpipe") != std::string::npos);

  const std::string mesh = folder.write("cube.off", cubeOff());
  const auto firstLines = [&](const std::vector<std::string>& arguments) {
    return linesOf(runAsdf(arguments, twice).error);
  };
  const std::vector<std::string> best = firstLines({mesh, "--backend", "vulkan"});
  CHECK(best.at(0).find("chosen, driver") != std::string::npos);
  CHECK(best.at(1).find("usable but ranks behind device 0") != std::string::npos);
  const std::vector<std::string> chosen = firstLines({mesh, "--backend", "vulkan", "--device", "1", "--verbose"});
  CHECK(chosen.at(0).find("chosen, driver") != std::string::npos);
  CHECK(chosen.at(1).find("is not the requested device '1'") != std::string::npos);
  CHECK(firstLines({mesh, "--backend", "vulkan", "--quiet"}).empty());
  // A device that the user names, and the only one, need no line.
  CHECK(firstLines({mesh, "--device", "1"}).at(0).starts_with(mesh));
  CHECK(linesOf(runAsdf({mesh}, *lavapipe).error).at(0).starts_with(mesh));
}

TEST_CASE("auto opens a device that failed again for the next mesh") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff());
  // Its only face casts no ray: the device only checks the kernels, in its first submission.
  const std::string line = folder.write("line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  const FakeDevice device(FakeDevice::Variables{{"ASDF_VK_FAKE_LOST_AT", "2"}});
  const ChildOutcome outcome = runAsdf({cube, line, "--json", "--quiet", "-o", folder / "out/"}, *lavapipe);
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  const std::vector<std::string> lines = linesOf(outcome.output);
  REQUIRE_EQ(lines.size(), 2);
  const nlohmann::json first = nlohmann::json::parse(lines[0]), second = nlohmann::json::parse(lines[1]);
  CHECK_NE(first.at("backend").get<std::string>(), "vulkan");
  CHECK_EQ(first.at("warnings").at(0).at("code").get<std::string>(), "backendReplaced");
  CHECK_EQ(second.at("backend").get<std::string>(), "vulkan");
  CHECK_EQ(second.at("warnings").dump().find("backendReplaced"), std::string::npos);
}

TEST_CASE("a time limit that ends while the device is opened gives 8, whatever becomes of the device") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const ScratchFolder folder;
  const FakeDevice device(FakeDevice::Variables{{"ASDF_VK_FAKE_OPENING_MS", "3000"}});
  checkFailure(
      runAsdf({folder.write("sphere.off", sphereOff(20)), "--backend", "vulkan", "--timeout", "0.5", "--quiet"},
              *lavapipe),
      8, "took longer than --timeout 0.5");
  CHECK_EQ(folder.names(), std::vector<std::string>{"sphere.off"});
}

}  // namespace
}  // namespace asdfvk::test
