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
#include "describe/computation_options.h"
#include "render/camera.h"

namespace asdfvk {

struct Outputs {
  std::string path;    ///< Path of the result: a file, a directory or "-" (standard output); empty: beside each input.
  std::string format;  ///< One of outputFormats(). Empty: the extension of `path`; ply if there is none.
  std::vector<std::string> fields;  ///< Names of --fields, in this order; empty: the default of fieldNames().
  bool ascii = false;
  std::string colourOf = {};  ///< See WriteOptions.
  bool coloursVertices = false;
  /// Path of the .png file, "-" for standard output; or a folder that ends in /, see pictureFileOf(). Empty: no
  /// picture.
  std::string picture;
  std::string pictureOf;  ///< Name of the field that the picture shows; empty: see shownField().
  View pictureView;
  bool choosesView = false;  ///< Whether --picture-view is given.
  /// False: the run writes no result. True with -o or another option about the result, and without --fail-if-thinner.
  bool writesResult = true;
  std::string points;      ///< Path of the .ply or .swc file of skeleton points, "-" for standard output; empty: none.
  bool opensPage = false;  ///< Opens the page in the browser.
  std::string reportFormat;        ///< One of checkFormatNames(); empty: no report of checks.
  std::string limits, baseline;    ///< Paths of the files of CheckPolicy; empty: none.
  bool writesRecordsOnly = false;  ///< A tar of answers has records and no results.
  bool updatesBaseline = false;    ///< Writes the baseline instead of comparing with it.
  std::string report = "-";        ///< Path of the report of checks; "-" for standard output.
  bool json = false;
  bool quiet = false;
  bool verbose = false;  ///< Prints the full report and the lines about devices.

  /// Whether the records of all meshes are kept until the end of the run.
  [[nodiscard]] bool needsRecords() const { return !reportFormat.empty() || updatesBaseline; }
};

struct BatchOptions {
  bool readsTars = false;        ///< Inputs are tars of meshes.
  bool keepsMembers = false;     ///< Tars of answers also have the members of their inputs.
  bool recurses = false;         ///< Arguments may be folders: all meshes below them are inputs.
  std::string list;              ///< Path of the file that lists meshes, "-" for standard input; empty: none.
  bool isNullSeparated = false;  ///< The paths of the list end with a zero byte.
  std::string log;               ///< File to which a record per mesh is appended; empty: none.
  bool skipsExisting = false;
  std::optional<Shard> shard;
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Time limit per mesh.
  uint64_t memoryBytes = 0;                                         ///< Memory limit per mesh; 0: no limit.
  bool isolates = false;                                            ///< Computes meshes in worker processes.
  uint32_t jobCount = 0;  ///< Number of meshes that are computed at once; 0: the sizes of the meshes decide.

  /// Whether inputs come from folders or a list. If true, -o is the root of a tree of results.
  [[nodiscard]] bool hasTree() const { return recurses || !list.empty(); }
  /// Whether the run is a batch. In a batch, a record is written beside each output, and a progress line and a summary
  /// replace the reports.
  [[nodiscard]] bool isBatch() const {
    return hasTree() || readsTars || !log.empty() || skipsExisting || shard || isolates;
  }
};

/// Names of the fields to write: Outputs::fields, or by default the fields that the options compute.
[[nodiscard]] std::vector<std::string> fieldNames(const Outputs& outputs, const Options& options);

/// Name and extension of the format of pages, which src/page writes.
inline constexpr const char* kPageFormat = "html";

[[nodiscard]] std::vector<std::string> outputFormats();

[[nodiscard]] bool writesPages(const Outputs& outputs);

[[nodiscard]] bool writesOnePage(const Outputs& outputs);

/// Whether meshes are compared with limits: those of options, or of a file of limits.
[[nodiscard]] bool isCheck(const ComputationSettings& computation, const Outputs& outputs);

/// Whether Outputs::picture is a folder, for a picture of each mesh that fails the check, or of each mesh without
/// check.
[[nodiscard]] bool hasPictureFolder(const Outputs& outputs);

/// The path of the picture of an input. In a folder of pictures: NAME.asdf.png in the same subfolder as the result.
[[nodiscard]] std::string pictureFileOf(const InputFile& input, const Outputs& outputs);

/// Returns the path of the result of each input, "-" for standard output, empty for no result. If
/// BatchOptions::hasTree(), results are in a tree below -o, whose folders need not exist. Throws Error{OptionConflict}
/// in three cases: two outputs (results, records, log, picture, points) have the same path; an output is also an input;
/// several meshes have one output that is not a page.
[[nodiscard]] std::vector<std::string> planOutputs(const Outputs& outputs, const BatchOptions& batch,
                                                   std::span<const InputFile> inputs);

/// Options for writeResult(). Precondition: the output is not a page.
[[nodiscard]] WriteOptions writeOptionsOf(const Outputs& outputs, const Options& options);

/// The fields of a result that the output holds. With PerElement::Vertices, formats that hold either faces or vertices
/// (.csv, .npy) hold the vertex fields only. Precondition: vertex fields follow face fields.
[[nodiscard]] std::span<const Field> writableFields(const WriteOptions& options, PerElement per,
                                                    const std::string& output, std::span<const Field> fields);

/// Creates the folder of the file `output`. Throws Error{OutputNotWritable}.
void makeFolderOf(const std::string& output);

/// Throws Error{OutputNotWritable} if the file cannot be written. Called before the computation, so that the user need
/// not wait for this error.
void requireWritablePlace(const std::string& output);

}  // namespace asdfvk
