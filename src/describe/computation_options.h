#pragma once

#include "asdf_vk/session.h"
#include "describe/option.h"

namespace asdfvk {

/// The settings of a computation, which its options set.
struct ComputationSettings {
  Recipe recipe = Recipe::Balanced;  ///< Applied to `options` before all other options.
  Options options;
  /// Limit that also determines the exit code; complete() copies it to options.thickness.thinnerThan.
  std::optional<double> failIfThinner;
  LengthUnit failIfThinnerUnit = LengthUnit::OfMesh;
};

/// The settings of a session, which its options set.
struct SessionSettings : SessionOptions {
  uint32_t threadCount = 0;  ///< 0: the number of cores.
};

/// All options of a computation and of a session, in the order in which they are set. Recipe and definition precede the
/// options that they set.
[[nodiscard]] ASDFVK_API OptionRows computationRows();
[[nodiscard]] ASDFVK_API OptionRows sessionRows();

/// Applies what the given options imply. Calling it again changes nothing. Throws Error{OptionOutOfRange},
/// Error{UnknownName}, and Error{OptionConflict} if given options have no effect or contradict each other.
ASDFVK_API void complete(ComputationSettings& computation, const GivenOptions& given);
/// complete() for a caller of the library: options that differ from their defaults count as given.
[[nodiscard]] Options completed(const Options& options);

/// Throws as complete() does.
ASDFVK_API void requireValid(SessionSettings session, OptionSpelling spelling);

/// The options of the JSON report, with which a run can be repeated. An option without effect has no value.
[[nodiscard]] std::vector<std::pair<std::string, OptionValue>> reportedOptions(const ComputationSettings& computation,
                                                                               const SessionSettings& session);

/// A text that the option "seeds" reads as this number: "auto", "10%", "2000" or "all".
[[nodiscard]] std::string toText(const SeedCount& seeds);

}  // namespace asdfvk
