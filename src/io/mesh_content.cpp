#include "io/mesh_content.h"

#include "io/gzip_file.h"
#include "io/input_failure.h"
#include "io/stl_binary.h"
#include "io/utf16_text.h"

namespace asdfvk {

// The header of a binary STL may have any bytes. Therefore its exact size is stronger evidence than the first bytes.
MeshContent::MeshContent(const MeshSource& file) : source_(file) {
  if (isGzip(source_.bytes) && !hasBinaryStlSize(source_.bytes)) {
    unpacked_ = unpackGzip(source_.bytes);
    source_.packedSize = source_.bytes.size();
    source_.bytes = unpacked_;
    if (unpacked_.empty()) failInput("is compressed by gzip and has no content");
    if (isGzip(source_.bytes) && !hasBinaryStlSize(source_.bytes))
      failInput("is compressed by gzip more than once; unpack it first");
  }
  if (isUtf16Text(source_.bytes) && !hasBinaryStlSize(source_.bytes)) {
    text_ = utf8Of(source_.bytes);
    source_.bytes = text_;
  }
}

}  // namespace asdfvk
