#pragma once

#include <string>
#include <utility>
#include <vector>

#include "paper/plots/table.h"

namespace asdfvk::bench {

/// A picture or plot of the page; `file` lies beside it.
struct PageImage {
  std::string file;
  std::string caption;  ///< Below it; may be empty.
};

/// An HTML page without scripts, for any browser and without a server. All text is escaped.
class Page {
 public:
  explicit Page(std::string title) : title_(std::move(title)) {}

  /// Lines of "name: value" below the title.
  void facts(const std::vector<std::pair<std::string, std::string>>& facts);
  void heading(const std::string& text);
  void paragraph(const std::string& text);
  /// With a link to the same as CSV.
  void table(const Table& table, const std::string& caption, const std::string& csvFile);
  /// Images in so many columns, each with its caption, and one for all of them; a link to the numbers where there is a
  /// csvFile.
  void figure(const std::vector<PageImage>& images, int columnCount, const std::string& label,
              const std::string& caption, const std::string& csvFile = {});

  [[nodiscard]] std::string html() const;

 private:
  std::string title_, body_;
};

}  // namespace asdfvk::bench
