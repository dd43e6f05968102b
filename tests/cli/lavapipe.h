#pragma once

#include <doctest/doctest.h>

#include <optional>
#include <string>

#include "cli/child_process.h"
#include "support/mesa_driver.h"

namespace asdfvk::test {

inline ChildOptions withDrivers(const std::string& file) {
  ChildOptions options;
  options.environment = {{"VK_DRIVER_FILES", file}, {"VK_ICD_FILENAMES", file}};
  return options;
}

/// Environment in which Mesa's CPU device is the only one. Empty, with a message, where it is not installed: the test
/// is skipped.
inline std::optional<ChildOptions> lavapipeOnly() {
  const std::string driver = mesaDriver("lvp");
  if (!driver.empty()) return withDrivers(driver);
  MESSAGE("skipped: no lavapipe driver");
  return {};
}

}  // namespace asdfvk::test
