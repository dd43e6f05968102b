#include "io/object_names.h"

#include <algorithm>
#include <utility>

#include "core/utf8.h"

namespace asdfvk {
namespace {

/// character: one character of UTF-8. The control characters of Unicode are U+0000 to U+001F and U+007F to U+009F.
bool isControl(std::string_view character) {
  const auto first = static_cast<uint8_t>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7f;
  return first == 0xc2 && static_cast<uint8_t>(character[1]) < 0xa0;
}

}  // namespace

std::string objectName(std::string_view text) {
  const auto plainEnd = std::find_if_not(text.begin(), text.begin() + std::min(text.size(), kMaxObjectNameSize),
                                         [](char c) { return c >= ' ' && c <= '~'; });
  std::string name(text.begin(), plainEnd);
  text.remove_prefix(name.size());
  while (!text.empty()) {
    const size_t size = utf8CharacterSize(text);
    std::string_view character = size == 0 ? kReplacementCharacter : text.substr(0, size);
    if (isControl(character)) character = " ";
    if (name.size() + character.size() > kMaxObjectNameSize) break;
    name += character;
    text.remove_prefix(std::max<size_t>(size, 1));
  }
  name.erase(name.find_last_not_of(' ') + 1);
  name.erase(0, name.find_first_not_of(' '));
  return name;
}

void ObjectNames::dropLast() {
  nameBytes_ -= objects_.back().name.size();
  objects_.pop_back();
}

void ObjectNames::begin(uint64_t firstFace, std::string_view text) {
  std::string name = objectName(text);
  if (!objects_.empty() && objects_.back().firstFace == firstFace) dropLast();
  if (name == (objects_.empty() ? std::string_view() : objects_.back().name)) return;
  name.shrink_to_fit();
  nameBytes_ += name.size();
  objects_.push_back({firstFace, std::move(name)});
}

std::vector<NamedFaces> ObjectNames::finish(uint64_t faceCount) {
  if (!objects_.empty() && objects_.back().firstFace == faceCount) dropLast();
  nameBytes_ = 0;
  return std::exchange(objects_, {});
}

}  // namespace asdfvk
