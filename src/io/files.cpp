#include "io/files.h"

#include <fmt/core.h>

#include <new>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/text.h"
#include "core/unset_vector.h"
#include "io/file_bytes.h"
#include "io/files_beside.h"
#include "io/foreign_formats.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/mesh_content.h"
#include "io/result_view.h"

namespace asdfvk {
namespace {

using HasOperation = bool (*)(const FileFormat& format);
bool isMeshFormat(const FileFormat& format) { return format.parseMesh != nullptr; }
bool isResultFormat(const FileFormat& format) { return format.write != nullptr; }

std::vector<std::string> namesOf(HasOperation hasOperation) {
  std::vector<std::string> names;
  for (const FileFormat* const format : fileFormats())
    if (hasOperation(*format)) names.emplace_back(format->name);
  return names;
}

/// The names of the formats that have the operation, for example "stl, ply or off".
std::string listOf(HasOperation hasOperation) { return enumeration(namesOf(hasOperation), "or"); }

const FileFormat& findResultFormat(const std::filesystem::path& path, const std::string& name) {
  const FileFormat* const format = formatOfExtension(name.empty() ? path.extension().string() : name);
  if (format != nullptr && isResultFormat(*format)) return *format;
  const std::string reason = !name.empty() ? fmt::format("'{}' is not a format of results", printable(name))
                             : path == "-" ? std::string("standard output has no extension that names a format")
                                           : fmt::format("the extension of {} does not name a format", path.string());
  throw Error(ErrorCode::UnknownFormat, fmt::format("{}; results are written as {}", reason, listOf(isResultFormat)));
}

/// The extension that decides the format of an ambiguous content.
std::string extensionFor(const MeshSource& file) {
  const std::string& format = file.options.format;
  if (format.empty()) return meshExtension(file.path);
  return meshExtension("mesh." + format.substr(format.starts_with('.') ? 1 : 0));
}

[[noreturn]] void failTooLarge() { throw Error(ErrorCode::InputTooLarge, "does not fit into memory"); }

Mesh parse(const MeshSource& file) try {
  if (file.bytes.empty()) failInput("is empty");
  const MeshContent content(file);
  const MeshSource& source = content.source();
  const FileFormat* format = certainFormat(source.bytes);
  const std::string extension = extensionFor(file);
  if (format == nullptr) {
    if (const std::string reason = foreignContent(source.bytes); !reason.empty()) failInput(reason);
    format = uncertainFormat(source.bytes, extension);
  }
  if (format == nullptr)
    if (const std::string reason = foreignExtension(extension); !reason.empty()) failInput(reason);
  if (format == nullptr || !isMeshFormat(*format))
    failInput(fmt::format("has {}; meshes are read from {}",
                          format == nullptr ? "an unknown format" : fmt::format("the format {}", format->name),
                          listOf(isMeshFormat)));
  Mesh mesh = format->parseMesh(source);
  requireFaceCount(mesh.inputFaceCount(), source);
  return mesh;
} catch (const std::bad_alloc&) {
  failTooLarge();
}

UnsetVector<char> allBytesOf(const std::filesystem::path& path) try {
  return fileBytes(path);
} catch (const std::bad_alloc&) {
  failTooLarge();
}

}  // namespace

Mesh parseMesh(std::span<const char> bytes, const ReadOptions& options) {
  return parse({.bytes = bytes, .options = options});
}

Mesh readMesh(const std::filesystem::path& path, const ReadOptions& options,
              const std::function<void(std::span<const char>)>& inspect) {
  const std::string name = path == "-" ? "standard input" : path.string();
  try {
    const UnsetVector<char> bytes = allBytesOf(path);
    inspect(bytes);
    if (path == "-") return parse({.bytes = bytes, .options = options});
    FilesBeside beside(path, inspect);
    return parse({.bytes = bytes, .path = path, .options = options, .beside = &beside});
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", name, error.what()), error.details());
  }
}

Mesh readMesh(const std::filesystem::path& path, const ReadOptions& options) {
  return readMesh(path, options, [](std::span<const char>) {});
}

std::filesystem::path besidePathOf(const std::filesystem::path& path) { return path.string() + ".mtl"; }

std::vector<std::string> meshFormats() { return namesOf(isMeshFormat); }
std::vector<std::string> meshExtensions() {
  std::vector<std::string> extensions;
  for (const FileFormat* format : fileFormats())
    for (const std::string_view extension : format->extensions)
      if (isMeshFormat(*format) && !extension.empty()) extensions.emplace_back(extension);
  return extensions;
}
std::vector<std::string> resultFormats() { return namesOf(isResultFormat); }

std::string resultFormatOf(const std::filesystem::path& path, const WriteOptions& options) {
  return std::string(findResultFormat(path, options.format).name);
}

void writeResult(const std::filesystem::path& path, const MeshView& mesh, std::span<const Field> fields,
                 const WriteOptions& options) {
  AtomicFiles files;
  writeResult(files, path, mesh, fields, options);
  files.commit();
}

void writeResult(AtomicFiles& files, const std::filesystem::path& path, const MeshView& mesh,
                 std::span<const Field> fields, const WriteOptions& options) {
  const FileFormat& format = findResultFormat(path, options.format);
  ResultView result(mesh, fields, options.fields, {options.ascii, options.colourOf, options.coloursVertices});
  if (!format.writesDoubles)
    for (const Field& field : result.fields())
      if (field.reals() != nullptr) requireSingles(*field.reals(), "'" + field.name + "'");
  std::error_code ignored;
  const bool isNamed =
      path != "-" && (std::filesystem::is_regular_file(path, ignored) || !std::filesystem::exists(path, ignored));
  if (format.needsBeside != nullptr && isNamed && format.needsBeside(result)) {
    const std::filesystem::path besidePath = besidePathOf(path);
    result.setBesideName(besidePath.filename().string());
    files.write(besidePath, [&](AtomicFile& file) { format.writeBeside(file, result); });
  }
  files.write(path, [&](AtomicFile& file) { format.write(file, result); });
}

}  // namespace asdfvk
