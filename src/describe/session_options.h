#pragma once

#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/session.h"
#include "describe/computation_options.h"

namespace asdfvk {

struct SessionSettings : SessionOptions {
  uint32_t threadCount = 0;  ///< 0: the number of cores.
};

/// The settings must outlive the rows.
[[nodiscard]] ASDFVK_API OptionRows sessionRows(SessionSettings& settings);

/// The settings of computations and of sessions, with the rows that set them.
struct SettingsWithRows {
  ComputationSettings computation;
  SessionSettings session;
  OptionRows ofComputation = computationRows(computation), ofSession = sessionRows(session);

  SettingsWithRows() = default;
  SettingsWithRows(const SettingsWithRows&) = delete;  // The rows refer to the members.
  SettingsWithRows& operator=(const SettingsWithRows&) = delete;
};

/// Throws Error{OptionOutOfRange}, Error{UnknownName}, and Error{OptionConflict} if options contradict each other.
ASDFVK_API void requireValid(SessionSettings session, OptionSpelling spelling);

/// The options that repeat the run. An option without effect has no value.
[[nodiscard]] std::vector<std::pair<std::string, OptionValue>> reportedOptions(ComputationSettings computation,
                                                                               SessionSettings session);

}  // namespace asdfvk
