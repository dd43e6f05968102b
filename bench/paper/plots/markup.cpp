#include "paper/plots/markup.h"

#include <algorithm>

namespace asdfvk::bench {

std::string escapeMarkup(std::string_view text) {
  std::string escaped;
  for (const char c : text) switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  return escaped;
}

double roughTextWidth(std::string_view text, double size) {
  constexpr double kMeanAdvance = 0.56;  // Of Helvetica, Arial and their kin, in lower case and digits.
  const auto isStart = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  return kMeanAdvance * size * static_cast<double>(std::count_if(text.begin(), text.end(), isStart));
}

}  // namespace asdfvk::bench
