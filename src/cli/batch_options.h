#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "batch/shard.h"

namespace asdfvk {

/// Options of a call for many meshes.
struct BatchOptions {
  bool recurses = false;         ///< Folders are inputs.
  std::string list;              ///< File with the paths of meshes, "-" for standard input; empty: none.
  bool isNullSeparated = false;  ///< Of the list.
  std::string log;               ///< File to which a record per mesh is appended; empty: none.
  bool skipsExisting = false;
  std::optional<Shard> shard;
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Per mesh.
  uint64_t memoryBytes = 0;                                         ///< Per mesh; 0: no limit.
  bool isolates = false;                                            ///< Meshes are computed in worker processes.
  uint32_t jobCount = 0;                                            ///< Meshes at once; 0: by their sizes.

  /// Whether inputs come from folders or a list, and -o is the root of a tree.
  [[nodiscard]] bool hasTree() const { return recurses || !list.empty(); }
  /// Whether there are records beside the outputs, a progress line and a summary instead of a report per mesh.
  [[nodiscard]] bool isBatch() const { return hasTree() || !log.empty() || skipsExisting || shard || isolates; }
};

/// "500M", "2G", "1.5g" or bytes; powers of 1024. At least 1 byte.
[[nodiscard]] uint64_t parseByteCount(const std::string& text);

}  // namespace asdfvk
