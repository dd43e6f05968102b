#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "asdf_vk/scene.h"
#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "shared/cone_layout.h"
#include "shared/prediction_layout.h"
#include "support/bits.h"
#include "support/changed_push.h"
#include "support/fake_device.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "trace/cone_tracer.h"

using namespace asdfvk;
using test::FakeDevice;
using test::findWarning;
using test::requireFailure;
using test::ScopedVariable;

namespace {

/// A GPU with memory of its own: uploads are submissions, and `auto` solves on the device.
const FakeDevice::Variables kGpu{{"ASDF_VK_FAKE_TYPE", "discrete"},
                                 {"ASDF_VK_FAKE_SEPARATE_MEMORY", "1"},
                                 {"ASDF_VK_FAKE_STORAGE_BUFFERS", "8"},
                                 {"ASDF_VK_GPU_RAYS", "0"}};

/// While it exists, the nth submission of each device, and later ones, lose it.
struct LostDevice : ScopedVariable {
  explicit LostDevice(uint32_t n) : ScopedVariable("ASDF_VK_FAKE_LOST_AT", std::to_string(n)) {}
};

/// While it exists, devices have no memory left from their nth allocation on.
struct FullDevice : ScopedVariable {
  explicit FullDevice(uint32_t n = 1) : ScopedVariable("ASDF_VK_FAKE_NO_MEMORY_AT", std::to_string(n) + "+") {}
};

/// While it exists, kernels drop all hits as false, so that no face has a value.
struct WrongDevice : test::ChangedPush<ConePush> {
  WrongDevice() : ChangedPush([](ConePush& push) { push.falseHitCosine = -2; }) {}
};

/// While it exists, the device predicts from no hit.
struct WrongPredictions : test::ChangedPush<PredictionPush> {
  WrongPredictions() : ChangedPush([](PredictionPush& push) { push.maxNormalCosine = -2; }) {}
};

/// In turns.
SessionOpening openingOf(int run) { return run % 2 == 0 ? SessionOpening::Now : SessionOpening::InThread; }

constexpr BackendChoice kNext = BackendChoice::Cpu;
const std::string kNextBackend = "cpu";

/// Two meshes with their values on the device, and on the backend that comes after it.
struct Expected {
  Mesh meshes[2] = {makeTorus(1000).mesh, makeSphere(500).mesh};
  std::vector<double> onDevice[2], replaced[2];

  Expected() {
    Session device, next({.backend = kNext});
    for (const int i : {0, 1}) {
      onDevice[i] = device.compute(meshes[i], test::tenthOfFaces()).sdf();
      replaced[i] = next.compute(meshes[i], test::tenthOfFaces()).sdf();
    }
  }

  /// Whether a new session, to which the environment may do harm, had a failure. The values are complete either way.
  [[nodiscard]] bool check(ErrorCode code, SessionOpening opening) const {
    Session session({}, opening);
    bool hasFailed = false;
    for (const int i : {0, 1}) {
      double last = 0;
      const RunControl control{{}, [&](double fraction) {
                                 CHECK(fraction >= last);
                                 CHECK(fraction <= 1);
                                 last = fraction;
                               }};
      const Result result = session.compute(meshes[i], test::tenthOfFaces(), control);
      CHECK(last == 1);
      const Warning* warning = findWarning(result.report, WarningCode::BackendReplaced);
      CHECK((warning != nullptr) == (result.report.backend == kNextBackend));
      if (warning != nullptr) {
        REQUIRE(warning->details.size() == 2);
        CHECK(warning->details[1].value == nameOf(code));
        CHECK(test::haveSameBits(result.sdf(), replaced[i]));
      } else if (result.report.warnings.empty()) {
        CHECK(test::haveSameBits(result.sdf(), onDevice[i]));
      } else {
        // The CPU solved the equation.
        for (size_t f = 0; f < onDevice[i].size(); ++f)
          CHECK(result.sdf()[f] == doctest::Approx(onDevice[i][f]).epsilon(0.01));
      }
      if (code == ErrorCode::DeviceLost && hasFailed) CHECK(warning != nullptr);  // A device is lost for ever.
      hasFailed = hasFailed || !result.report.warnings.empty();
    }
    return hasFailed;
  }
};

void checkReplaced(Session& session, const Mesh& mesh, const Result& result, ErrorCode code) {
  CHECK(result.report.backend == kNextBackend);
  CHECK(session.backend() == kNextBackend);
  CHECK(session.runsOnCpu());
  CHECK_FALSE(result.report.traceChoice);
  const Warning* warning = findWarning(result.report, WarningCode::BackendReplaced);
  REQUIRE(warning != nullptr);
  REQUIRE(warning->details.size() == 2);
  CHECK(warning->details[0].value == "vulkan");
  CHECK(warning->details[1].value == nameOf(code));
  CHECK(session.deviceLines().back().starts_with("vulkan: failed: "));
  Session expected({.backend = kNext});
  CHECK(test::haveSameBits(result.sdf(), expected.compute(mesh, test::tenthOfFaces()).sdf()));
}

}  // namespace

TEST_CASE("auto completes a mesh and later ones, whichever submission loses the device" * doctest::test_suite("slow")) {
  const FakeDevice fake(kGpu);
  const Expected expected;
  uint32_t n = 1;
  int run = 0;
  for (bool isLost = true; isLost; n += n < 4 ? 1 : 3) {
    CAPTURE(n);
    const LostDevice lost(n);
    isLost = expected.check(ErrorCode::DeviceLost, openingOf(run++));
    REQUIRE(n < 300);
  }
  CHECK(n > 5);
}

TEST_CASE("auto completes a mesh and later ones, whichever allocation finds no memory left" *
          doctest::test_suite("slow")) {
  const FakeDevice fake(kGpu);
  const Expected expected;
  uint32_t n = 1;
  int run = 0;
  for (bool isFull = true; isFull; n = 2 * n) {
    CAPTURE(n);
    const FullDevice full(n);
    isFull = expected.check(ErrorCode::OutOfDeviceMemory, openingOf(run++));
    REQUIRE(n < 2000);
  }
  CHECK(n > 5);
}

TEST_CASE("a mesh that exceeds the memory of the device leaves the device to later meshes") {
  const FakeDevice fake(kGpu);
  const Expected expected;
  Session session;
  Scene scene(session, expected.meshes[0]);
  const auto check = [&](const Result& result, bool isReplaced, const std::vector<double>& values) {
    CHECK(result.report.backend == (isReplaced ? kNextBackend : "vulkan"));
    CHECK((findWarning(result.report, WarningCode::BackendReplaced) != nullptr) == isReplaced);
    CHECK(test::haveSameBits(result.sdf(), values));
    CHECK(session.backend() == "vulkan");
  };
  const auto checkOnDevice = [&] {
    Options options = test::tenthOfFaces();
    options.solver = SolverChoice::Cg;
    check(session.compute(expected.meshes[1], options), false, expected.onDevice[1]);
    check(scene.compute(test::tenthOfFaces()), false, expected.onDevice[0]);
  };
  {
    const FullDevice full;
    check(scene.compute(test::tenthOfFaces()), true, expected.replaced[0]);
  }
  checkOnDevice();
  const Mesh large = makeTorus(300'000).mesh;  // The memory of the smaller meshes does not suffice.
  Session next({.backend = kNext});
  const FullDevice full;
  check(session.compute(large, test::tenthOfFaces()), true, next.compute(large, test::tenthOfFaces()).sdf());
  checkOnDevice();
}

TEST_CASE("where one allocation fails, a buffer is in other memory and nothing else changes") {
  const FakeDevice fake(kGpu);
  const Expected expected;
  for (uint32_t n = 1; n < 100; n = 2 * n + 1) {
    CAPTURE(n);
    const ScopedVariable full("ASDF_VK_FAKE_NO_MEMORY_AT", std::to_string(n));
    CHECK_FALSE(expected.check(ErrorCode::OutOfDeviceMemory, SessionOpening::Now));
    CHECK_FALSE(expected.check(ErrorCode::OutOfDeviceMemory, SessionOpening::InThread));
  }
}

TEST_CASE("a device with wrong values is refused at its first use") {
  const Mesh mesh = makeTorus(1000).mesh;
  {
    Session session, requested({.backend = BackendChoice::Vulkan});
    const WrongDevice wrong;
    checkReplaced(session, mesh, session.compute(mesh, test::tenthOfFaces()), ErrorCode::NoUsableDevice);
    requireFailure([&] { (void)requested.compute(mesh, test::tenthOfFaces()); }, ErrorCode::NoUsableDevice,
                   "computes wrong values: 64 of 64 faces of a generated mesh");
  }
  Session session;
  (void)session.compute(mesh, test::tenthOfFaces());
  CHECK(session.backend() == "vulkan");
}

TEST_CASE("each kernel is checked at its first use, whatever the mesh") {
  const Mesh cube = shapes::cube(), sheet = shapes::grid(4);  // The sheet has no values that could be wrong.
  Session session({.backend = BackendChoice::Vulkan});
  (void)session.compute(cube);
  const WrongDevice wrong;
  Options options = test::tenthOfFaces();
  options.cone.rayCount = 31;
  options.seeds = SeedCount::all();
  for (const Mesh& mesh : {sheet, cube})
    requireFailure([&] { (void)session.compute(mesh, options); }, ErrorCode::NoUsableDevice, "of a generated mesh");
}

TEST_CASE("a device is not wrong because of the first mesh") {
  const Mesh cube = shapes::doubledCube();  // Rays begin in a face, and hit two at once.
  Session first({.backend = BackendChoice::Vulkan}), second({.backend = BackendChoice::Vulkan});
  const Result alone = first.compute(cube, test::allSeeds());
  (void)second.compute(makeTorus(1000).mesh, test::allSeeds());
  CHECK(test::haveSameBits(second.compute(cube, test::allSeeds()).sdf(), alone.sdf()));
}

TEST_CASE("the CPU predicts where the device predicts wrong values") {
  const FakeDevice fake(kGpu);
  const Mesh mesh = makeTorus(1000).mesh;
  Session session;
  const WrongPredictions wrong;
  Options options = test::tenthOfFaces();
  const Result result = session.compute(mesh, options);
  CHECK(session.backend() == "vulkan");
  const Warning* warning = findWarning(result.report, WarningCode::PredictedOnCpu);
  REQUIRE(warning != nullptr);
  CHECK(warning->message.find("computes wrong predictions: 768 of 768 faces of a generated mesh") != std::string::npos);
  options.solver = SolverChoice::Cg;
  requireFailure([&] { (void)session.compute(mesh, options); }, ErrorCode::NoUsableDevice, "wrong predictions");
}

TEST_CASE("a requested backend, device, variant or solver of the device is not replaced") {
  const FakeDevice fake(kGpu);
  const Mesh mesh = makeTorus(1000).mesh;
  for (const SessionOptions& options : {SessionOptions{.backend = BackendChoice::Vulkan}, SessionOptions{.device = "0"},
                                        SessionOptions{.variant = {.kernel = TraceKernel::Ray}}}) {
    Session session(options);
    {
      const FullDevice full;
      requireFailure([&] { (void)session.compute(mesh, test::tenthOfFaces()); }, ErrorCode::OutOfDeviceMemory,
                     "out of device memory");
    }
    (void)session.compute(mesh, test::tenthOfFaces());
    for (const uint32_t n : {1, 1000}) {  // For ever, also where nothing loses the device any more.
      const LostDevice lost(n);
      requireFailure([&] { (void)session.compute(mesh, test::tenthOfFaces()); }, ErrorCode::DeviceLost,
                     "the device was lost");
    }
    CHECK(session.backend() == "vulkan");
  }
  Session session;
  Options options = test::tenthOfFaces();
  options.solver = SolverChoice::Cg;
  const LostDevice lost(1);
  requireFailure([&] { (void)session.compute(mesh, options); }, ErrorCode::DeviceLost);
}

TEST_CASE("a scene continues with the backend that replaces a lost device") {
  const FakeDevice fake(kGpu);
  const Mesh mesh = makeTorus(1000).mesh;
  Session session, expectedSession({.backend = kNext});
  Scene scene(session, mesh), other(session, mesh), expected(expectedSession, mesh);
  (void)scene.compute(test::tenthOfFaces());
  (void)other.compute(test::tenthOfFaces());
  const std::vector<double> points{0.5, 0.5, 0.5}, normals{0, 0, 1};
  {
    const LostDevice lost(1);
    CHECK(test::haveSameBits(scene.valuesAt(points, normals), expected.valuesAt(points, normals)));
  }
  CHECK(session.backend() == kNextBackend);
  for (Scene* each : {&scene, &other}) {
    const Result result = each->compute(test::tenthOfFaces());
    CHECK(findWarning(result.report, WarningCode::BackendReplaced) != nullptr);
    CHECK(test::haveSameBits(result.sdf(), expected.compute(test::tenthOfFaces()).sdf()));
  }
}
