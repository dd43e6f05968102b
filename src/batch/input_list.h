#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace asdfvk {

/// A mesh of a batch.
struct InputFile {
  std::string path;        ///< As given, or a folder of the call and the path below it; "-" for standard input.
  std::string folder;      ///< Of its output, below the folder of the outputs; empty: that folder itself.
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

}  // namespace asdfvk
