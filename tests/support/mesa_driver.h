#pragma once

#include <filesystem>
#include <string>

namespace asdfvk::test {

/// Manifest of a Vulkan driver of Mesa, for example `lvp` (lavapipe). Debian 12 has the architecture in the names of
/// the files, Debian 13 has not. Empty where the driver is not installed.
inline std::string mesaDriver(const std::string& name) {
  for (const char* ending : {"_icd.x86_64.json", "_icd.json"}) {
    const std::string path = "/usr/share/vulkan/icd.d/" + name + ending;
    if (std::filesystem::exists(path)) return path;
  }
  return {};
}

}  // namespace asdfvk::test
