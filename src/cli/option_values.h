#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "pipeline/asdf.h"

namespace asdfvk {

// Each throws Error{Usage} with a line that quotes the text and says what would do.

/// A whole number within [minimum, maximum], without sign or rubbish.
[[nodiscard]] uint64_t parseWholeNumber(const std::string& text, uint64_t minimum, uint64_t maximum);

/// A finite number.
[[nodiscard]] double parseNumber(const std::string& text);

/// A finite number that `accepts` takes; `complaint` ends the line otherwise, as in "'7' is not from 0 to 1".
[[nodiscard]] double parseNumber(const std::string& text, const std::function<bool(double)>& accepts,
                                 const char* complaint);

/// "10%" (above 0, at most 100), "2000" (at least 1) or "all".
[[nodiscard]] SeedCount parseSeedCount(const std::string& text);

/// "2000" (at least 1) or "all", which is the greatest number there is.
[[nodiscard]] uint64_t parseCheckCount(const std::string& text);

/// As parseSeedCount() reads it.
[[nodiscard]] std::string toText(const SeedCount& seeds);

}  // namespace asdfvk
