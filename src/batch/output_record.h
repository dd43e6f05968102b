#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "batch/mesh_record.h"

namespace asdfvk {

/// False for outputs that are no regular files, such as /dev/null, a FIFO or "-".
[[nodiscard]] bool hasOutputRecord(const std::filesystem::path& output);

/// Path of the record beside an output: "horse.asdf.ply.json".
[[nodiscard]] std::filesystem::path outputRecordPath(const std::filesystem::path& output);

/// The record beside the output; unset where there is none.
[[nodiscard]] std::optional<MeshRecord> readOutputRecord(const std::filesystem::path& output);

/// The record beside the output if the output is that of `expected`: with the same input hash, options hash, version
/// and commit, without a failure, and with bytes that have the recorded hash. Its paths and its time are those of
/// `expected`, its status is Skipped.
[[nodiscard]] std::optional<MeshRecord> findFinishedOutput(const MeshRecord& expected,
                                                           const std::filesystem::path& output);

/// To be called before the output is written. A process that is killed between the output and its record leaves an
/// output without a record, never one with the record of another output.
void removeOutputRecord(const std::filesystem::path& output);

/// Removes the output and the record beside it; neither where the bytes of the output are not those of `record`.
void removeOutput(const MeshRecord& record, const std::filesystem::path& output);

/// Removes the output of an earlier run, and its record, where the mesh failed now. `old`: the record that lay beside
/// the output before. Keeps an output of another mesh, and an output of the same input, options, version and commit.
/// Keeps any output where the input was not read, because the output may be up to date then.
void removeOutdatedOutput(const MeshRecord& old, const MeshRecord& failed, const std::filesystem::path& output);

/// Writes the record atomically, with the hash of the output. Throws Error{OutputNotWritable}.
void writeOutputRecord(MeshRecord& record, const std::filesystem::path& output);

}  // namespace asdfvk
