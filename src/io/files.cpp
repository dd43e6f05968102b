#include <fmt/format.h>

#include <new>
#include <string>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "asdf_vk/files.h"

namespace asdfvk {

Mesh parseMesh(std::span<const char> bytes, std::string_view extension) {
  if (bytes.empty()) failInput("is empty");
  const FileFormat* const format = detectFormat(bytes, extension);
  if (format == nullptr) failInput(fmt::format("has an unknown format; meshes are read from {}", meshFormatNames()));
  return format->parseMesh(bytes);
}

Mesh readMesh(const std::filesystem::path& path) {
  const std::string name = path == "-" ? "standard input" : path.string();
  try {
    const FileBytes file = FileBytes::read(path);
    return parseMesh(file.bytes(), path.extension().string());
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", name, error.what()));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::InputTooLarge, fmt::format("{}: does not fit into memory", name));
  }
}

}  // namespace asdfvk
