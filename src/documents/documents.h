#pragma once

#include <string>
#include <utility>
#include <vector>

namespace asdfvk {

/// A page of docs/man with its marks replaced. help: the text of ArgumentParser::help().
[[nodiscard]] std::string manPage(const std::string& page, const std::string& version, const std::string& help,
                                  const std::vector<std::pair<int, std::string>>& exitCodes);

/// docs/options.md with the rows of the options between "<!-- options of GROUP -->" and "<!-- end -->".
[[nodiscard]] std::string optionPage(std::string page);

}  // namespace asdfvk
