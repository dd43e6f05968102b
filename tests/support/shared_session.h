#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include "asdf_vk/session.h"
#include "support/end_of_main.h"
#include "support/requested_device.h"

namespace asdfvk::test {

/// A session until the end of main.
inline Session& keptSession(const SessionOptions& options) {
  const auto session = std::make_shared<Session>(options);
  keepUntilEndOfMain(session);
  return *session;
}

/// One session on the best Vulkan device for a whole test program, under the validation layers: compute() throws
/// Error{ValidationFailed} for their messages.
inline Session& vulkanSession() {
  static Session& session = []() -> Session& {
    ::setenv("ASDF_VK_VALIDATION", "1", 1);
    Session& opened = keptSession({.backend = BackendChoice::Vulkan});
    requireRequestedDevice(opened.deviceLines().front());
    return opened;
  }();
  return session;
}

inline Session& referenceSession() {
  static Session& session = keptSession({.backend = BackendChoice::Reference});
  return session;
}

/// A session of each backend of this build.
inline std::vector<Session*> allSessions() {
  std::vector<Session*> sessions{&vulkanSession(), &referenceSession()};
  static Session& session = keptSession({.backend = BackendChoice::Cpu});
  sessions.push_back(&session);
  return sessions;
}

inline Options allSeeds() {
  Options options;
  options.seeds = SeedCount::all();
  return options;
}

/// A tenth of the faces, however small the mesh is.
inline Options tenthOfFaces() {
  Options options;
  options.seeds = SeedCount::ofShare(0.1);
  return options;
}

/// The field "error" of a result that must have one.
inline const std::vector<double>& expectedErrors(const Result& result) {
  const Field* field = result.field("error");
  REQUIRE(field != nullptr);
  REQUIRE(field->reals() != nullptr);
  return *field->reals();
}

/// The first warning of that code, or null.
inline const Warning* findWarning(const Report& report, WarningCode code) {
  const auto found = std::find_if(report.warnings.begin(), report.warnings.end(),
                                  [&](const Warning& warning) { return warning.code == code; });
  return found == report.warnings.end() ? nullptr : &*found;
}

/// The field "normalized".
inline const std::vector<double>& normalizedOf(const Result& result) {
  const Field* field = result.field("normalized");
  REQUIRE(field != nullptr);
  CHECK(field->unit.empty());
  return std::get<std::vector<double>>(field->values);
}

/// The field "segment".
inline const std::vector<uint32_t>& segmentsOf(const Result& result) {
  const Field* field = result.field("segment");
  REQUIRE(field != nullptr);
  CHECK(field->unit.empty());
  return std::get<std::vector<uint32_t>>(field->values);
}

}  // namespace asdfvk::test
