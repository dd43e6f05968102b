// Wavefront OBJ: vertices and polygons. Normals, texture coordinates, groups, materials, lines and free-form surfaces
// are passed over; what names another file (mtllib and the like) never has it opened.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "core/text.h"
#include "io/input_faces.h"
#include "io/input_failure.h"
#include "io/mesh_reader.h"
#include "io/obj_keywords.h"
#include "io/text_scanner.h"

namespace asdfvk {
namespace {

class ObjReader {
 public:
  explicit ObjReader(std::span<const char> bytes) : text_(bytes, {.comment = '#', .backslashContinues = true}) {}

  Mesh read() {
    while (!text_.atEnd()) readStatement();
    // A face may name vertices that stand behind it, so the end of the file is the first place to tell.
    if (highestIndex_ > mesh_.vertices.size())
      failAtLine(highestIndexLine_, fmt::format("vertex index {} is out of range; the mesh has {}, counted from 1",
                                                highestIndex_, counted(mesh_.vertices.size(), "vertex", "vertices")));
    faces_.moveTo(mesh_);
    return std::move(mesh_);
  }

 private:
  void readStatement() {
    const std::string_view keyword = text_.wordOnLine();
    if (keyword == "v") {
      readVertex();
    } else if (keyword == "f" || keyword == "fo") {  // fo is what old files say for f.
      readFace();
    } else if (keyword == "call") {
      failAtLine(text_.line(), "this file calls another one, which is never opened; put them into one");
    } else if (isObjKeyword(keyword)) {
      text_.skipLine();
    } else {
      failAtLine(text_.line(), fmt::format("{} is no OBJ keyword", quoted(keyword)));
    }
  }

  void readVertex() {
    std::array<double, 7> numbers{};
    size_t count = 0;
    for (; !text_.atLineEnd(); ++count) {
      if (count == numbers.size()) failAtLine(text_.line(), "this vertex has more than seven numbers");
      numbers[count] = text_.number("a vertex coordinate");
    }
    // x y z, then a weight, or a colour of three, or both.
    if (count < 3 || count == 5) failAtLine(text_.line(), fmt::format("a vertex cannot have {} numbers", count));
    mesh_.vertices.push_back({numbers[0], numbers[1], numbers[2]});
    requireIndexableVertexCount(mesh_.vertices.size());
  }

  void readFace() {
    corners_.clear();
    while (!text_.atLineEnd()) corners_.push_back(readCorner(text_.wordOnLine()));
    if (corners_.empty()) failAtLine(text_.line(), "this face has no corners");
    faces_.add(corners_);
  }

  /// v, v/vt, v//vn or v/vt/vn; the latter two are checked for being numbers only.
  uint32_t readCorner(std::string_view word) {
    const char* at = word.data();
    const char* end = at + word.size();
    int64_t index = 0;
    const auto result = std::from_chars(at, end, index);
    bool isGood = result.ec == std::errc();
    at = result.ptr;
    for (int part = 0; isGood && at != end; ++part) {
      isGood = *at++ == '/' && part < 2;
      int64_t ignored = 0;
      if (isGood && at != end && *at != '/') {
        const auto partResult = std::from_chars(at, end, ignored);
        isGood = partResult.ec == std::errc();
        at = partResult.ptr;
      }
    }
    if (!isGood) failAtLine(text_.line(), fmt::format("{} is no corner of a face", quoted(word)));
    return vertexOf(index);
  }

  uint32_t vertexOf(int64_t index) {
    const auto vertexCount = static_cast<int64_t>(mesh_.vertices.size());
    if (index == 0) failAtLine(text_.line(), "vertex index 0; OBJ counts vertices from 1, or backwards from -1");
    if (index < -vertexCount || index > kMaxIndex)
      failAtLine(text_.line(), fmt::format("vertex index {} is out of range; the mesh has {} before it", index,
                                           counted(mesh_.vertices.size(), "vertex", "vertices")));
    if (index < 0) return static_cast<uint32_t>(vertexCount + index);
    if (static_cast<uint64_t>(index) > highestIndex_) {
      highestIndex_ = static_cast<uint64_t>(index);
      highestIndexLine_ = text_.line();
    }
    return static_cast<uint32_t>(index - 1);
  }

  static constexpr int64_t kMaxIndex = 0xffffffff;

  TextScanner text_;
  Mesh mesh_;
  InputFaces faces_;
  std::vector<uint32_t> corners_;
  uint64_t highestIndex_ = 0;
  uint64_t highestIndexLine_ = 0;
};

}  // namespace

Mesh parseObj(std::span<const char> bytes) { return ObjReader(bytes).read(); }

}  // namespace asdfvk
