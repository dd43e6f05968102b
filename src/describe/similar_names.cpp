#include "describe/similar_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/text.h"

namespace asdfvk {
namespace {

/// The number of letters to insert, remove or replace (V. Levenshtein, 1966).
size_t distanceOf(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i + 1);
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, replaced}));
    }
  }
  return row.back();
}

/// Whether a word of `name`, after a dash or an underscore, begins with `beginning`.
bool hasWord(std::string_view name, std::string_view beginning) {
  constexpr size_t kMinSize = 3;
  const size_t at = beginning.size() < kMinSize ? std::string_view::npos : name.find(beginning);
  return at != std::string_view::npos && (at == 0 || name[at - 1] == '-' || name[at - 1] == '_');
}

}  // namespace

std::string similarNames(std::string_view name, const std::vector<std::string>& names) {
  constexpr size_t kMaxCount = 3, kLettersPerError = 4;
  const std::string_view word = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::vector<std::pair<size_t, std::string>> found;
  for (const std::string& other : names) {
    const size_t distance = distanceOf(name, other);
    if (distance <= 1 + word.size() / kLettersPerError || hasWord(other, word)) found.emplace_back(distance, other);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  found.resize(std::min(found.size(), kMaxCount));
  std::vector<std::string> similar;
  for (auto& [distance, other] : found) similar.push_back(std::move(other));
  return joined(similar, " or ");
}

}  // namespace asdfvk
