#pragma once

#include <string>
#include <utility>
#include <vector>

namespace asdfvk {

/// Returns a page of docs/man in which the marks (@VERSION@, ...) are replaced. help: the text of
/// ArgumentParser::help().
[[nodiscard]] std::string manPage(const std::string& page, const std::string& version, const std::string& help,
                                  const std::vector<std::pair<int, std::string>>& exitCodes);

/// Returns docs/options.md with new rows of options between "<!-- options of GROUP -->" and "<!-- end -->".
[[nodiscard]] std::string optionPage(std::string page);

}  // namespace asdfvk
