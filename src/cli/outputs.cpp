#include "cli/outputs.h"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <unordered_map>
#include <utility>

#include "asdf_vk/error.h"
#include "batch/output_record.h"
#include "core/atomic_file.h"
#include "core/text.h"
#include "describe/default_fields.h"
#include "io/formats.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void usageError(const std::string& message) { throw Error(ErrorCode::OptionConflict, message); }

constexpr const char* kTarFormat = "tar";

/// The name of a result, for example "horse.asdf.vtu" for "dir/horse.ply" or for the key "dir/horse".
std::string resultName(const InputFile& input, const std::string& format) {
  std::string stem = !input.key.empty()  ? fs::path(input.key).filename().string()
                     : input.path == "-" ? "stdin"
                                         : fs::path(input.path).stem().string();
  if (format == kTarFormat && stem.ends_with(".tar")) stem.resize(stem.size() - 4);  // A compressed tar.
  return stem + ".asdf." + (format.empty() ? "ply" : format);
}

bool isPageName(const fs::path& path) { return lowerCase(path.extension().string()) == ".html"; }

/// resultFormatOf() with an error that names the formats of this program.
std::string plannedFormat(const std::string& output, const WriteOptions& options) {
  try {
    return resultFormatOf(output, options);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::UnknownFormat) throw;
    throw Error(ErrorCode::UnknownFormat, fmt::format("the extension of {} does not name a format; the formats are {}",
                                                      output, joined(outputFormats(), ", ")));
  }
}

/// The format that the extension of `path` names; empty if the extension names no format.
std::string formatNamedBy(const fs::path& path) {
  if (isPageName(path)) return kPageFormat;
  try {
    return resultFormatOf(path);
  } catch (const Error&) {
    return {};
  }
}

bool isFolder(const std::string& output) {
  std::error_code ignored;
  return output.ends_with('/') || (!output.empty() && fs::is_directory(output, ignored));
}

bool takesFolder(const Outputs& outputs, const BatchOptions& batch) {
  return !outputs.path.empty() && (batch.hasTree() || isFolder(outputs.path));
}

std::string planOutput(const InputFile& input, const Outputs& outputs, const BatchOptions& batch) {
  const std::string& mesh = input.path;
  const std::string format = batch.readsTars ? kTarFormat : outputs.format;
  if (!outputs.writesResult) return {};
  if (outputs.path == "-") return "-";
  if (takesFolder(outputs, batch)) return (fs::path(outputs.path) / input.folder / resultName(input, format)).string();
  if (!outputs.path.empty()) return outputs.path;
  if (mesh == "-") usageError("a mesh from standard input has no file name; give -o FILE or -o -");
  if (!input.key.empty() && !input.folder.empty())
    usageError(fmt::format("the key {} of {} has a folder, which is made below -o; give -o FOLDER", input.key, mesh));
  return (fs::path(mesh).parent_path() / resultName(input, format)).string();
}

std::string normalised(const fs::path& path) {
  std::error_code ignored;
  return fs::absolute(followLinks(path), ignored).lexically_normal().string();
}

/// Finds files that a run would use twice, for example as an input and as an output. Existing files are compared by
/// device and inode, missing files by normalised path.
class FileUses {
 public:
  /// Returns the earlier use of the file. If there is none, adds `use` and returns an empty text.
  std::string add(const std::string& path, const std::string& use) {
    std::string& ofName = useOfName_[normalised(path)];
    struct stat status {};
    std::string& ofFile = ::stat(path.c_str(), &status) == 0 ? useOfFile_[{status.st_dev, status.st_ino}] : ofName;
    if (!ofName.empty()) return ofName;
    if (!ofFile.empty()) return ofFile;
    ofName = ofFile = use;
    return {};
  }

 private:
  std::unordered_map<std::string, std::string> useOfName_;
  std::map<std::pair<dev_t, ino_t>, std::string> useOfFile_;
};

}  // namespace

std::vector<std::string> fieldNames(const Outputs& outputs, const Options& options) {
  return outputs.fields.empty() ? defaultFieldNames(options) : outputs.fields;
}

std::vector<std::string> outputFormats() {
  std::vector<std::string> formats = resultFormats();
  formats.emplace_back(kPageFormat);
  return formats;
}

bool writesPages(const Outputs& outputs) {
  if (!outputs.format.empty()) return outputs.format == kPageFormat;
  return isPageName(outputs.path) && !isFolder(outputs.path);
}

bool writesOnePage(const Outputs& outputs) {
  return writesPages(outputs) && (isPageName(outputs.path) || outputs.path == "-") && !isFolder(outputs.path);
}

bool isCheck(const ComputationSettings& computation, const Outputs& outputs) {
  return computation.isCheck() || !outputs.limits.empty();
}

bool hasPictureFolder(const Outputs& outputs) { return outputs.picture.ends_with('/'); }

std::string pictureFileOf(const InputFile& input, const Outputs& outputs) {
  if (!hasPictureFolder(outputs)) return outputs.picture;
  return (fs::path(outputs.picture) / input.folder / resultName(input, "png")).string();
}

std::vector<std::string> planOutputs(const Outputs& outputs, const BatchOptions& batch,
                                     std::span<const InputFile> files) {
  const bool sharePage = writesOnePage(outputs);
  if (batch.hasTree() && !outputs.path.empty() && !isFolder(outputs.path)) {
    std::error_code ignored;
    if (fs::exists(outputs.path, ignored) || !formatNamedBy(outputs.path).empty())
      usageError(fmt::format("-o {} is not a folder; -r and --files-from need a folder", outputs.path));
  } else if (files.size() > 1 && !sharePage) {
    if (outputs.path == "-") usageError("standard output (-o -) holds one result; name one mesh");
    if (!outputs.path.empty() && !takesFolder(outputs, batch))
      usageError(fmt::format(
          "-o {0} is not a folder, but several meshes need a folder; write {0}/ to create the folder, or name one mesh",
          outputs.path));
  }

  WriteOptions options = writeOptionsOf(outputs, {});
  if (batch.readsTars && options.format.empty()) options.format = "ply";
  std::vector<std::string> paths;
  std::unordered_map<std::string, std::string> meshOfOutput;
  for (const InputFile& file : files) {
    const std::string& mesh = file.path;
    const std::string output = planOutput(file, outputs, batch);
    if (output.empty()) {
      paths.emplace_back();
      continue;
    }
    const std::string format = writesPages(outputs) ? kPageFormat : plannedFormat(output, options);
    const FileFormat* const row = formatOfExtension(format);
    if (outputs.ascii && (row == nullptr || !row->hasText)) usageError("--ascii is for PLY only; drop it");
    if (outputs.coloursVertices && (row == nullptr || !row->coloursByChoice))
      usageError("--vertex-colours is for PLY only; drop it");
    if (output != "-") {
      const std::string named = formatNamedBy(output);
      if (batch.readsTars && !named.empty())
        usageError(
            fmt::format("-o {} names a file of the format {}; --tar writes a tar: give -o FILE.tar", output, named));
      if (!named.empty() && named != format)
        usageError(fmt::format("-o {} and --format {} contradict each other; drop one", output, outputs.format));
      const auto [other, isNew] = meshOfOutput.emplace(normalised(output), mesh);
      if (!isNew && !sharePage && normalised(other->second) == normalised(mesh))
        usageError(fmt::format("{} is named twice; name it once", mesh));
      if (!isNew && !sharePage)
        usageError(fmt::format("{} and {} would both be written to {}; {}", other->second, mesh, output,
                               batch.hasTree()
                                   ? "rename one of the two, or compute it in a separate call with another -o"
                                   : "run asdf-vk once per mesh, with different -o"));
    }
    paths.push_back(output);
  }
  FileUses uses;
  for (const InputFile& file : files)
    if (file.path != "-") uses.add(file.path, "an input");
  if (!batch.list.empty() && batch.list != "-") uses.add(batch.list, "the list of --files-from");
  if (!outputs.limits.empty()) uses.add(outputs.limits, "the file of --limits");
  const auto plan = [&uses](const std::string& path, const std::string& use, const char* option) {
    if (path.empty() || path == "-") return;
    if (const std::string other = uses.add(path, use); !other.empty())
      usageError(fmt::format("{} is {} and would be overwritten by {}; choose another {}", path, other, use, option));
  };
  for (size_t i = 0; i < (sharePage ? 1 : paths.size()); ++i) {
    plan(paths[i], "the result of " + files[i].path, "-o");
    if (batch.isBatch() && !paths[i].empty())
      plan(outputRecordPath(paths[i]).string(), "the record of " + paths[i], "-o");
  }
  if (!hasPictureFolder(outputs)) plan(outputs.picture, "the picture", "--picture");
  for (size_t i = 0; hasPictureFolder(outputs) && i < files.size(); ++i)
    plan(pictureFileOf(files[i], outputs), "the picture of " + files[i].path, "--picture");
  plan(outputs.points, "the points", "--points");
  if (!outputs.reportFormat.empty()) plan(outputs.report, "the report of checks", "--report");
  if (outputs.updatesBaseline) plan(outputs.baseline, "the baseline", "--baseline");
  plan(batch.log, "the log", "--log");
  return paths;
}

WriteOptions writeOptionsOf(const Outputs& outputs, const Options& options) {
  return {.format = outputs.path == "-" && outputs.format.empty() ? "ply" : outputs.format,
          .fields = fieldNames(outputs, options),
          .ascii = outputs.ascii,
          .colourOf = outputs.colourOf,
          .coloursVertices = outputs.coloursVertices};
}

std::span<const Field> writableFields(const WriteOptions& options, PerElement per, const std::string& output,
                                      std::span<const Field> fields) {
  if (per == PerElement::Faces) return fields;
  if (!formatOfExtension(resultFormatOf(output, options))->holdsOneLocation) return fields;
  const auto first = std::find_if(fields.begin(), fields.end(),
                                  [](const Field& field) { return field.location == FieldLocation::PerVertex; });
  return {first, fields.end()};
}

void makeFolderOf(const std::string& output) {
  const fs::path folder = fs::path(output).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("{} cannot be written: {}: {}", output, folder.string(), error.message()));
}

void requireWritablePlace(const std::string& output) {
  if (output == "-") return;
  const fs::path path = followLinks(output);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const auto fail = [&](const std::string& reason) {
    throw Error(ErrorCode::OutputNotWritable, fmt::format("{} cannot be written: {}", output, reason));
  };
  std::error_code error;
  const fs::file_status status = fs::status(output, error);
  // A device or a FIFO is opened without a temporary file. Therefore its folder need not be writable.
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return;
  const std::error_code reason = fs::status_known(status) ? std::error_code() : error;
  if (!fs::is_directory(folder, error)) fail(fmt::format("{} is not a directory; create it first", folder.string()));
  if (access(folder.c_str(), W_OK) != 0) fail(fmt::format("{}: {}", folder.string(), std::strerror(errno)));
  if (fs::is_directory(status)) fail("it is a directory; choose another name");
  if (reason == std::errc::filename_too_long) fail("its name is too long; choose a shorter one");
  if (reason) fail(reason.message());
}

}  // namespace asdfvk
