#include "cli/exit_code.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <new>
#include <set>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "core/check.h"
#include "core/text.h"

namespace asdfvk {
namespace {

template <typename Exception>
Failure failureOf(const Exception& exception, bool requiresGpu = false) {
  try {
    throw exception;
  } catch (...) {
    return currentFailure(requiresGpu);
  }
}

TEST_CASE("each kind of error has its documented exit code") {
  const auto codeOf = [](ErrorCode code) { return static_cast<int>(failureOf(Error(code, "x")).code); };
  CHECK_EQ(codeOf(ErrorCode::OptionOutOfRange), 1);
  CHECK_EQ(codeOf(ErrorCode::UnreadableInput), 2);
  CHECK_EQ(codeOf(ErrorCode::DeviceLost), 3);
  CHECK_EQ(codeOf(ErrorCode::OutputNotWritable), 4);
  CHECK_EQ(codeOf(ErrorCode::Cancelled), 130);
}

TEST_CASE("a failure has the name of its code, and a remedy by options where there is one") {
  const Failure device = failureOf(Error(ErrorCode::NoVulkanDriver, "no driver"));
  CHECK_EQ(device.name, "noVulkanDriver");
  CHECK(device.message.starts_with("no driver; "));
  CHECK(device.message.find("--backend") != std::string::npos);
  CHECK_EQ(failureOf(Error(ErrorCode::EquationLimit, "x")).message, "x; use --solver cpu");
  CHECK_EQ(failureOf(Error(ErrorCode::DeviceLimit, "x"), true).message, "x; use --fetch auto, or a smaller mesh");
  CHECK_EQ(failureOf(Error(ErrorCode::TooFewValues, "x")).message, "x; give fewer --clusters, or drop --segment");
  CHECK_EQ(static_cast<int>(failureOf(Error(ErrorCode::NoValues, "x")).code), 2);
  const Failure input = failureOf(Error(ErrorCode::UnreadableInput, "line 3: no number"));
  CHECK_EQ(input.name, "unreadableInput");
  CHECK_EQ(input.message, "line 3: no number");
  CHECK_EQ(failureOf(42).name, "internal");
}

TEST_CASE("no remedy contradicts --require-gpu") {
  for (const ErrorCode code : {ErrorCode::NoVulkanLoader, ErrorCode::NoVulkanDriver, ErrorCode::KernelUnsupported,
                               ErrorCode::DeviceLimit, ErrorCode::OutOfDeviceMemory, ErrorCode::DeviceLost}) {
    CHECK(failureOf(Error(code, "x"), false).message.find("reference") != std::string::npos);
    CHECK_EQ(failureOf(Error(code, "x"), true).message.find("--backend"), std::string::npos);
    CHECK_EQ(failureOf(Error(code, "x"), true).message.find("CPU"), std::string::npos);
  }
}

TEST_CASE("a check that failed is 5, one that could not fail is 0") {
  CheckReport check;
  check.tracedCount = 2000;
  check.passed = false;
  CHECK_EQ(static_cast<int>(exitCodeOf(check)), 5);
  check.passed = true;
  CHECK_EQ(static_cast<int>(exitCodeOf(check)), 0);
  CHECK_EQ(static_cast<int>(exitCodeOf(CheckReport{.independent = false})), 0);
}

TEST_CASE("a mistake in the program is 70 with its place, too little memory is a failure of the mesh") {
  const Failure broken = failureOf(CheckFailure("a.cpp:1: x"));
  CHECK_EQ(static_cast<int>(broken.code), 70);
  CHECK(broken.message.find("a.cpp:1: x") != std::string::npos);
  CHECK_EQ(static_cast<int>(failureOf(42).code), 70);
  CHECK_EQ(static_cast<int>(failureOf(std::bad_alloc()).code), 2);
}

TEST_CASE("a limit of the system on files or threads is 8 with its remedy") {
  for (const std::errc reason : {std::errc::too_many_files_open, std::errc::too_many_files_open_in_system}) {
    const Failure failure = failureOf(std::system_error(std::make_error_code(reason), "pipe"));
    CHECK_EQ(static_cast<int>(failure.code), 8);
    CHECK_EQ(failure.name, "systemLimit");
    CHECK(failure.message.find("ulimit -n") != std::string::npos);
  }
  const auto checkThreads = [](const Failure& failure) {
    CHECK_EQ(static_cast<int>(failure.code), 8);
    CHECK(failure.message.find("ulimit -u") != std::string::npos);
  };
  checkThreads(failureOf(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again))));
  checkThreads(failureOf(std::runtime_error("pthread_create has failed: Resource temporarily unavailable")));
  CHECK_EQ(static_cast<int>(failureOf(std::system_error(std::make_error_code(std::errc::io_error))).code), 70);
}

TEST_CASE("several meshes: their exit code does not depend on their order, and no failure hides a thin wall") {
  const auto codeOf = [](std::vector<int> ofMeshes) {
    std::set<int> found;
    std::sort(ofMeshes.begin(), ofMeshes.end());
    do {
      SharedExitCode code;
      for (const int ofMesh : ofMeshes) code.add(static_cast<ExitCode>(ofMesh));
      found.insert(static_cast<int>(code.code()));
    } while (std::next_permutation(ofMeshes.begin(), ofMeshes.end()));
    CHECK_EQ(found.size(), 1);
    return *found.begin();
  };
  CHECK_EQ(codeOf({}), 0);
  CHECK_EQ(codeOf({0, 0}), 0);
  CHECK_EQ(codeOf({2}), 2);
  CHECK_EQ(codeOf({4, 2}), 4);
  CHECK_EQ(codeOf({0, 2, 0}), 7);
  CHECK_EQ(codeOf({8, 0}), 7);
  CHECK_EQ(codeOf({0, 6, 5}), 6);
  CHECK_EQ(codeOf({6, 2}), 6);
  CHECK_EQ(codeOf({5, 2}), 7);
  CHECK_EQ(codeOf({0, 5}), 5);
  CHECK_EQ(codeOf({2, 70, 3}), 70);
  CHECK_EQ(codeOf({2, 8}), 8);
  CHECK_EQ(codeOf({6, 70, 2, 0}), 6);
  CHECK_EQ(codeOf({6, 130}), 130);
  CHECK_EQ(codeOf({0, 2, 130}), 130);
}

TEST_CASE("messages are one line for any content") {
  CHECK_EQ(failureOf(Error(ErrorCode::UnreadableInput, "a\nb\tc\x1b[2J")).message, "a b c [2J");
  CHECK_EQ(oneLine("caf\xc3\xa9"), "caf\xc3\xa9");
}

}  // namespace
}  // namespace asdfvk
