#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch/scheduler_shard.h"

namespace asdfvk {

struct InputFile {
  /// Path of the file: an argument, a path below a folder argument, or a line of the list. "-" for standard input.
  std::string path;
  std::string folder;      ///< Folder of the output, relative to the folder of -o; may be empty.
  uint64_t byteCount = 0;  ///< Size of the file; 0 if unknown.
  /// Name of the mesh in the list, which replaces the file name in the names of outputs; empty: none. A relative path
  /// without "." and ".."; its folders are in `folder`.
  std::string key;
};

/// Estimated time per mesh that does not depend on its size (opening, preparing, writing). Unit: bytes of a mesh file
/// that take the same time to compute.
inline constexpr uint64_t kBytesPerMesh = 16'384;

struct InputRequest {
  std::vector<std::string> arguments;  ///< Files, "-", and (if `recurses`) folders.
  bool recurses = false;               ///< Whether meshes below folders are inputs.
  /// Path of a file with one path per line, or a path, a tab and a key; "-" for standard input; empty: none.
  std::string list;
  bool isNullSeparated = false;      ///< The paths of the list end with a zero byte, and have no keys.
  std::vector<std::string> formats;  ///< Extensions of meshes below folders, in lower case and without the dot.
  std::string outputFolder;          ///< Folder that is not searched; empty: none.
};

/// Returns the inputs: first the arguments in their order, then the list. Meshes below a folder are in ascending order
/// of their paths. Below folders, results of this program (NAME.asdf.ply), also compressed
/// ones (NAME.asdf.ply.gz), hidden files and hidden folders are ignored,
/// and links to folders are not followed. For a list, InputFile::folder is relative to the longest common folder of the
/// paths without a key. A file that does not exist is also an input, as is a dangling link below a folder. Throws
/// Error{UnreadableInput} for a folder or list that cannot be read, and for a key that is unsafe or occurs twice.
[[nodiscard]] std::vector<InputFile> listInputs(const InputRequest& request);

struct Shard {
  uint32_t index = 1;  ///< 1 to count.
  uint32_t count = 1;
  std::string variable;  ///< The variable of a scheduler that determined the index; empty: none.
};

inline constexpr uint32_t kMaxShardCount = 1'000'000;

/// Reads a shard such as "2/7", or "auto" or "auto/7" (shardOfScheduler()). Throws Error{OptionOutOfRange}.
[[nodiscard]] Shard parseShard(const std::string& text);
[[nodiscard]] Shard parseShard(const std::string& text, const EnvironmentLookup& lookup);

/// Returns the indices of the inputs of the shard, ascending. Every input is in exactly one shard. To balance the
/// shards, inputs are assigned in the order of decreasing file size. Each input goes to the shard with the fewest bytes
/// so far. kBytesPerMesh is added to the size of each file. The result depends on paths and sizes only.
[[nodiscard]] std::vector<size_t> selectShard(const std::vector<InputFile>& inputs, const Shard& shard);

}  // namespace asdfvk
