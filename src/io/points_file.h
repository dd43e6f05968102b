#pragma once

#include <filesystem>
#include <span>

#include "asdf_vk/field.h"
#include "asdf_vk/run_control.h"

namespace asdfvk {

class AtomicFiles;

/// Like writePoints() of asdf_vk/files.h, but the file appears when the caller commits the group.
void writePoints(AtomicFiles& files, const std::filesystem::path& path, std::span<const Field> fields,
                 const RunControl& control);

}  // namespace asdfvk
