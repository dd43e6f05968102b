#pragma once

#include <optional>

#include "describe/computation_options.h"

/// OptionRow::read and OptionRow::write of the options of a computation whose values are not plain numbers or names.
namespace asdfvk {

[[nodiscard]] inline Options& optionsOf(void* target) { return static_cast<ComputationSettings*>(target)->options; }
[[nodiscard]] inline const Options& optionsOf(const void* target) {
  return static_cast<const ComputationSettings*>(target)->options;
}

/// OptionRow::write of an option whose value is not reported.
[[nodiscard]] inline OptionValue noValue(const void*) { return {}; }

/// OptionRow::wanted of a length.
inline constexpr const char* kLengthWanted = "a number above 0, or one with a unit, such as 0.8mm";
[[nodiscard]] bool readLength(const OptionValue& value, std::optional<LengthLimit>& length);
[[nodiscard]] OptionValue lengthValue(const std::optional<LengthLimit>& length);

template <std::optional<LengthLimit> ThicknessOptions::*kLimit>
[[nodiscard]] auto& limitOf(auto* target) {
  return optionsOf(target).thickness.*kLimit;
}
template <std::optional<LengthLimit> ComputationSettings::*kLimit>
[[nodiscard]] std::optional<LengthLimit>& limitOf(void* target) {
  return static_cast<ComputationSettings*>(target)->*kLimit;
}
template <std::optional<LengthLimit> ComputationSettings::*kLimit>
[[nodiscard]] const std::optional<LengthLimit>& limitOf(const void* target) {
  return static_cast<const ComputationSettings*>(target)->*kLimit;
}
template <auto kLimit>
[[nodiscard]] bool readLimit(void* target, const OptionValue& value) {
  return readLength(value, limitOf<kLimit>(target));
}
template <auto kLimit>
[[nodiscard]] OptionValue writeLimit(const void* target) {
  return lengthValue(limitOf<kLimit>(target));
}

[[nodiscard]] bool readSeeds(void* target, const OptionValue& value);
[[nodiscard]] bool readMaxError(void* target, const OptionValue& value);
[[nodiscard]] OptionValue writeMaxError(const void* target);
[[nodiscard]] bool readSmoothing(void* target, const OptionValue& value);
[[nodiscard]] OptionValue writeSmoothing(const void* target);
[[nodiscard]] bool readCheck(void* target, const OptionValue& value);
[[nodiscard]] OptionValue writeCheck(const void* target);

}  // namespace asdfvk
