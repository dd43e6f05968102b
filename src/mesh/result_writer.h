#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "mesh/mesh.h"

namespace asdfvk {

/// What is written beside a mesh: one entry per input face, in file order. Views only.
struct FaceValues {
  std::span<const double> values;    ///< #I, NaN where there is none.
  std::span<const uint8_t> isSeed;   ///< #I, 1 where rays were cast.
};

struct WriteOptions {
  bool ascii = false;  ///< PLY only.
};

/// Throws Error{Usage} when the extension of `path` is none of .ply .vtu .npy .csv, so that it can be called before the
/// work begins.
void requireWritableExtension(const std::filesystem::path& path);

/// Writes by extension: whole or not at all (a temporary file beside it, then a rename). "-" with the wanted format is
/// not supported here. Throws Error{Output} with the reason.
void writeResult(const std::filesystem::path& path, const Mesh& mesh, const FaceValues& face,
                 const WriteOptions& options = {});

/// The same bytes on standard output; `extension` is "ply", "vtu", "npy" or "csv".
void writeResultToStandardOutput(std::string_view extension, const Mesh& mesh, const FaceValues& face,
                                 const WriteOptions& options = {});

}  // namespace asdfvk
