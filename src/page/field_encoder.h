#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/field.h"
#include "page/connectivity.h"
#include "page/page_streams.h"

namespace asdfvk {

/// Entry of a field of labels for a face without one: kNoSegment of asdf_vk/session.h.
inline constexpr uint32_t kNoLabel = 0xffffffff;

/// A field per input face as streams: real numbers as decimal codes, labels and flags as whole numbers; differences
/// from neighbouring faces in the order of the walk. The arguments must outlive it.
class FieldEncoder {
 public:
  FieldEncoder(const Field& field, std::span<const uint32_t> inputFaces, const Connectivity& walk);

  /// The streams that the field needs: "stream", and where there are such faces "missing" and "zero".
  [[nodiscard]] const std::vector<std::string>& streamKeys() const { return keys_; }
  [[nodiscard]] Bytes encode(const std::string& key) const;
  void setStream(const std::string& key, uint32_t number) { description_[key] = number; }

  [[nodiscard]] const nlohmann::ordered_json& description() const { return description_; }

 private:
  void prepareNumbers(std::span<const double> ofInputFaces);
  void prepareLabels(std::span<const uint32_t> ofInputFaces);
  [[nodiscard]] Bytes encodeCodes() const;

  std::span<const uint32_t> inputFaces_;
  const Connectivity& walk_;
  bool isNumber_ = false, isFlag_ = false;
  std::vector<int32_t> codes_;               ///< Per face of the page.
  std::vector<uint8_t> isMissing_, isZero_;  ///< Empty where no face is.
  std::vector<std::string> keys_;
  nlohmann::ordered_json description_;
};

}  // namespace asdfvk
