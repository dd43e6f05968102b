#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "page/page.h"
#include "render/image.h"

namespace asdfvk::bench {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< One cell per column.
};

/// The shortest decimal number from which `value` is read back; empty for NaN.
[[nodiscard]] std::string csvNumber(double value);

/// The folder of the results. Files are written atomically. Failures throw Error{Output}.
class OutputFolder {
 public:
  explicit OutputFolder(std::filesystem::path path);

  /// Writes a CSV file by RFC 4180, but with line feeds. The first line has the names of the columns.
  void write(const std::string& name, const CsvTable& table) const;
  void write(const std::string& name, const Image& image) const;
  void write(const std::string& name, const Page& page) const;

 private:
  std::filesystem::path path_;
};

}  // namespace asdfvk::bench
