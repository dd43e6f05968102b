#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "asdf_vk/mesh.h"

namespace asdfvk {

[[nodiscard]] Mesh readMesh(const std::filesystem::path& path);
[[nodiscard]] Mesh parseMesh(std::span<const char> bytes, std::string_view extension = {});

}  // namespace asdfvk
