#include "documents/report_model.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>

#include "batch/log_summary.h"
#include "cli/baseline.h"
#include "cli/device_documents.h"
#include "cli/report_json.h"
#include "core/check.h"
#include "core/text.h"
#include "describe/report_keys.h"
#include "serve/line_protocol.h"

namespace asdfvk {
namespace {

/// Reads the comments of structures, members and enumerators from headers. Of C++ it knows only that a
/// declaration is one line, and that its comment ends the line ("///<") or is in the lines before ("///").
class Comments {
 public:
  explicit Comments(const std::filesystem::path& sources) {
    for (const char* const name :
         {"include/asdf_vk/finding.h", "include/asdf_vk/thickness_report.h", "include/asdf_vk/report.h",
          "src/describe/report_json.h", "src/diagnose/device_report.h", "src/batch/mesh_record.h",
          "src/batch/log_summary.h", "src/serve/mesh_request.h", "src/serve/line_protocol.h", "src/cli/report_json.h",
          "src/cli/device_documents.h", "src/cli/baseline.h"}) {
      std::ifstream in(sources / name);
      for (std::string line; std::getline(in, line);) lines_.push_back(line);
    }
  }

  [[nodiscard]] std::string ofType(const std::string& type) const { return commentAt(beginOf(type)); }

  [[nodiscard]] size_t enumeratorCount(const std::string& type) const {
    size_t count = 0;
    for (size_t line = beginOf(type) + 1; lines_[line] != "};"; ++line)
      count += lines_[line].find(',') < lines_[line].find("//") ? 1 : 0;
    return count;
  }

  /// member: a member or an enumerator. Empty without a comment.
  [[nodiscard]] std::string ofMember(const std::string& type, const std::string& member) const {
    for (size_t line = beginOf(type) + 1; lines_[line] != "};"; ++line) {
      const std::string_view declaration = std::string_view(lines_[line]).substr(0, lines_[line].find("///"));
      if (declares(declaration, member)) return commentAt(line);
    }
    return {};
  }

 private:
  [[nodiscard]] size_t beginOf(const std::string& type) const {
    for (size_t line = 0; line < lines_.size(); ++line)
      if (lines_[line] == "struct " + type + " {" || lines_[line] == "enum class " + type + " {") return line;
    ASDFVK_CHECK(!"the header of the type is not read");
    return 0;
  }

  /// Whether the name is a word of the declaration before "=", ",", ";" or the end.
  static bool declares(std::string_view declaration, std::string_view name) {
    for (size_t at = declaration.find(name); at != declaration.npos; at = declaration.find(name, at + 1)) {
      const std::string_view before = declaration.substr(0, at), after = declaration.substr(at + name.size());
      const bool begins = before.ends_with(' '), isLast = after.find_first_not_of(' ') == after.npos;
      if (begins && (isLast || after.starts_with(" =") || after.starts_with(',') || after.starts_with(';')))
        return true;
    }
    return false;
  }

  [[nodiscard]] std::string commentAt(size_t line) const {
    constexpr std::string_view kTrailing = "///< ", kBefore = "/// ";
    if (const size_t at = lines_[line].find(kTrailing); at != std::string::npos)
      return lines_[line].substr(at + kTrailing.size());
    const auto textOf = [&](size_t index) {
      const size_t at = std::min(lines_[index].find_first_not_of(' '), lines_[index].size());
      const std::string_view text = std::string_view(lines_[index]).substr(at);
      return text.starts_with(kBefore) ? text.substr(kBefore.size()) : std::string_view();
    };
    size_t first = line;
    while (first > 0 && !textOf(first - 1).empty()) --first;
    std::vector<std::string> texts;
    for (; first < line; ++first) texts.emplace_back(textOf(first));
    return joined(texts, " ");
  }

  std::vector<std::string> lines_;
};

template <typename T>
concept IsEnumeration = requires(const T& value) {
  choicesOf(value);
};
template <typename T>
concept IsStructure = requires(const T& value) {
  structureName(value);
};

std::string quoted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "`" : ", `") + name + "`";
  return text;
}

class ModelBuilder {
 public:
  explicit ModelBuilder(const std::filesystem::path& sources) : comments_(sources) {}

  template <IsStructure T>
  void addStructure(const T& value) {
    ReportStructure structure{structureName(value), comments_.ofType(structureName(value)), {}};
    if (has(model.structures, structure.name)) return;
    visitKeys(value, [&](const char* name, const auto& member) {
      ReportMember row = memberOf(member);
      row.name = name;
      row.comment = comments_.ofMember(structure.name, name);
      ASDFVK_CHECK(!row.comment.empty());
      structure.members.push_back(std::move(row));
    });
    model.structures.push_back(std::move(structure));
  }

  template <IsEnumeration T>
  std::vector<std::string> addEnumeration(T value) {
    ReportEnumeration enumeration{enumerationName(value), {}, {}};
    for (const auto& [name, enumerator] : choicesOf(value)) {
      enumeration.names.emplace_back(name);
      std::string identifier = name;
      identifier[0] = static_cast<char>(std::toupper(identifier[0]));
      enumeration.comments.push_back(comments_.ofMember(enumeration.name, identifier));
    }
    ASDFVK_CHECK_OP(enumeration.names.size(), ==, comments_.enumeratorCount(enumeration.name));
    if (!has(model.enumerations, enumeration.name)) model.enumerations.push_back(enumeration);
    return enumeration.names;
  }

  ReportModel model;

 private:
  template <typename Rows>
  static bool has(const Rows& rows, const std::string& name) {
    return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; });
  }

  ReportMember memberOf(const Json&) { return {{}, "json", "any", {}, {}}; }
  ReportMember memberOf(int) { return {{}, "int", "count", {}, {}}; }
  ReportMember memberOf(const std::array<double, 3>&) { return memberOf(Vec3d()); }
  template <typename T>
  ReportMember memberOf(const std::map<std::string, T>&) {
    ReportMember row = memberOf(T{});
    row.pythonType = "dict[str, " + row.pythonType + "]";
    return row;
  }
  template <typename T>
  requires std::is_arithmetic_v<T> ReportMember memberOf(const std::vector<std::pair<std::string, T>>&) {
    return memberOf(std::map<std::string, T>());
  }
  template <typename T>
  ReportMember memberOf(const OptionalKey<T>&) {
    ReportMember row = memberOf(T{});
    row.isOptional = true;
    return row;
  }
  ReportMember memberOf(bool) { return {{}, "bool", "flag", {}, {}}; }
  ReportMember memberOf(double) { return {{}, "float", "number", {}, {}}; }
  ReportMember memberOf(uint32_t) { return {{}, "int", "count", {}, {}}; }
  ReportMember memberOf(uint64_t) { return {{}, "int", "count", {}, {}}; }
  ReportMember memberOf(const std::string&) { return {{}, "str", "text", {}, {}}; }
  ReportMember memberOf(const Vec3d&) { return {{}, "Point", "point", {}, {}}; }
  ReportMember memberOf(const StageSeconds&) {
    addEnumeration(Stage{});
    return {{}, "dict[str, float]", "object", {}, {}};
  }
  ReportMember memberOf(const std::vector<ErrorDetail>&) { return {{}, "dict[str, str]", "object", {}, {}}; }
  template <IsEnumeration T>
  ReportMember memberOf(T value) {
    const std::vector<std::string> names = addEnumeration(value);
    const bool isLong = std::is_same_v<T, WarningCode>;
    return {{}, enumerationName(value), isLong ? "code, see below" : quoted(names), enumerationName(value), {}};
  }
  template <IsStructure T>
  ReportMember memberOf(const T& value) {
    addStructure(value);
    return {{}, structureName(value), "object", structureName(value), {}};
  }
  template <typename T>
  ReportMember memberOf(const std::optional<T>&) {
    ReportMember row = memberOf(T{});
    row.pythonType += " | None";
    row.documentType += " or null";
    return row;
  }
  template <typename T>
  ReportMember memberOf(const std::vector<T>&) {
    ReportMember row = memberOf(T{});
    row.pythonType = "tuple[" + row.pythonType + ", ...]";
    row.documentType = "list of " + row.documentType + "s";
    return row;
  }

  Comments comments_;
};

}  // namespace

ReportModel reportModel(const std::filesystem::path& sources) {
  ModelBuilder builder(sources);
  builder.addStructure(Report{});
  return std::move(builder.model);
}

ReportModel documentModel(const std::filesystem::path& sources) {
  ModelBuilder builder(sources);
  const auto add = [&](const auto&... structures) { (builder.addStructure(structures), ...); };
  add(Report{}, ReportFiles{}, ResultFacts{}, FailureDocument{}, SkippedDocument{}, MeshRecord{}, SummaryDocument{},
      ReportAnswer{}, ErrorAnswer{}, CancelAnswer{}, DeviceList{}, DeviceReportDocument{}, BaselineDocument{});
  return std::move(builder.model);
}

}  // namespace asdfvk
