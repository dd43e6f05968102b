#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace asdfvk::test {

/// The folder of real meshes, which are not part of this repository. Without it the test prints a message and ends;
/// CTest reports it as skipped.
inline std::optional<std::filesystem::path> realMeshFolder() {
  if (const char* folder = std::getenv("ASDF_VK_MESH_DIR")) return folder;
  MESSAGE("skipped: ASDF_VK_MESH_DIR is not set");
  return {};
}

}  // namespace asdfvk::test
