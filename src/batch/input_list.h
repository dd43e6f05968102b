#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace asdfvk {

/// A mesh of a batch.
struct InputFile {
  std::string path;        ///< The argument, or a folder of the call and the path below it; "-" for standard input.
  std::string folder;      ///< Folder of its output, relative to the folder of -o; may be empty.
  uint64_t byteCount = 0;  ///< 0 where it is unknown.
};

/// The opening, preparation and writing of a mesh take about as long as this many bytes of its file. Estimated.
inline constexpr uint64_t kBytesPerMesh = 16'384;

struct InputRequest {
  std::vector<std::string> arguments;  ///< Files, "-", and with `recurses` folders.
  bool recurses = false;               ///< Files below folders are inputs.
  std::string list;                    ///< A file with a path per line, "-" for standard input; empty: none.
  bool isNullSeparated = false;        ///< The paths of the list end with a zero byte instead of a line end.
  std::vector<std::string> formats;    ///< Extensions of files below folders, in lower case, without the dot.
  std::string outputFolder;            ///< Not searched; empty: none.
};

/// The inputs in the order of the arguments, those below a folder in ascending order of their paths, then those of the
/// list. Below folders, results of this program (NAME.asdf.ply), hidden files and hidden folders are ignored, and links
/// to folders are not followed. The outputs of a list lie in a tree below its longest common folder. A file that does
/// not exist is an input, and so is a dangling link below a folder. Throws Error{UnreadableInput} for a folder or list
/// that cannot be read.
[[nodiscard]] std::vector<InputFile> listInputs(const InputRequest& request);

/// One of `count` parts of a batch.
struct Shard {
  uint32_t index = 1;  ///< 1 to count.
  uint32_t count = 1;
};

inline constexpr uint32_t kMaxShardCount = 1'000'000;

/// "2/7". Throws Error{OptionOutOfRange}.
[[nodiscard]] Shard parseShard(const std::string& text);

/// The indices of the inputs of the shard, ascending. Every input is in exactly one shard. The inputs are assigned from
/// the largest file to the smallest, each to the shard with the fewest bytes so far, so that the shards have about the
/// same size; kBytesPerMesh is added to each file. The result depends on the paths and sizes only.
[[nodiscard]] std::vector<size_t> selectShard(const std::vector<InputFile>& inputs, const Shard& shard);

}  // namespace asdfvk
