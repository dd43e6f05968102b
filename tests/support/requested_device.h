#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

namespace asdfvk::test {

/// Fails where the environment requests a fake device (tests/fake_device) and another one was opened, because the
/// Vulkan loader did not find the layer.
inline void requireRequestedDevice(const std::string& deviceLine) {
  if (const char* name = std::getenv("ASDF_VK_FAKE_NAME")) REQUIRE(deviceLine.starts_with(name));
}

}  // namespace asdfvk::test
