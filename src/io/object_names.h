#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/mesh.h"

namespace asdfvk {

/// Greatest size of a name of an object in bytes. Longer names are cut between characters.
inline constexpr size_t kMaxObjectNameSize = 200;

/// The name of an object in a form for Mesh::objects: valid UTF-8 on one line, without blanks at its ends. Control
/// characters become blanks, and each byte that is not UTF-8 becomes U+FFFD. The time does not depend on the length of
/// the text beyond kMaxObjectNameSize.
[[nodiscard]] std::string objectName(std::string_view text);

/// Collects Mesh::objects.
class ObjectNames {
 public:
  /// The faces from firstFace to that of the next call have the name objectName(text). If it is empty, they have no
  /// name. firstFace: at least that of the preceding call.
  void begin(uint64_t firstFace, std::string_view text);

  [[nodiscard]] bool isEmpty() const { return objects_.empty(); }
  /// The memory of the names in bytes.
  [[nodiscard]] uint64_t byteCount() const { return objects_.size() * sizeof(NamedFaces) + nameBytes_; }
  /// The objects of a mesh of #I = faceCount input faces. Leaves this object empty.
  [[nodiscard]] std::vector<NamedFaces> finish(uint64_t faceCount);

 private:
  void dropLast();

  std::vector<NamedFaces> objects_;
  uint64_t nameBytes_ = 0;
};

}  // namespace asdfvk
