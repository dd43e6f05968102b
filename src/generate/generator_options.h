#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "arguments/arguments.h"

namespace asdfvk {

/// The command line of asdf-vk-generate.
struct GeneratorOptions {
  std::string shape, output;
  std::string corpus;          ///< Folder of the parts of known truth; empty: a shape.
  uint64_t faceCount = 20000;  ///< Only for shapes of known diameter.
  double longestEdge = 0;      ///< Only for parts of known least thickness; 0: as few faces as possible.
  double scale = 1;
  std::array<double, 3> translate{0, 0, 0};
  bool doubleVertices = false;
};

/// Exit codes of asdf-vk-generate; asdf-vk uses the same numbers.
inline constexpr int kGeneratorUsage = 1, kGeneratorOutput = 4;
inline constexpr std::array<std::pair<int, const char*>, 3> kGeneratorExitCodes{
    {{0, "done"}, {kGeneratorUsage, "usage"}, {kGeneratorOutput, "output not writable"}}};

/// The parser of the command line. The options write their values to `options`.
[[nodiscard]] ArgumentParser parserOf(GeneratorOptions& options);

}  // namespace asdfvk
