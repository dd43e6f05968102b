#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "asdf_vk/files.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

/// Like readMesh(path, options), but calls `inspect` with the bytes of the file before they are parsed, and then with
/// the bytes of each file beside that is read.
[[nodiscard]] Mesh readMesh(const std::filesystem::path& path, const ReadOptions& options,
                            const std::function<void(std::span<const char>)>& inspect);

}  // namespace asdfvk
