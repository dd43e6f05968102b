// Binary STL: 80 arbitrary bytes, the face count, and 50 bytes per face. Some programs write a face count of 0 or a
// wrong one, append bytes, or insert data after each face. Such a file is read if its faces are beyond doubt
// (areFacesBeyondDoubt()) and no other reading of the file is possible. A file that is too short for its face count is
// truncated and always refused.
#include "io/stl_binary.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/text.h"
#include "core/unset_vector.h"
#include "core/vec3.h"
#include "io/corner_welder.h"
#include "io/input_failure.h"
#include "io/stl_reader.h"
#include "mesh/coincident_faces.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read by copying its bytes");

constexpr uint64_t kHeaderSize = 84;  // 80 arbitrary bytes, then the face count.
constexpr uint64_t kFaceSize = 50;    // The normal and the corners in float32, then two attribute bytes.
constexpr uint64_t kAttributeOffset = 48;

struct StlFacet {
  Vec3f normal;
  std::array<Vec3f, 3> corners;
};

/// Precondition: at least kHeaderSize bytes.
uint64_t headerFaceCount(std::span<const char> bytes) {
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderSize - sizeof count, sizeof count);
  return count;
}

StlFacet stlFacetAt(const char* at) {
  StlFacet facet;
  std::memcpy(&facet, at, sizeof facet);
  return facet;
}

uint64_t attributeAt(const char* facet) {
  uint16_t attribute = 0;
  std::memcpy(&attribute, facet + kAttributeOffset, sizeof attribute);
  return attribute;
}

/// Whether all coordinates are finite and are 0 or of a magnitude from 1e-20 to 1e20. Most other bytes do not pass.
bool isPlausibleFacet(const StlFacet& facet) {
  for (const Vec3f& p : facet.corners)
    for (size_t axis = 0; axis < 3; ++axis) {
      const float magnitude = std::abs(p[axis]);
      if (magnitude != 0 && !(magnitude >= 1e-20f && magnitude <= 1e20f)) return false;
    }
  return true;
}

/// Where the faces of a file are.
struct StlLayout {
  uint64_t faceCount = 0;
  bool hasPayloads = false;  ///< The attribute of a face is the number of bytes after it.
  std::string skipped;       ///< See Mesh::skipped; empty for a file as the format defines it.
};

/// Precondition: the faces fit into the bytes from `at` on.
template <typename Use>
void forEachFacet(const char* at, uint64_t faceCount, bool hasPayloads, const Use& use) {
  for (uint64_t i = 0; i < faceCount; ++i) {
    use(at);
    at += kFaceSize + (hasPayloads ? attributeAt(at) : 0);
  }
}

/// Whether every face is plausible, a face has an area, and at least nine of ten normals of faces with an area are zero
/// or within 30 degrees of the line that is perpendicular to the face.
bool areFacesBeyondDoubt(const char* at, uint64_t faceCount, bool hasPayloads) {
  bool isPlausible = true;
  uint64_t areaCount = 0, wrongCount = 0;
  forEachFacet(at, faceCount, hasPayloads, [&](const char* bytes) {
    const StlFacet facet = stlFacetAt(bytes);
    isPlausible = isPlausible && isPlausibleFacet(facet);
    if (!isPlausible) return;
    const auto a = static_cast<Vec3d>(facet.corners[0]), normal = static_cast<Vec3d>(facet.normal);
    const Vec3d area = cross(static_cast<Vec3d>(facet.corners[1]) - a, static_cast<Vec3d>(facet.corners[2]) - a);
    if (area == Vec3d{}) return;
    ++areaCount;
    const double along = dot(normal, area);
    constexpr double kCosineSquared = 0.75;
    if (normal != Vec3d{} && !(along * along >= kCosineSquared * dot(normal, normal) * dot(area, area))) ++wrongCount;
  });
  return isPlausible && areaCount > 0 && wrongCount <= areaCount / 10;
}

/// The end of faces with payloads, or nothing if they do not fit into the file.
std::optional<uint64_t> endOfPayloads(std::span<const char> bytes, uint64_t faceCount) {
  uint64_t at = kHeaderSize;
  for (uint64_t i = 0; i < faceCount; ++i) {
    if (kFaceSize > bytes.size() - at) return std::nullopt;
    const uint64_t payload = attributeAt(bytes.data() + at);
    at += kFaceSize;
    if (payload > bytes.size() - at) return std::nullopt;
    at += payload;
  }
  return at;
}

/// The greatest magnitude of a coordinate.
float greatestCoordinate(const char* at, uint64_t faceCount) {
  float greatest = 0;
  forEachFacet(at, faceCount, false, [&](const char* bytes) {
    for (const Vec3f& p : stlFacetAt(bytes).corners)
      for (size_t axis = 0; axis < 3; ++axis) greatest = std::max(greatest, std::abs(p[axis]));
  });
  return greatest;
}

/// Whether the bytes are a face with an area and a fitting normal, and its coordinates are not much greater than those
/// of the other faces. Text and numbers rarely pass.
bool isFurtherFacet(const char* at, float greatest) {
  constexpr float kMaxRatio = 1000;
  return areFacesBeyondDoubt(at, 1, false) && greatestCoordinate(at, 1) <= kMaxRatio * greatest;
}

/// Whether bytes after the last face may contain faces: a further STL, or a face at any offset.
bool mayHoldFacets(std::span<const char> rest, float greatest) {
  if (hasBinaryStlSize(rest) && headerFaceCount(rest) > 0) return true;
  for (size_t at = 0; at + kFaceSize <= rest.size(); ++at)
    if (isFurtherFacet(rest.data() + at, greatest)) return true;
  return false;
}

/// Finds the only reading of the file. Returns nothing if there is none, or more than one.
std::optional<StlLayout> findStlLayout(std::span<const char> bytes) {
  if (bytes.size() < kHeaderSize) return std::nullopt;
  const uint64_t faceCount = headerFaceCount(bytes), restAt = kHeaderSize + faceCount * kFaceSize;
  if (restAt == bytes.size()) return StlLayout{.faceCount = faceCount};
  if (restAt > bytes.size()) return std::nullopt;
  const char* const first = bytes.data() + kHeaderSize;
  const uint64_t wholeCount = (bytes.size() - kHeaderSize) / kFaceSize;
  const bool isWhole = bytes.size() == kHeaderSize + wholeCount * kFaceSize;

  const std::span<const char> rest = bytes.subspan(restAt);
  const bool isPadding = std::all_of(rest.begin(), rest.end(), [](char c) { return c == '\0'; });

  // If only the last face has a payload, both readings give the same faces.
  const bool hasPayloads = faceCount > 0 && endOfPayloads(bytes, faceCount) == bytes.size() &&
                           endOfPayloads(bytes, faceCount - 1) != restAt - kFaceSize &&
                           areFacesBeyondDoubt(first, faceCount, true);
  // A count above 0 is wrong only if each row after the counted ones is a face.
  const float greatest = greatestCoordinate(first, faceCount);
  bool areFurtherFaces = true;
  if (faceCount > 0 && isWhole)
    forEachFacet(rest.data(), wholeCount - faceCount, false,
                 [&](const char* at) { areFurtherFaces = areFurtherFaces && isFurtherFacet(at, greatest); });
  if (isWhole && !isPadding && areFurtherFaces && areFacesBeyondDoubt(first, wholeCount, false)) {
    if (hasPayloads) return std::nullopt;
    return StlLayout{wholeCount, false, fmt::format("1 wrong face count ({} instead of {})", faceCount, wholeCount)};
  }
  const bool isPlain = faceCount > 0 && areFacesBeyondDoubt(first, faceCount, false);
  if (isPlain == hasPayloads) return std::nullopt;
  if (hasPayloads) return StlLayout{faceCount, true, counted(rest.size(), "byte") + " of data between the faces"};
  if (mayHoldFacets(rest, greatest)) return std::nullopt;
  return StlLayout{faceCount, false, counted(rest.size(), "byte") + " after the last face"};
}

/// Faces whose corners are indices of the points of their block.
struct StlBlock {
  std::span<Face> faces;
  std::vector<Vec3d> points;
  size_t firstPoint = 0;  ///< Number of points of the preceding blocks.
};

/// Reads and welds blocks of faces. triangles: receives all faces.
std::vector<StlBlock> weldedBlocks(const char* at, const StlLayout& layout, std::span<Face> triangles) {
  constexpr uint64_t kFacesPerBlock = uint64_t{1} << 15;  // The table of the welder fits into the cache of a processor.
  std::vector<const char*> begins;
  uint64_t index = 0;
  forEachFacet(at, layout.faceCount, layout.hasPayloads, [&](const char* facet) {
    if (index++ % kFacesPerBlock == 0) begins.push_back(facet);
  });
  std::vector<StlBlock> blocks(begins.size());
  forEachTask(blocks.size(), [&](size_t i) {
    const uint64_t first = i * kFacesPerBlock;
    blocks[i].faces = triangles.subspan(first, std::min(kFacesPerBlock, triangles.size() - first));
    CornerWelder welder(blocks[i].faces.size() / 2);
    Face* face = blocks[i].faces.data();
    forEachFacet(begins[i], blocks[i].faces.size(), layout.hasPayloads, [&](const char* bytes) {
      const StlFacet facet = stlFacetAt(bytes);
      for (size_t c = 0; c < 3; ++c) (*face)[c] = welder.indexOf(static_cast<Vec3d>(facet.corners[c]));
      ++face;
    });
    blocks[i].points = std::move(welder.points());
  });
  for (size_t i = 1; i < blocks.size(); ++i)
    blocks[i].firstPoint = blocks[i - 1].firstPoint + blocks[i - 1].points.size();
  return blocks;
}

/// Welds the points of all blocks, and replaces the corners of the faces by indices of the returned points. These
/// ascend in the order of first appearance, as by one CornerWelder.
std::vector<Vec3d> joinedPoints(std::span<const StlBlock> blocks) {
  UnsetVector<Vec3d> all(blocks.back().firstPoint + blocks.back().points.size());
  forEachTask(blocks.size(), [&](size_t i) {
    std::copy(blocks[i].points.begin(), blocks[i].points.end(), all.data() + blocks[i].firstPoint);
  });
  const UnsetVector<uint32_t> lowest = coincidentVertices(all, true);
  const std::vector<uint32_t> firsts =
      indicesInParallel(all.size(), [&](uint32_t point) { return lowest[point] == point; });
  std::vector<Vec3d> points(firsts.size());
  UnsetVector<uint32_t> indexOf(all.size());  // Set for `firsts`.
  forEachInParallel(firsts.size(), [&](uint32_t i) {
    points[i] = all[firsts[i]];
    indexOf[firsts[i]] = i;
  });
  forEachTask(blocks.size(), [&](size_t i) {
    for (Face& face : blocks[i].faces)
      for (uint32_t& corner : face) corner = indexOf[lowest[blocks[i].firstPoint + corner]];
  });
  return points;
}

[[noreturn]] void refuseStl(std::span<const char> bytes) {
  if (bytes.size() < kHeaderSize)
    failInput(
        fmt::format("neither ASCII STL, which begins with 'solid', nor binary STL, which has at least {} bytes; this "
                    "file has {}",
                    kHeaderSize, bytes.size()));
  const auto isText = [](char c) { return static_cast<unsigned char>(c) >= ' ' || (c >= '\t' && c <= '\r'); };
  if (std::all_of(bytes.begin(), bytes.begin() + kHeaderSize, isText))
    failInput("is a text, but does not begin with 'solid' as ASCII STL does");
  const uint64_t faceCount = headerFaceCount(bytes), expectedSize = kHeaderSize + faceCount * kFaceSize;
  const std::string sizes = fmt::format("binary STL with {} must have {} bytes; this file has {}",
                                        counted(faceCount, "face"), expectedSize, bytes.size());
  if (expectedSize > bytes.size()) failInput(sizes + " and is truncated; copy or export it again");
  failAtByte(expectedSize, sizes +
                               " and continues after the last face, so that the number and the places of its faces "
                               "are in doubt; export it again");
}

}  // namespace

bool hasBinaryStlSize(std::span<const char> bytes) {
  return bytes.size() >= kHeaderSize && bytes.size() == kHeaderSize + headerFaceCount(bytes) * kFaceSize;
}

bool isBinaryStl(std::span<const char> bytes) { return findStlLayout(bytes).has_value(); }

Mesh parseBinaryStl(std::span<const char> bytes) {
  const std::optional<StlLayout> layout = findStlLayout(bytes);
  if (!layout) refuseStl(bytes);
  requireAtMost(kMaxTriangleCount, layout->faceCount, "faces");
  std::vector<Face> triangles(layout->faceCount);
  std::vector<StlBlock> blocks = weldedBlocks(bytes.data() + kHeaderSize, *layout, triangles);
  std::vector<Vec3d> points = blocks.size() > 1 ? joinedPoints(blocks)
                              : blocks.empty()  ? std::vector<Vec3d>()
                                                : std::move(blocks.front().points);
  Mesh mesh = stlMesh(std::move(points), std::move(triangles));
  if (!layout->skipped.empty()) mesh.skipped.push_back(layout->skipped);
  return mesh;
}

}  // namespace asdfvk
