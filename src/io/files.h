#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "asdf_vk/files.h"
#include "asdf_vk/mesh.h"

// Variants of functions of asdf_vk/files.h.
namespace asdfvk {

class AtomicFiles;

/// Like readMesh(path, options), but calls `inspect` with the bytes of the file before they are parsed, and then with
/// the bytes of each file beside that is read.
[[nodiscard]] Mesh readMesh(const std::filesystem::path& path, const ReadOptions& options,
                            const std::function<void(std::span<const char>)>& inspect);

/// Like writeResult(path, mesh, fields, options), but the files appear when the caller commits the group.
void writeResult(AtomicFiles& files, const std::filesystem::path& path, const MeshView& mesh,
                 std::span<const Field> fields, const WriteOptions& options);

}  // namespace asdfvk
