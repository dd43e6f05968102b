#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "batch/mesh_record.h"

namespace asdfvk {

/// Whether a record is written beside the output. Regular files and new files have a record; "-" and an empty path have
/// none.
[[nodiscard]] bool hasOutputRecord(const std::filesystem::path& output);

/// Path of the record beside an output: "horse.asdf.ply.json".
[[nodiscard]] std::filesystem::path outputRecordPath(const std::filesystem::path& output);

[[nodiscard]] std::optional<MeshRecord> readOutputRecord(const std::filesystem::path& output);

/// Returns the record beside the output if the output is up to date, else nothing. An output is up to date if three
/// conditions hold. The record has no failure, or its failure is
/// a verdict (hasVerdictError()). The record has the input hash, options hash, version and commit of
/// `expected`. The bytes of the output have the recorded hash. The returned record has the status Skipped, and the
/// input, output and time of this run.
[[nodiscard]] std::optional<MeshRecord> findFinishedOutput(const MeshRecord& expected,
                                                           const std::filesystem::path& output);

/// Removes the record. Called before the output is written, so that a killed process leaves no outdated record.
void removeOutputRecord(const std::filesystem::path& output);

/// Removes the output and the record beside it. If the output does not have the hash of `record`, removes neither.
void removeOutput(const MeshRecord& record, const std::filesystem::path& output);

/// Removes the output and record of an earlier run after the mesh failed in this run. old: the record of the earlier
/// run. Keeps an output of another mesh, and an output of the same input, options, version and commit. Keeps every
/// output if the input could not be read, because the output may be up to date.
void removeOutdatedOutput(const MeshRecord& old, const MeshRecord& failed, const std::filesystem::path& output);

/// Sets MeshRecord::outputHash and writes the record atomically. Throws Error{OutputNotWritable}.
void writeOutputRecord(MeshRecord& record, const std::filesystem::path& output);

}  // namespace asdfvk
