#include <doctest/doctest.h>

#include <algorithm>
#include <stop_token>
#include <string>
#include <vector>

#include "asdf_vk/choices.h"
#include "asdf_vk/error.h"
#include "asdf_vk/scene.h"
#include "asdf_vk/session.h"
#include "generate/shapes.h"
#include "support/bits.h"
#include "support/fake_device.h"
#include "support/require_failure.h"
#include "support/scoped_variable.h"
#include "support/shared_session.h"

using namespace asdfvk;
using test::FakeDevice;
using test::haveSameBits;
using test::requireFailure;
using test::ScopedVariable;
using test::tenthOfFaces;

namespace {

/// A device that takes much longer to open than the meshes of this file to prepare.
const FakeDevice::Variables kSlowDevice{{"ASDF_VK_FAKE_OPENING_MS", "1500"}};

/// While it exists, the loader finds no driver.
class NoDriver {
 private:
  ScopedVariable files_{"VK_DRIVER_FILES", "/nonexistent"}, names_{"VK_ICD_FILENAMES", "/nonexistent"};
};

std::vector<double> valuesOf(Session& session, const Mesh& mesh, const Options& options) {
  return session.compute(mesh, options).sdf();
}

}  // namespace

TEST_CASE("a session that opens in a thread has the bits of another session, for one computation after another") {
  const Mesh mesh = makeTorus(1000).mesh;
  for (const BackendChoice backend :
       {BackendChoice::Automatic, BackendChoice::Vulkan, BackendChoice::Cpu, BackendChoice::Reference}) {
    CAPTURE(nameOf(kBackendNames, backend));
    Session inThread({.backend = backend}, SessionOpening::InThread), session({.backend = backend});
    for (const Options& options : {tenthOfFaces(), test::allSeeds(), tenthOfFaces()})
      CHECK(haveSameBits(valuesOf(inThread, mesh, options), valuesOf(session, mesh, options)));
    CHECK(inThread.backend() == session.backend());
    CHECK(inThread.deviceLines() == session.deviceLines());
  }
}

TEST_CASE("the mesh and its hierarchy are prepared while the device is opened") {
  const FakeDevice slow(kSlowDevice);
  Session session({.backend = BackendChoice::Vulkan}, SessionOpening::InThread);
  std::vector<Stage> stages;
  const RunControl control{{}, {}, [&](Stage stage) { stages.push_back(stage); }};
  const Result result = session.compute(makeTorus(1000).mesh, tenthOfFaces(), control);
  // The wait for the device is a part of the upload.
  CHECK(result.report.stageSeconds[Stage::Upload] > 0.5);
  const auto firstUpload = std::find(stages.begin(), stages.end(), Stage::Upload);
  for (const Stage stage : {Stage::Geometry, Stage::Graph, Stage::Bvh, Stage::Encode})
    CHECK(std::find(stages.begin(), firstUpload, stage) != firstUpload);
}

TEST_CASE("a stop request ends the wait for the device") {
  const FakeDevice slow(kSlowDevice);
  Session session({.backend = BackendChoice::Vulkan}, SessionOpening::InThread);
  std::stop_source stop;
  const RunControl control{stop.get_token(), {}, [&](Stage stage) {
                             if (stage == Stage::Upload) stop.request_stop();
                           }};
  requireFailure([&] { (void)session.compute(makeTorus(1000).mesh, tenthOfFaces(), control); }, ErrorCode::Cancelled);
  CHECK(session.backend() == "vulkan");
  (void)session.compute(makeTorus(1000).mesh, tenthOfFaces());
}

TEST_CASE("a device that cannot be opened is an error of each function that needs it, and of none before") {
  const NoDriver none;
  Session session({.backend = BackendChoice::Vulkan}, SessionOpening::InThread);
  const Mesh mesh = makeTorus(1000).mesh;
  const ErrorCode code = [] {
    try {
      const Session now({.backend = BackendChoice::Vulkan});
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::Cancelled;
  }();
  REQUIRE(code != ErrorCode::Cancelled);
  for (int i = 0; i < 2; ++i) {
    requireFailure([&] { (void)session.compute(mesh, tenthOfFaces()); }, code);
    requireFailure([&] { (void)session.deviceLines(); }, code);
    requireFailure([&] { session.finishOpening(); }, code);
    requireFailure([&] { (void)Scene(session, mesh); }, code);
    CHECK(session.compute(mesh, {.measure = Measure::Thickness}).report.backend == "cpu");
  }
}

TEST_CASE("without a device auto computes the bits of the CPU, with the hierarchy of the CPU") {
  const NoDriver none;
  const Mesh mesh = makeTorus(4000).mesh;
  Session cpu({.backend = BackendChoice::Cpu});
  const std::vector<double> expected = valuesOf(cpu, mesh, tenthOfFaces());
  for (int i = 0; i < 5; ++i) {  // The session is open before or after the hierarchy is built.
    Session session({}, SessionOpening::InThread);
    CHECK(haveSameBits(valuesOf(session, mesh, tenthOfFaces()), expected));
    CHECK(session.backend() == "cpu");
    CHECK(session.deviceLines().back().starts_with("vulkan: not available: "));
  }
}
