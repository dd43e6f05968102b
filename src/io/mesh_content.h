#pragma once

#include <string>

#include "core/unset_vector.h"
#include "io/formats.h"

namespace asdfvk {

/// The content of a file in the form that readers expect: unpacked if the file is compressed by gzip, and in UTF-8 if
/// it is a text in UTF-16. The content is not copied if the file has this form.
class MeshContent {
 public:
  /// The bytes of `file` must outlive this object. Throws Error{UnreadableInput} for a file that cannot be unpacked or
  /// whose content is compressed again; Error{InputTooLarge} as unpackGzip().
  explicit MeshContent(const MeshSource& file);
  MeshContent(const MeshContent&) = delete;
  MeshContent& operator=(const MeshContent&) = delete;

  [[nodiscard]] const MeshSource& source() const { return source_; }

 private:
  MeshSource source_;
  UnsetVector<char> unpacked_;
  std::string text_;
};

}  // namespace asdfvk
