#pragma once

#include <span>
#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "batch/input_list.h"
#include "cli/options.h"

namespace asdfvk {

/// Name and extension of the format of pages, which src/page writes.
inline constexpr const char* kPageFormat = "html";

/// resultFormats() and kPageFormat.
[[nodiscard]] std::vector<std::string> outputFormats();

/// Whether the results are written as pages.
[[nodiscard]] bool writesPages(const Outputs& outputs);

/// Whether all results are written to one page.
[[nodiscard]] bool writesOnePage(const Outputs& outputs);

/// Path of the result of each mesh, "-" for standard output. Throws Error{OptionConflict} if two outputs (results,
/// their records, log, picture, points) have the same path, if an output is an input, or if several meshes have one
/// output file that is no page.
[[nodiscard]] std::vector<std::string> planOutputs(const CommandLine& line);

/// The same for the inputs of a batch; their results lie in a tree below -o, whose folders need not exist.
[[nodiscard]] std::vector<std::string> planOutputs(const CommandLine& line, std::span<const InputFile> inputs);

/// For other formats than pages: the fields of --fields, and the format if --format is given or the output is standard
/// output.
[[nodiscard]] WriteOptions writeOptionsOf(const Outputs& outputs, const Options& options);

/// The fields of a result that the output can hold together: all, but the vertex fields only where the format has
/// either rows per face or rows per vertex. Precondition: vertex fields follow face fields.
[[nodiscard]] std::span<const Field> writableFields(const WriteOptions& options, PerElement per,
                                                    const std::string& output, std::span<const Field> fields);

/// Throws Error{OutputNotWritable} where no file can be written: a check before the work begins.
void requireWritablePlace(const std::string& output);

}  // namespace asdfvk
