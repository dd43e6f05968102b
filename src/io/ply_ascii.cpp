#include <fmt/format.h>

#include "core/text.h"
#include "io/input_failure.h"
#include "io/ply_body.h"
#include "io/text_scanner.h"
#include "io/triangle_strip.h"

namespace asdfvk {
namespace {

/// A row may run over several lines, but the next one begins on a new line: a file whose rows have other numbers than
/// its header says is noticed where it begins.
class AsciiBody {
 public:
  AsciiBody(std::span<const char> bytes, const PlyHeader& header, PlyTarget& target)
      : header_(header), text_(bytes.subspan(header.bodyOffset), {}, header.bodyLine), target_(target) {}

  void read() {
    for (const PlyElement& element : header_.elements) readElement(element);
    if (!text_.atEnd())
      failAtLine(text_.line(), fmt::format("{} stands behind the last row", quoted(text_.word("the end"))));
  }

 private:
  void readElement(const PlyElement& element) {
    const uint64_t minRowSize = element.minRowSize(PlyEncoding::Ascii);
    if (minRowSize == 0) return;
    if (element.count > (text_.remaining() + 1) / minRowSize)
      failAtLine(text_.line(),
                 fmt::format("{} of element {} cannot fit into the {} left; "
                             "the file is cut short or its count is wrong",
                             counted(element.count, "row"), quoted(element.name), counted(text_.remaining(), "byte")));
    if (element.role == PlyRole::Vertices) target_.vertices.reserve(element.count);
    if (element.role == PlyRole::Faces) target_.faces.reserve(element.count);
    for (uint64_t row = 0; row < element.count; ++row) {
      readRow(element);
      if (!text_.atLineEnd())
        failAtLine(text_.line(), fmt::format("row {} of element {} has more numbers than the header says", row,
                                             quoted(element.name)));
    }
  }

  void readRow(const PlyElement& element) {
    Vec3d point;
    for (size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.list) {
        readList(element, i);
        continue;
      }
      const double value = text_.number(property.name);
      for (size_t axis = 0; axis < 3; ++axis)
        if (i == element.coordinates[axis]) point[axis] = value;
    }
    if (element.role == PlyRole::Vertices) target_.vertices.push_back(point);
  }

  void readList(const PlyElement& element, size_t property) {
    const int64_t count = text_.integer("the count of a list");
    if (count < 0 || static_cast<uint64_t>(count) > text_.remaining())
      failAtLine(text_.line(),
                 fmt::format("a list claims a length of {}, but the file has only {} more; the file is cut short or "
                             "its count is wrong",
                             count, counted(text_.remaining(), "byte")));
    if (property != element.indices) {
      for (int64_t i = 0; i < count; ++i) static_cast<void>(text_.number(element.properties[property].name));
    } else if (element.role == PlyRole::Faces) {
      corners_.clear();
      for (int64_t i = 0; i < count; ++i) corners_.push_back(vertexIndex(text_.integer("a vertex index")));
      target_.faces.add(corners_);
    } else {
      TriangleStrip strip(target_.faces);
      for (int64_t i = 0; i < count; ++i) {
        const int64_t index = text_.integer("a vertex index");
        index == -1 ? strip.restart() : strip.add(vertexIndex(index));
      }
    }
  }

  uint32_t vertexIndex(int64_t index) {
    if (index < 0 || static_cast<uint64_t>(index) >= header_.vertexCount)
      failAtLine(text_.line(), fmt::format("vertex index {} is out of range; the mesh has {}", index,
                                           counted(header_.vertexCount, "vertex", "vertices")));
    return static_cast<uint32_t>(index);
  }

  const PlyHeader& header_;
  TextScanner text_;
  PlyTarget& target_;
  std::vector<uint32_t> corners_;
};

}  // namespace

void readPlyAscii(std::span<const char> bytes, const PlyHeader& header, PlyTarget& target) {
  AsciiBody(bytes, header, target).read();
}

}  // namespace asdfvk
