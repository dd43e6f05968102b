#pragma once

#include "asdf_vk/options.h"
#include "describe/option.h"

namespace asdfvk {

struct ComputationSettings {
  Recipe recipe = Recipe::Balanced;  ///< Applied to `options` before all other options.
  Options options;
  /// Limits that also determine the exit code. complete() copies them to options.thickness.
  std::optional<LengthLimit> failIfThinner, failIfThicker, failIfCloser;
  bool compares = false;        ///< Set by callers of Scene::compare(). Implies Measure::Thickness.
  bool failsIfVoids = false;    ///< Sealed voids determine the exit code. Implies Measure::Gap.
  bool failsIfContact = false;  ///< Bodies in contact determine the exit code. Implies Measure::Gap.

  /// The options. Precondition: complete() was called.
  [[nodiscard]] CheckedOptions checked() const { return {options, CheckedOptions::Trust::Checked}; }
  /// Whether the exit code depends on a measure.
  [[nodiscard]] bool isCheck() const {
    return failIfThinner || failIfThicker || failIfCloser || failsIfVoids || failsIfContact;
  }
};

/// Headings of option groups (OptionRow::group) that occur in more than one table of options.
inline constexpr const char* kOutputGroup = "Output";
inline constexpr const char* kDeviceGroup = "Device";
inline constexpr const char* kExperimentGroup = "Experiments (the defaults are best)";

/// Rows are in the order in which options are set. Recipe and definition are first, because they set further options.
/// The settings must outlive the rows.
[[nodiscard]] ASDFVK_API OptionRows computationRows(ComputationSettings& settings);

/// withSpelledOptions() with the options of computations.
[[nodiscard]] ASDFVK_API std::string withSpelledOptions(std::string_view message, OptionSpelling spelling);

/// A message such as "--allow-sharp-edges was removed: ...; --count-edges counts them" for an option of earlier
/// versions, else an empty text. name: the name in the spelling.
[[nodiscard]] ASDFVK_API std::string removedOptionText(std::string_view name, OptionSpelling spelling);

}  // namespace asdfvk
