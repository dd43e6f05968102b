#pragma once

#include <string>
#include <string_view>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "io/formats.h"

namespace asdfvk::test {

using Parser = Mesh (*)(std::span<const char>);

inline Mesh parse(Parser parser, std::string_view text) { return parser(std::span(text.data(), text.size())); }

/// The message of the Error{UnreadableInput} that parsing throws; "no error" without one.
inline std::string errorOf(Parser parser, std::string_view text) {
  try {
    static_cast<void>(parse(parser, text));
  } catch (const Error& error) {
    return error.kind() == ErrorKind::Input ? error.what() : "an error of another kind";
  }
  return "no error";
}

inline bool holds(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace asdfvk::test
