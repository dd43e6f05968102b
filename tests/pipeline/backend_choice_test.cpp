#include "pipeline/backend_choice.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "asdf_vk/session.h"
#include "core/parallel.h"
#include "generate/shapes.h"
#include "support/fake_device.h"
#include "support/scoped_variable.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::FakeDevice;

namespace {

const FakeDevice::Variables kFakeGpu{{"ASDF_VK_FAKE_TYPE", "discrete"}};

Report reportOf(Session& session, const Mesh& mesh, const Options& options) {
  return session.compute(mesh, options).report;
}

}  // namespace

TEST_CASE("a GPU is taken where it was measured to be faster than 16 threads") {
  // docs/speed.md: rays of 1.5 million faces and of the horse, from all faces, 10 % and 1 %; which of both was faster.
  struct Cell {
    uint64_t rayCount;
    bool isGpuFaster;
  };
  constexpr std::array kMeasured{Cell{45'000'000, true}, Cell{4'500'000, false}, Cell{450'000, false},
                                 Cell{2'900'000, false}, Cell{290'000, false},   Cell{29'000, false}};
  for (const Cell& cell : kMeasured) {
    CAPTURE(cell.rayCount);
    CHECK((cell.rayCount >= leastRaysForGpu(16, false)) == cell.isGpuFaster);
  }
  CHECK(leastRaysForGpu(16, true) == leastRaysForGpu(16, false) / 10);
  CHECK(leastRaysForGpu(2, true) * 8 == leastRaysForGpu(16, true));
}

#ifdef __linux__
TEST_CASE("a machine has a GPU if a driver of the kernel has made a file for it") {
  std::string name = (std::filesystem::temp_directory_path() / "asdfvk-devices-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const std::filesystem::path files(name);
  CHECK_FALSE(mayHaveGpu(files));
  std::filesystem::create_directory(files / "dri");
  CHECK_FALSE(mayHaveGpu(files));
  std::ofstream(files / "dri" / "card0");  // A screen without a GPU has such a file, too.
  CHECK_FALSE(mayHaveGpu(files));
  std::ofstream(files / "dri" / "renderD128");
  CHECK(mayHaveGpu(files));
  std::filesystem::remove_all(files / "dri");
  for (const char* const driver : {"nvidiactl", "dxg"}) {
    std::ofstream{files / driver};
    CHECK(mayHaveGpu(files));
    std::filesystem::remove(files / driver);
  }
  std::filesystem::remove_all(files);
}
#endif

TEST_CASE("on an open GPU, automatic choice traces few rays on the CPU and many on the device") {
  const FakeDevice fake(kFakeGpu);
  Session session;
  REQUIRE(session.backend() == "vulkan");
  const Mesh mesh = makeTorus(2000).mesh;
  Options options = test::allSeeds();
  const uint64_t least = leastRaysForGpu(threadLimit(), true), faceCount = mesh.faces.size();
  for (const bool hasMany : {false, true, false}) {
    options.cone.rayCount = static_cast<uint32_t>(least / faceCount + (hasMany ? 1 : 0));
    const Report report = reportOf(session, mesh, options);
    CAPTURE(hasMany);
    CHECK(report.rayCount == faceCount * options.cone.rayCount);
    CHECK(report.leastRaysForGpu == least);
    CHECK(report.backend == (hasMany ? "vulkan" : "cpu"));
    CHECK(session.backend() == "vulkan");
  }
  options.solver = SolverChoice::Cg;
  CHECK(reportOf(session, mesh, options).backend == "vulkan");  // The CPU does not have this solver.
}

TEST_CASE("no GPU is opened for a mesh with too few rays for it") {
  const test::ScopedVariable rays("ASDF_VK_GPU_RAYS", "6001"), files("VK_DRIVER_FILES", "/nonexistent"),
      names("VK_ICD_FILENAMES", "/nonexistent");
  Session session({}, SessionOpening::InThread);
  const Mesh mesh = makeTorus(200).mesh;
  for (int i = 0; i < 2; ++i) {
    const Report report = reportOf(session, mesh, test::allSeeds());
    CHECK(report.backend == "cpu");
    CHECK(report.leastRaysForGpu == 6001);
    session.finishOpening();
    CHECK_FALSE(session.isOpen());
  }
  CHECK(session.deviceLines().back().starts_with("vulkan: not available: "));
}

TEST_CASE("a requested backend or device, and a CPU device, compute any number of rays") {
  const Mesh mesh = makeTorus(200).mesh;
  const Options options = test::allSeeds();
  {
    const FakeDevice fake(kFakeGpu);
    Session vulkan({.backend = BackendChoice::Vulkan}), device({.device = "0"}), cpu({.backend = BackendChoice::Cpu});
    for (Session* const session : {&vulkan, &device, &cpu}) {
      const Report report = reportOf(*session, mesh, options);
      CHECK(report.backend == session->backend());
      CHECK_FALSE(report.leastRaysForGpu);
    }
  }
  Session lavapipe;
  const Report report = reportOf(lavapipe, mesh, options);
  CHECK(report.backend == "vulkan");
  CHECK_FALSE(report.leastRaysForGpu);
}

TEST_CASE("computations without rays need no device, unless one is requested") {
  const Options thickness{.measure = Measure::Thickness};
  using Choice = BackendChoice;
  for (const Choice choice : {Choice::Automatic, Choice::Vulkan, Choice::Cpu})
    CHECK(sessionOptionsFor({.backend = choice}, thickness).backend == Choice::Cpu);
  CHECK(sessionOptionsFor({.backend = Choice::Reference}, thickness).backend == Choice::Reference);
  CHECK(sessionOptionsFor({.device = "0"}, thickness).backend == Choice::Automatic);
  CHECK(sessionOptionsFor({.requireGpu = true}, thickness).backend == Choice::Automatic);
  CHECK(sessionOptionsFor({}, {}).backend == Choice::Automatic);
  CHECK(sessionOptionsFor({}, {.measure = Measure::Thickness, .checkCount = 1}).backend == Choice::Automatic);
  CHECK(sessionOptionsFor({}, {.measure = Measure::Thickness, .solver = SolverChoice::Jacobi}).backend ==
        Choice::Automatic);
}
