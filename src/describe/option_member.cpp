#include "describe/option_member.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "describe/option.h"

namespace asdfvk {
namespace {

bool isInRange(const OptionRange& range, double value) {
  const bool isAbove = range.excludesMin ? value > range.min : value >= range.min;
  return isAbove && (range.excludesMax ? value < range.max : value <= range.max) && std::isfinite(value);
}

/// Assigns whole numbers up to the greatest one of T.
template <typename T>
bool readWhole(const OptionValue& value, const OptionRange& range, T& member) {
  constexpr T kGreatest = std::numeric_limits<T>::max();
  const auto* const whole = std::get_if<uint64_t>(&value);
  const T max = range.max < static_cast<double>(kGreatest) ? static_cast<T>(range.max) : kGreatest;
  if (whole == nullptr || static_cast<double>(*whole) < range.min || *whole > max) return false;
  member = static_cast<T>(*whole);
  return true;
}

}  // namespace

bool FlagCodec::read(const OptionValue& value, const OptionRow&, bool& member) {
  const bool* const flag = std::get_if<bool>(&value);
  if (flag != nullptr) member = *flag;
  return flag != nullptr;
}

bool NumberCodec::read(const OptionValue& value, const OptionRow& row, double& member) {
  const auto* const whole = std::get_if<uint64_t>(&value);
  const auto* const real = std::get_if<double>(&value);
  if (whole == nullptr && real == nullptr) return false;
  const double number = real != nullptr ? *real : static_cast<double>(*whole);
  const bool isAllowed = isInRange(row.range, number);
  if (isAllowed) member = number;
  return isAllowed;
}

bool NumberCodec::read(const OptionValue& value, const OptionRow& row, uint64_t& member) {
  return readWhole(value, row.range, member);
}

bool NumberCodec::read(const OptionValue& value, const OptionRow& row, uint32_t& member) {
  return readWhole(value, row.range, member);
}

bool TextCodec::read(const OptionValue& value, const OptionRow& row, std::string& member) {
  const auto* const text = std::get_if<std::string>(&value);
  if (text == nullptr) return false;
  const std::vector<std::string> names = namesOf(row);
  const bool isAllowed = names.empty() || std::find(names.begin(), names.end(), *text) != names.end();
  if (isAllowed) member = *text;
  return isAllowed;
}

}  // namespace asdfvk
