#include "describe/option_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/length_unit.h"
#include "core/text.h"

namespace asdfvk {
namespace {

constexpr uint64_t kAllFaces = std::numeric_limits<uint64_t>::max();

/// Returns 0.1 for "10%" and for "0.1".
std::optional<double> shareIn(std::string_view text) {
  const bool isPercent = text.ends_with('%');
  const auto number = numberIn<double>(text.substr(0, text.size() - (isPercent ? 1 : 0)));
  return number && isPercent ? *number / 100 : number;
}

}  // namespace

std::string_view textIn(const OptionValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr ? std::string_view() : *text;
}

bool LengthCodec::read(const OptionValue& value, const OptionRow&, std::optional<LengthLimit>& length) {
  std::string_view text = textIn(value);
  const LengthUnitRow* found = nullptr;
  for (const LengthUnitRow& known : kLengthUnits)
    if (text.ends_with(known.name) && (found == nullptr || known.name.size() > found->name.size())) found = &known;
  if (found != nullptr) text.remove_suffix(found->name.size());
  while (text.ends_with(' ')) text.remove_suffix(1);
  std::optional<double> number = numberIn<double>(text);
  if (const auto* real = std::get_if<double>(&value)) number = *real;
  if (const auto* whole = std::get_if<uint64_t>(&value)) number = static_cast<double>(*whole);
  if (!number || !(*number > 0) || !std::isfinite(*number)) return false;
  length = {*number, found != nullptr ? found->unit : LengthUnit::OfMesh};
  return true;
}

OptionValue LengthCodec::write(const std::optional<LengthLimit>& length) {
  if (!length) return {};
  const LengthUnitRow* const row = findLengthUnit(length->unit);
  return row == nullptr ? OptionValue(length->value) : OptionValue(fmt::format("{}{}", length->value, row->name));
}

bool SeedCountCodec::read(const OptionValue& value, const OptionRow&, SeedCount& seeds) {
  const std::string_view text = textIn(value);
  const auto* share = std::get_if<double>(&value);
  const auto* whole = std::get_if<uint64_t>(&value);
  const auto percent = text.ends_with('%') ? shareIn(text) : share != nullptr ? std::optional(*share) : std::nullopt;
  if (percent) {
    if (!(*percent > 0 && *percent <= 1)) return false;
    seeds = SeedCount::ofShare(*percent);
    return true;
  }
  const auto count = whole != nullptr ? std::optional(*whole) : numberIn<uint64_t>(text);
  if (text == "auto") seeds = SeedCount::automatic();
  if (text == "all") seeds = SeedCount::all();
  if (count && *count > 0) seeds = SeedCount::ofCount(*count);
  return text == "auto" || text == "all" || (count && *count > 0);
}

bool MaxErrorCodec::read(const OptionValue& value, const OptionRow&, RoundOptions& rounds) {
  constexpr std::string_view kRelative = "rel";
  std::string_view text = textIn(value);
  const bool isRelative = text.ends_with(kRelative);
  if (isRelative) text.remove_suffix(kRelative.size());
  const auto* number = std::get_if<double>(&value);
  const std::optional<double> share = number != nullptr ? std::optional(*number) : shareIn(text);
  if (!share || !(*share > 0 && *share < 1)) return false;
  constexpr double kMinPercentage = 0.1;  // "0.5" without % more likely means 0.5 % than 50 %.
  if (number == nullptr && !text.ends_with('%') && *share >= kMinPercentage) {
    const char* const suffix = isRelative ? kRelative.data() : "";
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("'{0}{2}' has no %; write {0}%{2} or {1:g}%{2}", text, 100 * *share, suffix));
  }
  (isRelative ? rounds.maxRelativeError : rounds.maxError) = *share;
  return true;
}

OptionValue MaxErrorCodec::write(const RoundOptions& rounds) { return RealCodec::write(rounds.maxError); }

/// Reads "off", "auto" or rings x passes, such as "2x1".
bool SmoothingCodec::read(const OptionValue& value, const OptionRow&, SmoothingOptions& smoothing) {
  const std::string_view text = textIn(value);
  smoothing = {.isOn = text != "off", .window = {}};
  if (text == "off" || text == "auto") return true;
  const size_t cross = std::min(text.find('x'), text.size());
  const auto rings = numberIn<uint32_t>(text.substr(0, cross));
  const auto passes = numberIn<uint32_t>(text.substr(std::min(cross + 1, text.size())));
  if (!rings || !passes || *rings < 1 || *rings > 4 || *passes < 1 || *passes > 100) return false;
  smoothing.window = SmoothingOptions::Window{*rings, *passes};
  return true;
}

OptionValue SmoothingCodec::write(const SmoothingOptions& smoothing) {
  if (!smoothing.isOn) return "off";
  if (!smoothing.window) return "auto";
  return fmt::format("{}x{}", smoothing.window->rings, smoothing.window->passes);
}

bool FaceCountCodec::read(const OptionValue& value, const OptionRow&, std::optional<uint64_t>& count) {
  const auto* whole = std::get_if<uint64_t>(&value);
  const auto number = textIn(value) == "all" ? kAllFaces
                      : whole != nullptr     ? *whole
                                             : numberIn<uint64_t>(textIn(value)).value_or(0);
  if (number > 0) count = number;
  return number > 0;
}

OptionValue FaceCountCodec::write(const std::optional<uint64_t>& count) {
  if (!count) return {};
  return *count == kAllFaces ? OptionValue("all") : OptionValue(*count);
}

OptionValue SeedCountCodec::write(const SeedCount& seeds) {
  if (seeds.kind == SeedCount::Kind::Automatic) return "auto";
  if (seeds.kind == SeedCount::Kind::All) return "all";
  if (seeds.kind == SeedCount::Kind::Count) return fmt::format("{}", seeds.count);
  const std::string rounded = fmt::format("{:.6g}%", seeds.share * 100);
  return shareIn(rounded) == seeds.share ? rounded : fmt::format("{:.17g}%", seeds.share * 100);
}

bool DeviceCodec::read(const OptionValue& value, const OptionRow& row, std::string& selector) {
  const auto* const number = std::get_if<uint64_t>(&value);
  return TextCodec::read(number != nullptr ? std::to_string(*number) : value, row, selector);
}

}  // namespace asdfvk
