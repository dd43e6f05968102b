#include "io/files_beside.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "core/text.h"
#include "io/file_bytes.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

bool isRelativeName(std::string_view name) {
  if (name.empty() || name.starts_with('/') || name.find('\\') != std::string_view::npos) return false;
  if (std::any_of(name.begin(), name.end(), [](char c) { return '\0' <= c && c < ' '; })) return false;
  if (name.substr(0, name.find('/')).find(':') != std::string_view::npos) return false;  // A scheme.
  const std::vector<std::string> steps = splitAt(name, '/');
  return std::find(steps.begin(), steps.end(), "..") == steps.end();
}

/// The canonical path of a file beside `file`.
std::filesystem::path pathBeside(const std::filesystem::path& file, std::string_view name, std::string_view where) {
  const auto fail = [&](std::string_view reason) {
    failInput(fmt::format("{}: its data is in the file {}, {}", where, quoted(name), reason));
  };
  if (!isRelativeName(name)) fail("which is not a relative name in the folder of this file; export as .glb");
  std::error_code error;
  const std::filesystem::path folder =
      std::filesystem::canonical(file.has_parent_path() ? file.parent_path() : ".", error);
  const std::filesystem::path path = error ? folder : std::filesystem::canonical(folder / name, error);
  if (error) fail(fmt::format("which cannot be opened: {}; export as .glb, or add the file", error.message()));
  if (std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first != folder.end())
    fail("a link to another folder; export as .glb, or copy the file");
  return path;
}

}  // namespace

std::span<const char> FilesBeside::read(std::string_view name, std::string_view where) {
  const std::filesystem::path path = pathBeside(file_, name, where);
  const auto [place, isNew] = files_.try_emplace(path.string());
  if (isNew) {
    place->second = regularFileBytes(path, where);
    byteCount_ += place->second.size();
    inspect_(place->second);
  }
  return place->second;
}

}  // namespace asdfvk
