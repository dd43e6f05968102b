#include "paper/output.h"

#include <fmt/format.h>

#include <cmath>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "render/png.h"

namespace asdfvk::bench {
namespace {

std::string csvCell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string csvLine(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += csvCell(cell) + ',';
  line.back() = '\n';
  return line;
}

}  // namespace

std::string csvNumber(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

OutputFolder::OutputFolder(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (!std::filesystem::is_directory(path_))
    throw Error(ErrorCode::OutputNotWritable, path_.string() + ": " + (error ? error.message() : "not a folder"));
}

void OutputFolder::write(const std::string& name, const CsvTable& table) const {
  std::string text = csvLine(table.columns);
  for (const std::vector<std::string>& row : table.rows) {
    ASDFVK_CHECK_OP(row.size(), ==, table.columns.size());
    text += csvLine(row);
  }
  AtomicFile file(path_ / name);
  file.write(text);
  file.commit();
}

void OutputFolder::write(const std::string& name, const Image& image) const { writePng(path_ / name, image); }

void OutputFolder::write(const std::string& name, const Page& page) const {
  AtomicFile file(path_ / name);
  page.write(file);
  file.commit();
}

}  // namespace asdfvk::bench
