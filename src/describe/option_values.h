#pragma once

#include <string_view>

#include "asdf_vk/options.h"
#include "describe/option_member.h"

/// Codecs of options whose values are not plain numbers or names.
namespace asdfvk {

/// The text of the value; empty for a value that is no text.
[[nodiscard]] std::string_view textIn(const OptionValue& value);

struct SeedCountCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  static constexpr const char* kWanted =
      "a share such as 10% (above 0%, at most 100%), a count of at least 1, all, or auto";
  static constexpr const char* kPythonType = "int | float | str";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, SeedCount& seeds);
  [[nodiscard]] static OptionValue write(const SeedCount& seeds);
};

/// The error of RoundOptions::maxError, or with the ending "rel" of RoundOptions::maxRelativeError.
struct MaxErrorCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  static constexpr const char* kWanted =
      "an error above 0% and below 100%, such as 1% (of the range) or 5%rel (of the value)";
  static constexpr const char* kPythonType = "float | str";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, RoundOptions& rounds);
  /// Writes RoundOptions::maxError only.
  [[nodiscard]] static OptionValue write(const RoundOptions& rounds);
};

struct SmoothingCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  static constexpr const char* kWanted = "off, auto or RINGSxPASSES such as 2x1 (1 to 4 rings, 1 to 100 passes)";
  static constexpr const char* kPythonType = "str | tuple[int, int]";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, SmoothingOptions& smoothing);
  [[nodiscard]] static OptionValue write(const SmoothingOptions& smoothing);
};

struct LengthCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  static constexpr const char* kWanted = "a number above 0, or one with a unit, such as 0.8mm";
  static constexpr const char* kPythonType = "float | str";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::optional<LengthLimit>& length);
  [[nodiscard]] static OptionValue write(const std::optional<LengthLimit>& length);
};

/// A number of faces; the greatest number stands for all.
struct FaceCountCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  static constexpr const char* kWanted = "a count of at least 1 or all";
  static constexpr const char* kPythonType = "int | str";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::optional<uint64_t>& count);
  [[nodiscard]] static OptionValue write(const std::optional<uint64_t>& count);
};

/// A number or a part of a name.
struct DeviceCodec : TextCodec {
  static constexpr const char* kPythonType = "str | int";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::string& selector);
};

}  // namespace asdfvk
