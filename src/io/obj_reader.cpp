// Wavefront OBJ: the statements `v` and `f`, and the names of objects: of `o`, or of `g` if the file has no name of
// `o`. The reader ignores the other statements of the format, and opens no file that a statement such as mtllib names.
// The statement `call` and unknown statements are errors. A backslash at the end of a line continues a statement of
// numbers, but not a name, because names may be Windows paths that end with one.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "core/text.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/obj_writer.h"
#include "io/object_names.h"
#include "io/text_scanner.h"
#include "mesh/input_faces.h"

namespace asdfvk {
namespace {

// The keywords of OBJ 3.0 and 2.11, in ASCII order for the binary search.
constexpr std::array kKeywords = std::to_array<std::string_view>({
    "bevel",  "bmat",   "bsp",   "bzp",        "c_interp", "call",     "cdc",    "cdp",  "con",       "csh",
    "cstech", "cstype", "ctech", "curv",       "curv2",    "d_interp", "deg",    "end",  "f",         "fo",
    "g",      "hole",   "l",     "lod",        "maplib",   "mg",       "mtllib", "o",    "p",         "parm",
    "res",    "s",      "scrv",  "shadow_obj", "sp",       "stech",    "step",   "surf", "trace_obj", "trim",
    "usemap", "usemtl", "v",     "vn",         "vp",       "vt",
});
static_assert(std::is_sorted(kKeywords.begin(), kKeywords.end()));

bool isKeyword(std::string_view word) { return std::binary_search(kKeywords.begin(), kKeywords.end(), word); }

/// Whether the arguments are names or commands that the reader ignores.
bool hasNames(std::string_view keyword) {
  constexpr auto kNameKeywords =
      std::to_array<std::string_view>({"csh", "maplib", "mtllib", "shadow_obj", "trace_obj", "usemap", "usemtl"});
  return std::find(kNameKeywords.begin(), kNameKeywords.end(), keyword) != kNameKeywords.end();
}

class ObjReader {
 public:
  explicit ObjReader(std::span<const char> bytes) : text_(bytes, {.comment = '#', .backslashContinues = true}) {}

  Mesh read() {
    while (!text_.atEnd()) readStatement();
    // Positive indices are checked at the end of the file, because a face may refer to later vertices.
    if (highestIndex_ > mesh_.vertices.size())
      failAtLine(highestIndexLine_, fmt::format("vertex index {} is out of range; the mesh has {}, numbered from 1",
                                                highestIndex_, counted(mesh_.vertices.size(), "vertex", "vertices")));
    mesh_.objects = (objects_.isEmpty() ? groups_ : objects_).finish(faces_.count());
    faces_.moveTo(mesh_);
    mesh_.skipped = skippedGeometry();
    return std::move(mesh_);
  }

 private:
  void readStatement() {
    const std::string_view keyword = text_.wordOnLine();
    if (keyword == "v") {
      readVertex();
    } else if (keyword == "f" || keyword == "fo") {  // fo: obsolete name of f.
      readFace();
    } else if (keyword == "call") {
      failAtLine(text_.line(), "call refers to another file, which is not opened; copy its content to this place");
    } else if (keyword == "o") {
      objects_.begin(faces_.count(), text_.takeLine());
    } else if (keyword == "g") {
      readGroup(objectName(text_.takeLine()));
    } else if (hasNames(keyword)) {
      text_.skipLine();
    } else if (isKeyword(keyword)) {
      countGeometry(keyword);
      skipNumbers();
    } else {
      failAtLine(text_.line(), fmt::format("{} is not an OBJ keyword", quoted(keyword)));
    }
  }

  void readGroup(std::string_view name) {
    constexpr std::string_view kDefaultGroup = "default";  // The faces before the first `g` are also in this group.
    if (objects_.isEmpty()) groups_.begin(faces_.count(), name == kDefaultGroup ? std::string_view() : name);
  }

  void countGeometry(std::string_view keyword) {
    constexpr auto kFreeForms = std::to_array<std::string_view>({"bsp", "bzp", "cdc", "cdp", "curv", "res", "surf"});
    if (keyword == "l") ++lineCount_;
    if (keyword == "p") ++pointCount_;
    if (std::find(kFreeForms.begin(), kFreeForms.end(), keyword) != kFreeForms.end()) ++freeFormCount_;
  }

  [[nodiscard]] std::vector<std::string> skippedGeometry() const {
    std::vector<std::string> texts;
    if (pointCount_ > 0) texts.push_back(counted(pointCount_, "point statement"));
    if (lineCount_ > 0) texts.push_back(counted(lineCount_, "line statement"));
    if (freeFormCount_ > 0)
      texts.push_back(counted(freeFormCount_, "free-form curve or surface", "free-form curves or surfaces"));
    return texts;
  }

  /// Refuses a continuation that begins with a keyword, because the backslash may be there by mistake.
  void skipNumbers() {
    for (uint64_t line = text_.line(); !text_.atLineEnd(); line = text_.line()) {
      const std::string_view word = text_.wordOnLine();
      if (text_.line() != line && isKeyword(word))
        failAtLine(line, fmt::format("a backslash joins this line and the statement {} of the next; remove one of them",
                                     quoted(word)));
    }
  }

  void readVertex() {
    std::array<double, 7> numbers{};
    size_t count = 0;
    for (; !text_.atLineEnd(); ++count) {
      if (count == numbers.size()) failAtLine(text_.line(), "a vertex has more than seven numbers");
      numbers[count] = text_.number("a vertex coordinate");
    }
    // x y z, then an optional weight, then three optional colour components.
    if (count < 3 || count == 5)
      failAtLine(text_.line(), fmt::format("a vertex has {} numbers; 3, 4, 6 or 7 are allowed", count));
    mesh_.vertices.push_back({numbers[0], numbers[1], numbers[2]});
    requireAtMost(kMaxIndexCount, mesh_.vertices.size(), "vertices");
  }

  void readFace() {
    corners_.clear();
    while (!text_.atLineEnd()) corners_.push_back(readCorner(text_.wordOnLine()));
    if (corners_.empty()) failAtLine(text_.line(), "a face has no corners");
    faces_.add(corners_);
  }

  /// Reads v, v/vt, v//vn or v/vt/vn; vt and vn may be any integers.
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
    if (!isGood) failAtLine(text_.line(), fmt::format("{} is not a corner of a face", quoted(word)));
    return vertexOf(index);
  }

  uint32_t vertexOf(int64_t index) {
    const auto vertexCount = static_cast<int64_t>(mesh_.vertices.size());
    if (index == 0) failAtLine(text_.line(), "vertex index 0; OBJ numbers vertices from 1, or backwards from -1");
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
  ObjectNames objects_, groups_;  ///< By `o` and `g`.
  std::vector<uint32_t> corners_;
  uint64_t highestIndex_ = 0;
  uint64_t highestIndexLine_ = 0;
  uint64_t pointCount_ = 0, lineCount_ = 0, freeFormCount_ = 0;
};

Match detectObj(std::span<const char> bytes) {
  return isKeyword(firstWord(bytes, '#')) ? Match::Possible : Match::None;
}

Mesh parseObj(const MeshSource& source) { return ObjReader(source.bytes).read(); }

}  // namespace

extern const FileFormat kObjFormat{.name = "obj",
                                   .extensions = {"obj"},
                                   .detect = detectObj,
                                   .parseMesh = parseObj,
                                   .write = writeObj,
                                   .writeBeside = writeObjMaterials,
                                   .needsBeside = hasObjMaterials};

}  // namespace asdfvk
