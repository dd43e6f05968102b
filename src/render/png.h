#pragma once

#include <filesystem>
#include <vector>

#include "render/image.h"

namespace asdfvk {

class AtomicFiles;

/// The bytes of a PNG file: 8 bits per channel, RGB, sRGB.
[[nodiscard]] std::vector<char> encodePng(const Image& image);

/// Writes the file atomically (see AtomicFile); "-" is standard output. Throws Error{Output} with the reason.
void writePng(const std::filesystem::path& path, const Image& image);
/// The file appears when the caller commits the group.
void writePng(AtomicFiles& files, const std::filesystem::path& path, const Image& image);

}  // namespace asdfvk
