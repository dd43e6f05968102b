#pragma once

#include "asdf_vk/session.h"
#include "describe/option.h"

namespace asdfvk {

/// What the options of a computation set.
struct ComputationSettings {
  Recipe recipe = Recipe::Balanced;  ///< Applied to `options` before other options.
  Options options;
  std::optional<double> failIfThinner;  ///< Sets thickness.thinnerThan, and the exit code by its verdict.
  LengthUnit failIfThinnerUnit = LengthUnit::OfMesh;
};

/// What the options of a session set.
struct SessionSettings : SessionOptions {
  uint32_t threadCount = 0;  ///< 0: the number of cores.
};

/// All options, in the order in which they are set: the recipe and the definition precede the options that they set.
[[nodiscard]] ASDFVK_API OptionRows computationRows();
[[nodiscard]] ASDFVK_API OptionRows sessionRows();

/// Applies what the options imply. Throws Error{OptionOutOfRange}, Error{UnknownName} and, where options have no effect
/// or contradict each other, Error{OptionConflict}. A completed computation is not changed.
ASDFVK_API void complete(ComputationSettings& computation, const GivenOptions& given);
/// Completes the options of a caller of the library, who gave those that differ from their defaults.
[[nodiscard]] Options completed(const Options& options);

/// Throws as complete() does.
ASDFVK_API void requireValid(SessionSettings session, OptionSpelling spelling);

/// The options of a report, by which a run can be repeated: none where an option has no effect.
[[nodiscard]] std::vector<std::pair<std::string, OptionValue>> reportedOptions(const ComputationSettings& computation,
                                                                               const SessionSettings& session);

/// "10%", "2000" or "all", which reads as the same count.
[[nodiscard]] std::string toText(const SeedCount& seeds);

}  // namespace asdfvk
