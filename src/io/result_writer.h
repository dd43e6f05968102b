#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "mesh/mesh.h"

namespace asdfvk {

/// What is written beside a mesh: one entry per input face, in file order. Views only.
struct FaceValues {
  std::span<const double> values;   ///< #I, NaN where there is none.
  std::span<const uint8_t> isSeed;  ///< #I, 1 where rays were cast.
};

enum class ResultFormat { Ply, Vtu, Npy, Csv };

/// "ply", "vtu", "npy" or "csv", in any case, with or without a leading dot. Throws Error{Usage} for anything else.
[[nodiscard]] ResultFormat resultFormatNamed(std::string_view name);

struct WriteOptions {
  bool ascii = false;                  ///< PLY only, the others pay it no heed.
  std::optional<ResultFormat> format;  ///< Unset: by the extension of the path. "-" needs it.
};

/// The format that writeResult() would write. Throws Error{Usage} when neither the options nor the extension of `path`
/// tell, so that it can be called before the work begins.
[[nodiscard]] ResultFormat resultFormatOf(const std::filesystem::path& path, const WriteOptions& options = {});

/// Writes whole or not at all (see AtomicFile); "-" is standard output. Vertices are written as float where every
/// coordinate is exactly a float, else as double; values as float (in .csv as double). A face without a value has NaN
/// in .npy and .csv, in .ply and .vtu 0 (and grey). Throws Error{Output} with the reason. Precondition: #I entries in
/// `face`, and every index below the vertex count.
void writeResult(const std::filesystem::path& path, const TriangleMesh& mesh, const FaceValues& face,
                 const WriteOptions& options = {});

}  // namespace asdfvk
