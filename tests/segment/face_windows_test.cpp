#include "segment/face_windows.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "sample_problems.h"

using namespace asdfvk;

namespace {

using Faces = std::vector<uint32_t>;

Faces sorted(Faces faces) {
  std::sort(faces.begin(), faces.end());
  return faces;
}

Faces allFaces(const FaceNeighbours& neighbours) {
  Faces faces(neighbours.size());
  std::iota(faces.begin(), faces.end(), 0u);
  return faces;
}

/// The faces within the rings around the face, with an entry kNoNeighbour after each ring.
Faces plainWindow(const FaceNeighbours& neighbours, uint32_t centre, uint32_t ringCount) {
  Faces faces{centre}, result{centre, kNoNeighbour};
  for (size_t parent = 0, ring = 0; ring < ringCount; ++ring) {
    for (const size_t end = faces.size(); parent < end; ++parent)
      for (const uint32_t face : neighbours[faces[parent]])
        if (face != kNoNeighbour && std::find(faces.begin(), faces.end(), face) == faces.end()) {
          faces.push_back(face);
          result.push_back(face);
        }
    result.push_back(kNoNeighbour);
  }
  return result;
}

/// The same by search(), in blocks. Each face is searched beside the face in the middle of its block.
void checkWindows(const FaceNeighbours& neighbours, size_t blockSize, uint32_t ringCount) {
  CAPTURE(blockSize);
  CAPTURE(ringCount);
  const Faces order = orderByBlocks(neighbours, blockSize);
  FaceWindows windows(neighbours);
  for (size_t begin = 0; begin < order.size(); begin += blockSize) {
    const auto block = std::span(order).subspan(begin, std::min(blockSize, order.size() - begin));
    windows.setBlock(block, ringCount);
    const auto room = windows.faces().size() + 1;
    std::array<Faces, 2> found{Faces(room), Faces(room)}, ringEnds{Faces(ringCount + 1), Faces(ringCount + 1)};
    for (uint32_t i = 0; i < block.size(); ++i) {
      const std::array<uint32_t, 2> centres{i, static_cast<uint32_t>(block.size() / 2)};
      windows.search({centres[0], found[0], ringEnds[0]}, {centres[1], found[1], ringEnds[1]});
      for (size_t w = 0; w < 2; ++w) {
        Faces result;
        for (uint32_t ring = 0, at = 0; ring <= ringCount; ++ring) {
          for (; at < ringEnds[w][ring]; ++at) result.push_back(windows.faces()[found[w][at]]);
          result.push_back(kNoNeighbour);
        }
        REQUIRE(result == plainWindow(neighbours, block[centres[w]], ringCount));
      }
    }
  }
}

}  // namespace

TEST_CASE("blocks have all faces once") {
  const FaceNeighbours torus = test::sampleMesh("torus", 3000).neighbours;
  CHECK(sorted(orderByBlocks(torus, 256)) == allFaces(torus));
  CHECK(sorted(orderByBlocks(torus, 1)) == allFaces(torus));
  const FaceNeighbours isolated(5, {kNoNeighbour, kNoNeighbour, kNoNeighbour});
  CHECK(orderByBlocks(isolated, 3) == allFaces(isolated));
  CHECK(orderByBlocks({}, 256).empty());
}

TEST_CASE("a block is a breadth-first search") {
  CHECK(orderByBlocks(
            {{2, 3, kNoNeighbour}, {3, kNoNeighbour, kNoNeighbour}, {0, kNoNeighbour, 4}, {0, 1, 4}, {2, 3, 4}}, 5) ==
        Faces{0, 2, 3, 4, 1});
}

TEST_CASE("windows have the order of a breadth-first search from their face") {
  const FaceNeighbours hand = test::sampleMesh("hand", 2000).neighbours;
  for (const uint32_t ringCount : {1u, 3u, 6u}) checkWindows(hand, 100, ringCount);
  checkWindows(hand, hand.size(), 2);
  checkWindows(hand, 1, 2);
  checkWindows(test::stripNeighbours(40), 16, 7);
  // Faces without neighbours, with the same neighbour twice, and beside themselves.
  checkWindows({{kNoNeighbour, kNoNeighbour, kNoNeighbour}, {2, 2, 1}, {1, 1, kNoNeighbour}}, 2, 3);
}
