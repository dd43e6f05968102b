#include "io/gltf_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr size_t kMaxJsonDepth = 64;  // glTF needs about ten.

/// Builds the document from the events of the parser. The parser's own callback takes quadratic time, because it
/// searches an array for discarded values after each of its objects.
class GltfJsonBuilder : public nlohmann::json_sax<GltfJson> {
 public:
  explicit GltfJsonBuilder(GltfJson& root) : root_(root) {}

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t& value) override { return put(std::move(value)); }
  bool start_object(size_t) override { return open(GltfJson::object()); }
  bool start_array(size_t) override { return open(GltfJson::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    const auto [member, isNew] = open_.back()->get_ref<GltfJson::object_t&>().try_emplace(std::move(name));
    if (!isNew) failInput(fmt::format("a JSON object has the name {} twice", asdfvk::quoted(member->first)));
    member_ = &member->second;
    return true;
  }

  bool parse_error(size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    // Numbers out of range have no position.
    failInput(dynamic_cast<const GltfJson::parse_error*>(&error) == nullptr
                  ? "the JSON has a number out of range"
                  : fmt::format("byte {} of the JSON: syntax error", position));
  }

 private:
  template <typename Value>
  bool put(Value&& value) {
    (void)place(std::forward<Value>(value));
    return true;
  }

  GltfJson& place(GltfJson value) {
    if (open_.empty()) return root_ = std::move(value);
    if (open_.back()->is_object()) return *member_ = std::move(value);
    open_.back()->push_back(std::move(value));
    return open_.back()->back();
  }

  bool open(GltfJson value) {
    if (open_.size() == kMaxJsonDepth) failInput(fmt::format("JSON nested more than {} levels deep", kMaxJsonDepth));
    open_.push_back(&place(std::move(value)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  GltfJson& root_;
  std::vector<GltfJson*> open_;  ///< The objects and arrays around the next value. None of them moves while it is open.
  GltfJson* member_ = nullptr;   ///< The place of the next value in an object.
};

}  // namespace

GltfJson parseGltfJson(std::span<const char> text) {
  // Chunks are padded with blanks; some writers pad with zero bytes.
  while (!text.empty() && text.back() == '\0') text = text.first(text.size() - 1);
  GltfJson document;
  GltfJsonBuilder builder(document);
  (void)GltfJson::sax_parse(text.begin(), text.end(), &builder);
  return document;
}

void failGltf(std::string_view where, std::string_view reason) { failInput(fmt::format("{}: {}", where, reason)); }

const GltfJson* gltfMember(const GltfJson& object, const char* key, std::string_view where) {
  if (!object.is_object()) failGltf(where, "is not a JSON object");
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

uint64_t gltfWhole(const GltfJson& object, const char* key, std::optional<uint64_t> fallback, std::string_view where) {
  const GltfJson* const value = gltfMember(object, key, where);
  if (value == nullptr) {
    if (!fallback) failGltf(where, fmt::format("has no {}", key));
    return *fallback;
  }
  if (value->is_number_unsigned()) return value->get<uint64_t>();
  if (value->is_number_float()) {  // Some writers spell 3 as 3.0.
    const double number = value->get<double>();
    if (number >= 0 && number < 0x1p53 && number == std::floor(number)) return static_cast<uint64_t>(number);
  }
  failGltf(where, fmt::format("{} is not a non-negative integer", key));
}

const GltfJson* gltfArray(const GltfJson& object, const char* key, std::string_view where) {
  const GltfJson* const value = gltfMember(object, key, where);
  if (value != nullptr && !value->is_array()) failGltf(where, fmt::format("{} is not an array", key));
  return value;
}

std::string gltfText(const GltfJson& object, const char* key, std::string_view where) {
  const GltfJson* const value = gltfMember(object, key, where);
  if (value == nullptr) return {};
  if (!value->is_string()) failGltf(where, fmt::format("{} is not a string", key));
  return value->get<std::string>();
}

bool gltfFlag(const GltfJson& object, const char* key, bool fallback, std::string_view where) {
  const GltfJson* const value = gltfMember(object, key, where);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) failGltf(where, fmt::format("{} is not true or false", key));
  return value->get<bool>();
}

bool gltfNumbers(const GltfJson& object, const char* key, std::span<double> numbers, std::string_view where) {
  const GltfJson* const values = gltfArray(object, key, where);
  if (values == nullptr) return false;
  if (values->size() != numbers.size())
    failGltf(where, fmt::format("{} has {} instead of {}", key, counted(values->size(), "number"), numbers.size()));
  for (size_t i = 0; i < numbers.size(); ++i) {
    const GltfJson& value = (*values)[i];
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      failGltf(where, fmt::format("{} has an entry that is not a finite number", key));
    numbers[i] = value.get<double>();
  }
  return true;
}

const GltfJson* gltfExtension(const GltfJson& object, const char* name, std::string_view where) {
  const GltfJson* const extensions = gltfMember(object, "extensions", where);
  return extensions == nullptr ? nullptr : gltfMember(*extensions, name, where);
}

uint64_t gltfCount(const GltfJson& document, const char* array) {
  const GltfJson* const items = gltfArray(document, array, "glTF");
  return items == nullptr ? 0 : items->size();
}

const GltfJson& gltfItem(const GltfJson& document, const char* array, uint64_t index, std::string_view where) {
  const uint64_t count = gltfCount(document, array);
  if (index >= count) failGltf(where, fmt::format("entry {} of {} is out of range; there are {}", index, array, count));
  return (*gltfArray(document, array, where))[index];
}

bool gltfRequires(const GltfJson& document, std::string_view extension) {
  const GltfJson* const required = gltfArray(document, "extensionsRequired", "glTF");
  return required != nullptr && std::find(required->begin(), required->end(), extension) != required->end();
}

}  // namespace asdfvk
