#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "batch/mesh_record.h"

namespace asdfvk {

/// Formats in which services of continuous integration take results of checks.
enum class CheckFormat {
  Sarif,   ///< Static Analysis Results Interchange Format 2.1.0 (OASIS), for example for code scanning.
  Junit,   ///< The common form of JUnit's XML: a test case for each mesh.
  Github,  ///< Workflow commands of GitHub Actions: a line for each finding, which becomes an annotation.
};
inline constexpr std::array<std::pair<const char*, CheckFormat>, 3> kCheckFormats{
    {{"sarif", CheckFormat::Sarif}, {"junit", CheckFormat::Junit}, {"github", CheckFormat::Github}}};

[[nodiscard]] std::vector<std::string> checkFormatNames();
/// Precondition: one of checkFormatNames().
[[nodiscard]] CheckFormat checkFormatOf(std::string_view name);

/// The findings and failures of the records in one document. Findings of the level "note" are left out of JUnit.
[[nodiscard]] std::string checkReport(CheckFormat format, std::span<const MeshRecord> records);

/// A finding of MeshRecord::findings, or the failure of a mesh without a result.
struct CheckItem {
  std::string kind;     ///< The name of a FindingKind, or MeshRecord::error.
  std::string level;    ///< The name of a FindingLevel, or "error" for a failure.
  std::string message;  ///< With the remedy.
  Json finding;         ///< Null for a failure.
};
[[nodiscard]] std::vector<CheckItem> checkItemsOf(const MeshRecord& record);

[[nodiscard]] std::string sarifOf(std::span<const MeshRecord> records);
[[nodiscard]] std::string junitOf(std::span<const MeshRecord> records);
[[nodiscard]] std::string githubAnnotationsOf(std::span<const MeshRecord> records);

}  // namespace asdfvk
