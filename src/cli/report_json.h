#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "batch/mesh_record.h"
#include "cli/mesh_outcome.h"
#include "core/json.h"

namespace asdfvk {

/// Files of a JSON report.
struct ReportFiles {
  std::string mesh;                                    ///< Path of the mesh.
  std::optional<std::string> output, picture, points;  ///< Path of the file; null if there is no such file.
  std::vector<std::string> with;                       ///< Paths of `--with`.
  std::vector<uint64_t> withFaceCounts;                ///< Faces of these meshes.
  std::optional<std::string> former;                   ///< Path of `--compare`; null if there is no such file.
};
ASDFVK_JSON_KEYS(ReportFiles, mesh, output, picture, points, with, withFaceCounts, former)

/// A mesh without a result, or an invalid command line.
struct FailureDocument {
  int formatVersion = kJsonFormatVersion;  ///< Version of the format of JSON documents.
  std::optional<std::string> mesh;         ///< Path of the mesh; null: the command line is invalid.
  std::string error;                       ///< The reason, as a sentence.
  std::string code;                        ///< Name of the error, such as `unreadableInput`.
};
ASDFVK_JSON_KEYS(FailureDocument, formatVersion, mesh, error, code)

/// A mesh that `--skip-existing` skipped.
struct SkippedDocument {
  int formatVersion = kJsonFormatVersion;   ///< Version of the format of JSON documents.
  std::string mesh;                         ///< Path of the mesh.
  std::optional<std::string> output;        ///< Path of the result.
  MeshStatus status = MeshStatus::Skipped;  ///< `skipped`
  Json record;                              ///< The record of the earlier run.
};
ASDFVK_JSON_KEYS(SkippedDocument, formatVersion, mesh, output, status, record)

/// One line of JSON with the keys of docs/formats.md.
[[nodiscard]] std::string jsonReport(const MeshOutcome& outcome);

/// One line with a FailureDocument. An empty mesh becomes null.
[[nodiscard]] std::string jsonFailure(const std::string& mesh, const std::string& code, const std::string& message);

/// One line with a SkippedDocument.
[[nodiscard]] std::string jsonSkipped(const std::string& mesh, const MeshRecord& record);

}  // namespace asdfvk
