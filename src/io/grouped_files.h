#pragma once

#include "asdf_vk/files.h"

namespace asdfvk {

class AtomicFiles;

// Like writeResult() and writePoints() of asdf_vk/files.h, but the files appear when the caller commits the group.
void writeResult(AtomicFiles& files, const std::filesystem::path& path, const MeshView& mesh,
                 std::span<const Field> fields, const WriteOptions& options);
void writePoints(AtomicFiles& files, const std::filesystem::path& path, std::span<const Field> fields,
                 const RunControl& control);

}  // namespace asdfvk
