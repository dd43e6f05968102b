#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The structures of the report as documents and the Python package describe them.
namespace asdfvk {

struct ReportMember {
  std::string name;          ///< The key in JSON.
  std::string pythonType;    ///< "tuple[ThinRegion, ...]"
  std::string documentType;  ///< "list of objects"
  std::string inner;         ///< The structure or enumeration of the value, or of its items; else empty.
  std::string comment;       ///< That of the header.
  bool isOptional = false;   ///< The key may be missing.
};

struct ReportStructure {
  std::string name;
  std::string comment;
  std::vector<ReportMember> members;
};

struct ReportEnumeration {
  std::string name;
  std::vector<std::string> names;     ///< "passed"
  std::vector<std::string> comments;  ///< Those of the enumerators; may be empty.
};

struct ReportModel {
  /// Each after the structures of its members: Report is the last one of reportModel().
  std::vector<ReportStructure> structures;
  std::vector<ReportEnumeration> enumerations;
};

/// Types and keys are those of the compiled report; the comments are read from headers below `sources`.
/// Throws CheckFailure if a member has no comment.
[[nodiscard]] ReportModel reportModel(const std::filesystem::path& sources);

/// The same with the structures of the other JSON documents.
[[nodiscard]] ReportModel documentModel(const std::filesystem::path& sources);

}  // namespace asdfvk
