#include "asdf_vk/files.h"

#include <fmt/format.h>

#include <new>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/text.h"
#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/result_view.h"

namespace asdfvk {
namespace {

/// The result of parse(bytes, extension); errors start with the name of the file.
template <typename Parse>
auto readFile(const std::filesystem::path& path, Parse parse) {
  const std::string name = path == "-" ? "standard input" : path.string();
  try {
    const FileBytes file = FileBytes::read(path);
    return parse(file.bytes(), path.extension().string());
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", name, error.what()));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::InputTooLarge, fmt::format("{}: does not fit into memory", name));
  }
}

bool isMeshFormat(const FileFormat& format) { return format.parseMesh != nullptr; }
bool isFieldFormat(const FileFormat& format) { return format.parseFields != nullptr; }
bool isResultFormat(const FileFormat& format) { return format.write != nullptr; }

const FileFormat& formatFor(std::span<const char> bytes, std::string_view extension,
                            bool (*hasOperation)(const FileFormat&), std::string_view contents) {
  if (bytes.empty()) failInput("is empty");
  const FileFormat* const format = detectFormat(bytes, extension);
  if (format == nullptr || !hasOperation(*format))
    failInput(fmt::format("has {}; {} are read from {}",
                          format == nullptr ? "an unknown format" : fmt::format("the format {}", format->name),
                          contents, namesOfFormatsWith(hasOperation)));
  return *format;
}

const FileFormat& findResultFormat(const std::filesystem::path& path, const std::string& name) {
  const FileFormat* const format = formatOfExtension(name.empty() ? path.extension().string() : name);
  if (format != nullptr && isResultFormat(*format)) return *format;
  const std::string reason = !name.empty() ? fmt::format("'{}' is not a format of results", printable(name))
                             : path == "-" ? std::string("standard output has no extension that names a format")
                                           : fmt::format("the extension of {} does not name a format", path.string());
  throw Error(ErrorCode::UnknownFormat,
              fmt::format("{}; results are written as {}", reason, namesOfFormatsWith(isResultFormat)));
}

}  // namespace

Mesh parseMesh(std::span<const char> bytes, std::string_view extension) {
  return formatFor(bytes, extension, isMeshFormat, "meshes").parseMesh(bytes);
}

Mesh readMesh(const std::filesystem::path& path) {
  return readFile(
      path, [](std::span<const char> bytes, const std::string& extension) { return parseMesh(bytes, extension); });
}

std::vector<std::string> resultFormats() {
  std::vector<std::string> names;
  for (const FileFormat& format : fileFormats())
    if (isResultFormat(format)) names.emplace_back(format.name);
  return names;
}

std::string resultFormatOf(const std::filesystem::path& path, const WriteOptions& options) {
  return std::string(findResultFormat(path, options.format).name);
}

void writeResult(const std::filesystem::path& path, const MeshView& mesh, std::span<const Field> fields,
                 const WriteOptions& options) {
  const FileFormat& format = findResultFormat(path, options.format);
  const ResultView result(mesh, fields, options.fields, options.ascii);
  AtomicFile file(path);
  format.write(file, result);
  file.commit();
}

std::vector<Field> readFields(const std::filesystem::path& path) {
  return readFile(path, [](std::span<const char> bytes, const std::string& extension) {
    return formatFor(bytes, extension, isFieldFormat, "fields").parseFields(bytes);
  });
}

}  // namespace asdfvk
