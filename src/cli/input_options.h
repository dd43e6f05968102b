#pragma once

#include "asdf_vk/files.h"
#include "cli/other_meshes.h"
#include "describe/option.h"

namespace asdfvk {

/// Rows of the options of the meshes that are read. The arguments must outlive the rows.
[[nodiscard]] OptionRows readingRows(ReadOptions& reading);
[[nodiscard]] OptionRows otherMeshRows(OtherMeshes& others);

}  // namespace asdfvk
