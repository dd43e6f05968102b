#pragma once

#include <exception>
#include <stop_token>
#include <string>

#include "asdf_vk/files.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

/// A mesh that was read, or the exception that the reader threw.
struct LoadedMesh {
  Mesh mesh;
  /// contentHash() of the file and of the files that it refers to, in the order of reading; empty if not requested.
  std::string hash;
  double seconds = 0;  ///< Time of reading.
  std::exception_ptr failure;
};

/// Whether opening or reading the file may wait for another process.
[[nodiscard]] bool mayWait(const std::string& path);

/// Reads a mesh. If a stop is requested while it waits for a FIFO or standard input, it fails with Error{Cancelled}.
[[nodiscard]] LoadedMesh loadMesh(const std::string& path, const ReadOptions& options, bool computesHash,
                                  const std::stop_token& stop);

/// Reads a mesh from its bytes, without files beside it.
[[nodiscard]] LoadedMesh loadMember(const std::string& name, const std::string& bytes, ReadOptions options,
                                    bool computesHash);

}  // namespace asdfvk
