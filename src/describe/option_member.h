#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "asdf_vk/choices.h"

namespace asdfvk {

struct OptionRow;

/// std::monostate means no value.
using OptionValue = std::variant<std::monostate, bool, uint64_t, double, std::string>;

enum class OptionKind { Flag, Whole, Real, Text };

/// The syntax of values: converts them to a type of members and back. A codec is a struct with the static functions
/// read() and write() and the constant kKind; kWanted, kPythonType and names() are optional. read() converts a value
/// and returns false, or throws, if the row does not allow the value; write() returns no value for an unset member.
struct OptionCodec {
  OptionKind kind;
  bool (*read)(const OptionValue& value, const OptionRow& row, void* member);
  OptionValue (*write)(const void* member);
  const char* wanted = nullptr;                   ///< See OptionRow::wanted.
  const char* pythonType = nullptr;               ///< Null: the type of OptionKind.
  std::vector<std::string> (*names)() = nullptr;  ///< The allowed values.
};

template <typename Codec, typename T>
[[nodiscard]] constexpr OptionCodec codecOf() {
  OptionCodec codec{Codec::kKind,
                    [](const OptionValue& value, const OptionRow& row, void* member) {
                      return Codec::read(value, row, *static_cast<T*>(member));
                    },
                    [](const void* member) { return Codec::write(*static_cast<const T*>(member)); }};
  if constexpr (requires { Codec::kWanted; }) codec.wanted = Codec::kWanted;
  if constexpr (requires { Codec::kPythonType; }) codec.pythonType = Codec::kPythonType;
  if constexpr (requires { Codec::names(); }) codec.names = Codec::names;
  return codec;
}

struct FlagCodec {
  static constexpr OptionKind kKind = OptionKind::Flag;
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, bool& member);
  [[nodiscard]] static OptionValue write(bool member) { return member; }
};

/// Numbers in the range of the row. std::optional members are unset without a value.
struct NumberCodec {
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, double& member);
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, uint64_t& member);
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, uint32_t& member);
  template <typename T>
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::optional<T>& member) {
    T number = 0;
    const bool isRead = read(value, row, number);
    if (isRead) member = number;
    return isRead;
  }
  template <typename T>
  [[nodiscard]] static OptionValue write(const T& member) {
    if constexpr (requires { member.value(); })
      return member ? write(*member) : OptionValue();
    else if constexpr (std::is_integral_v<T>)
      return uint64_t{member};
    else
      return member;
  }
};
struct WholeCodec : NumberCodec {
  static constexpr OptionKind kKind = OptionKind::Whole;
};
struct RealCodec : NumberCodec {
  static constexpr OptionKind kKind = OptionKind::Real;
};

/// A text; with OptionRow::names, one of the names. An empty text is an unset member.
struct TextCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::string& member);
  [[nodiscard]] static OptionValue write(const std::string& member) {
    return member.empty() ? OptionValue() : OptionValue(member);
  }
};

template <const auto& kNames>
struct ChoiceCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  template <typename T>
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow&, T& member) {
    const auto* const name = std::get_if<std::string>(&value);
    const T* const found = name == nullptr ? nullptr : findChoice(kNames, *name);
    if (found != nullptr) member = *found;
    return found != nullptr;
  }
  template <typename T>
  [[nodiscard]] static OptionValue write(const T& member) {
    return std::string(nameOf(kNames, member));
  }
  [[nodiscard]] static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const auto& choice : kNames) names.emplace_back(choice.first);
    return names;
  }
};

/// Like ChoiceCodec, for std::optional members; the name "auto" is an unset member.
template <const auto& kNames>
struct AutoChoiceCodec : ChoiceCodec<kNames> {
  template <typename T>
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::optional<T>& member) {
    T named{};
    const bool isAuto = value == OptionValue(kAuto);
    if (!isAuto && !ChoiceCodec<kNames>::read(value, row, named)) return false;
    member = isAuto ? std::nullopt : std::optional(named);
    return true;
  }
  template <typename T>
  [[nodiscard]] static OptionValue write(const std::optional<T>& member) {
    return member ? ChoiceCodec<kNames>::write(*member) : OptionValue(kAuto);
  }
  [[nodiscard]] static std::vector<std::string> names() {
    std::vector<std::string> names = ChoiceCodec<kNames>::names();
    names.insert(names.begin(), kAuto);
    return names;
  }

 private:
  static inline const std::string kAuto = "auto";
};

/// The codec of members of type T if the row names no other.
template <typename T>
struct DefaultCodecOf {
  using Type = std::conditional_t<std::is_integral_v<T>, WholeCodec, RealCodec>;
};
template <>
struct DefaultCodecOf<bool> {
  using Type = FlagCodec;
};
template <>
struct DefaultCodecOf<std::string> {
  using Type = TextCodec;
};
template <typename T>
struct DefaultCodecOf<std::optional<T>> : DefaultCodecOf<T> {};

/// The member that an option sets, with its codec. The member must outlive this object.
class OptionMember {
 public:
  template <typename T>
  OptionMember(T* member) : OptionMember(member, codecOf<typename DefaultCodecOf<T>::Type, T>()) {}  // NOLINT: implicit
  OptionMember(void* member, const OptionCodec& codec) : member_(member), codec_(codec) {}

  [[nodiscard]] const OptionCodec& codec() const { return codec_; }
  [[nodiscard]] bool read(const OptionValue& value, const OptionRow& row) const {
    return codec_.read(value, row, member_);
  }
  [[nodiscard]] OptionValue write() const { return codec_.write(member_); }

 private:
  void* member_;
  OptionCodec codec_;
};

template <typename Codec, typename T>
[[nodiscard]] OptionMember memberAs(T* member) {
  return {member, codecOf<Codec, T>()};
}

template <const auto& kNames, typename T>
[[nodiscard]] OptionMember choice(T* member) {
  return memberAs<ChoiceCodec<kNames>>(member);
}

}  // namespace asdfvk
