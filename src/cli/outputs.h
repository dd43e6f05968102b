#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "asdf_vk/options.h"
#include "batch/input_list.h"
#include "render/camera.h"

namespace asdfvk {

/// What is written and printed, and where.
struct Outputs {
  std::string path;                 ///< Path of the result: a file, a directory, "-"; empty: beside each input.
  std::string format;               ///< A name of outputFormats(); empty: by `path`, else ply.
  std::vector<std::string> fields;  ///< Names of --fields, in this order; empty: the default ones, see fieldNames().
  bool ascii = false;
  std::string colourOf = {};  ///< See WriteOptions.
  bool coloursVertices = false;
  std::string picture;            ///< A .png, "-" for standard output; empty: none.
  std::string pictureOf = "sdf";  ///< Name of the field to show; empty: the thin places.
  View pictureView;
  bool choosesView = false;  ///< --picture-view is given.
  std::string points;        ///< A .ply or .swc for the skeleton points, "-" for standard output; empty: none.
  bool opensPage = false;    ///< Start the browser with the page.
  bool json = false;
  bool quiet = false;
  bool verbose = false;  ///< The full report, and the lines of the device.
};

/// Options of a call for many meshes.
struct BatchOptions {
  bool recurses = false;         ///< Folders are inputs.
  std::string list;              ///< File with the paths of meshes, "-" for standard input; empty: none.
  bool isNullSeparated = false;  ///< The paths of the list end with a zero byte.
  std::string log;               ///< File to which a record per mesh is appended; empty: none.
  bool skipsExisting = false;
  std::optional<Shard> shard;
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Per mesh.
  uint64_t memoryBytes = 0;                                         ///< Per mesh; 0: no limit.
  bool isolates = false;                                            ///< Meshes are computed in worker processes.
  uint32_t jobCount = 0;                                            ///< Meshes at once; 0: by their sizes.

  /// Whether inputs come from folders or a list, and -o is the root of a tree.
  [[nodiscard]] bool hasTree() const { return recurses || !list.empty(); }
  /// Whether there are records beside the outputs, a progress line and a summary instead of a report per mesh.
  [[nodiscard]] bool isBatch() const { return hasTree() || !log.empty() || skipsExisting || shard || isolates; }
};

/// "500M", "2G", "1.5g" or bytes; powers of 1024. At least 1 byte; unset for another text.
[[nodiscard]] std::optional<uint64_t> parseByteCount(const std::string& text);

/// The fields to write: those of `outputs`, or by default those that the options compute.
[[nodiscard]] std::vector<std::string> fieldNames(const Outputs& outputs, const Options& options);

/// Name and extension of the format of pages, which src/viewer writes.
inline constexpr const char* kPageFormat = "html";

/// resultFormats() and kPageFormat.
[[nodiscard]] std::vector<std::string> outputFormats();

/// Whether the results are written as pages.
[[nodiscard]] bool writesPages(const Outputs& outputs);

/// Whether all results are written to one page.
[[nodiscard]] bool writesOnePage(const Outputs& outputs);

/// Path of the result of each input, "-" for standard output. With a tree, the results lie in a tree below -o, whose
/// folders need not exist. Throws Error{OptionConflict} if two outputs (results, their records, log, picture, points)
/// have the same path, if an output is an input, or if several meshes have one output file that is no page.
[[nodiscard]] std::vector<std::string> planOutputs(const Outputs& outputs, const BatchOptions& batch,
                                                   std::span<const InputFile> inputs);

/// For other formats than pages: the fields of --fields, and the format if --format is given or the output is standard
/// output.
[[nodiscard]] WriteOptions writeOptionsOf(const Outputs& outputs, const Options& options);

/// The fields of a result that the output can hold together: all, but the vertex fields only where the format has
/// either rows per face or rows per vertex. Precondition: vertex fields follow face fields.
[[nodiscard]] std::span<const Field> writableFields(const WriteOptions& options, PerElement per,
                                                    const std::string& output, std::span<const Field> fields);

/// Makes the folder of a file. Throws Error{OutputNotWritable}.
void makeFolderOf(const std::string& output);

/// Throws Error{OutputNotWritable} where no file can be written: a check before the work begins.
void requireWritablePlace(const std::string& output);

}  // namespace asdfvk
