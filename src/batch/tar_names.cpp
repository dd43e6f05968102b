#include "batch/tar_names.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/text.h"
#include "io/formats.h"

namespace asdfvk {

std::string sampleKeyOf(std::string_view name) {
  const size_t slash = name.rfind('/');
  const size_t base = slash == std::string_view::npos ? 0 : slash + 1;
  return std::string(name.substr(0, name.find('.', base)));
}

bool isMeshMember(const std::string& name) {
  const std::filesystem::path path = name;
  const std::string extension = lowerCase(meshExtension(path));
  if (path.filename().native().starts_with('.') || extension.size() < 2) return false;
  if (unpackedName(path).stem().extension() == ".asdf") return false;
  const FileFormat* const format = formatOfExtension(extension);
  return format != nullptr && format->parseMesh != nullptr;
}

bool isSafeMember(std::string_view name) {
  if (name.empty() || name.front() == '/') return false;
  const std::vector<std::string> parts = splitAt(name, '/');
  return std::find(parts.begin(), parts.end(), "..") == parts.end();
}

}  // namespace asdfvk
