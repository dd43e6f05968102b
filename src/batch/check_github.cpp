#include <fmt/core.h>

#include "batch/check_report.h"

namespace asdfvk {
namespace {

/// Characters that end a command or a property are escaped as in URIs (the toolkit of GitHub Actions, command.ts).
std::string escaped(const std::string& text, bool isProperty) {
  std::string result;
  for (const char c : text) {
    const bool ends = c == '%' || c == '\r' || c == '\n' || (isProperty && (c == ':' || c == ','));
    result += ends ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return result;
}

const char* commandOf(const CheckItem& item) {
  return item.level == "note" ? "notice" : item.level == "notJudged" ? "warning" : "error";
}

}  // namespace

std::string githubAnnotationsOf(std::span<const MeshRecord> records) {
  std::string lines;
  for (const MeshRecord& record : records)
    for (const CheckItem& item : checkItemsOf(record))
      lines += fmt::format("::{} file={},title={}::{}\n", commandOf(item), escaped(record.input, true),
                           escaped(item.kind, true), escaped(item.message, false));
  return lines;
}

}  // namespace asdfvk
