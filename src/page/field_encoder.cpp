#include "page/field_encoder.h"

#include <algorithm>
#include <limits>

#include "core/check.h"
#include "core/json.h"
#include "core/parallel.h"
#include "page/decimal_codes.h"
#include "page/half_edges.h"

namespace asdfvk {
namespace {

Json rangeOf(double min, double max) { return min <= max ? Json{min, max} : Json(nullptr); }

}  // namespace

FieldEncoder::FieldEncoder(const Field& field, std::span<const uint32_t> inputFaces, const Connectivity& walk)
    : inputFaces_(inputFaces), walk_(walk) {
  ASDFVK_CHECK(field.componentCount == 1);
  description_ = {{"name", field.name},
                  {"title", field.label.empty() ? field.name : field.label},
                  {"unit", field.unit == "length" ? "mesh units" : field.unit}};
  if (const std::vector<double>* reals = field.reals()) {
    requireSingles(*reals, "'" + field.name + "'");
    prepareNumbers(*reals);
  } else if (const auto* labels = std::get_if<std::vector<uint32_t>>(&field.values)) {
    prepareLabels(*labels);
  } else {
    const auto& bytes = std::get<std::vector<uint8_t>>(field.values);
    prepareLabels(std::vector<uint32_t>(bytes.begin(), bytes.end()));
    isFlag_ = std::all_of(bytes.begin(), bytes.end(), [](uint8_t byte) { return byte <= 1; });
    if (isFlag_) description_["kind"] = "flag";
  }
  keys_.emplace_back("stream");
  if (!isMissing_.empty()) keys_.emplace_back("missing");
  if (!isZero_.empty()) keys_.emplace_back("zero");
}

void FieldEncoder::prepareNumbers(std::span<const double> ofInputFaces) {
  std::vector<double> values(inputFaces_.size());
  forEachInParallel(values.size(), [&](uint32_t i) { values[i] = ofInputFaces[inputFaces_[i]]; });
  double min = std::numeric_limits<double>::infinity(), max = -min;
  uint64_t missingCount = 0;
  for (const double value : ofInputFaces) {
    if (!std::isfinite(value)) {
      ++missingCount;
      continue;
    }
    min = std::min(min, value);
    max = std::max(max, value);
  }
  isNumber_ = true;
  DecimalCodes decimals = decimalCodesOf(values);
  codes_ = std::move(decimals.codes);
  if (decimals.hasMissing) isMissing_ = std::move(decimals.isMissing);
  if (decimals.hasZero) isZero_ = std::move(decimals.isZero);
  description_["kind"] = "number";
  description_["range"] = rangeOf(min, max);
  description_["noValueCount"] = missingCount;
  description_["lowestExponent"] = decimals.lowestExponent;
}

void FieldEncoder::prepareLabels(std::span<const uint32_t> ofInputFaces) {
  codes_.resize(inputFaces_.size());
  isMissing_.assign(inputFaces_.size(), 0);
  bool hasMissing = false;
  for (size_t i = 0; i < inputFaces_.size(); ++i) {
    const uint32_t label = ofInputFaces[inputFaces_[i]];
    isMissing_[i] = label == kNoLabel ? 1 : 0;
    hasMissing = hasMissing || label == kNoLabel;
    codes_[i] = label == kNoLabel ? 0 : static_cast<int32_t>(label);
  }
  if (!hasMissing) isMissing_.clear();
  uint32_t min = kNoLabel, max = 0;
  uint64_t missingCount = 0;
  for (const uint32_t label : ofInputFaces) {
    if (label == kNoLabel) {
      ++missingCount;
      continue;
    }
    min = std::min(min, label);
    max = std::max(max, label);
  }
  description_["kind"] = "label";
  description_["range"] = rangeOf(min, missingCount == ofInputFaces.size() ? -1.0 : max);
  description_["noValueCount"] = missingCount;
}

Bytes FieldEncoder::encode(const std::string& key) const {
  if (key == "missing") return bitsOf(isMissing_);
  if (key == "zero") return bitsOf(isZero_);
  if (!isFlag_) return encodeCodes();
  std::vector<uint8_t> flags(codes_.begin(), codes_.end());
  return bitsOf(flags);
}

/// A marked face stores its predicted code.
Bytes FieldEncoder::encodeCodes() const {
  std::vector<int32_t> carried(codes_.size());
  std::vector<uint32_t> residuals(codes_.size(), 0);
  for (size_t i = 0; i < codes_.size(); ++i) {
    const auto [first, second] = walk_.neighboursOf[i];
    int32_t predicted = 0;
    if (first != kNone) predicted = isNumber_ ? (carried[first] + carried[second]) >> 1 : carried[first];
    const bool hasMark = (!isMissing_.empty() && isMissing_[i] != 0) || (!isZero_.empty() && isZero_[i] != 0);
    carried[i] = hasMark ? predicted : codes_[i];
    residuals[i] = zigzag(static_cast<int32_t>(static_cast<uint32_t>(carried[i]) - static_cast<uint32_t>(predicted)));
  }
  return bytePlanesOf(residuals);
}

}  // namespace asdfvk
