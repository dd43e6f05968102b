#pragma once

#include <filesystem>

namespace asdfvk {

/// Writes the files of corpusParts(), their answers as truth.json, and README.md. The folder appears as a whole or not
/// at all, always with the same bytes. Throws Error{OutputNotWritable} if a file has this path, if the folder is not
/// empty, or if it cannot be written. Returns the number of parts.
size_t writeCorpus(const std::filesystem::path& folder);

}  // namespace asdfvk
