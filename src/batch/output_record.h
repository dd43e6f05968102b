#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "batch/mesh_record.h"

namespace asdfvk {

/// Whether a record is written beside the output. False unless the output is a regular file or does not exist:
/// /dev/null, a FIFO or "-" have no record.
[[nodiscard]] bool hasOutputRecord(const std::filesystem::path& output);

/// Path of the record beside an output: "horse.asdf.ply.json".
[[nodiscard]] std::filesystem::path outputRecordPath(const std::filesystem::path& output);

/// Reads the record beside the output; unset if there is none.
[[nodiscard]] std::optional<MeshRecord> readOutputRecord(const std::filesystem::path& output);

/// Returns the record beside the output if the output is up to date; else unset. The record must have no failure and
/// the input hash, options hash, version and commit of `expected`. The bytes of the output must have the recorded hash.
/// The returned record has the status Skipped, and input, output and time of this run.
[[nodiscard]] std::optional<MeshRecord> findFinishedOutput(const MeshRecord& expected,
                                                           const std::filesystem::path& output);

/// Removes the record beside the output. Called before the output is written. If the process is killed before it writes
/// the new record, the output has no record.
void removeOutputRecord(const std::filesystem::path& output);

/// Removes the output and the record beside it. Removes nothing if the bytes of the output do not have the hash of
/// `record`.
void removeOutput(const MeshRecord& record, const std::filesystem::path& output);

/// Removes the output and record of an earlier run after the mesh failed in this run. old: the record of the earlier
/// run. Keeps an output of another mesh, and an output of the same input, options, version and commit. Keeps every
/// output if the input could not be read, because the output may be up to date.
void removeOutdatedOutput(const MeshRecord& old, const MeshRecord& failed, const std::filesystem::path& output);

/// Sets MeshRecord::outputHash and writes the record atomically. Throws Error{OutputNotWritable}.
void writeOutputRecord(MeshRecord& record, const std::filesystem::path& output);

}  // namespace asdfvk
