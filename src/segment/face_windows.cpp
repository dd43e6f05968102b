#include "segment/face_windows.h"

#include <algorithm>
#include <limits>

namespace asdfvk {

std::vector<uint32_t> orderByBlocks(const FaceNeighbours& neighbours, size_t blockSize) {
  constexpr uint32_t kOrdered = std::numeric_limits<uint32_t>::max();
  const auto faceCount = static_cast<uint32_t>(neighbours.size());
  std::vector<uint32_t> order, frontier, queue;
  order.reserve(faceCount);
  // Number of the block that queued the face (numbered from 1), or kOrdered.
  std::vector<uint32_t> queuedIn(faceCount);
  uint32_t blockCount = 0, nextFace = 0;
  size_t nextOfFrontier = 0;
  const auto nextStart = [&] {
    while (nextOfFrontier < frontier.size())
      if (const uint32_t face = frontier[nextOfFrontier++]; queuedIn[face] != kOrdered) return face;
    while (queuedIn[nextFace] == kOrdered) ++nextFace;
    return nextFace;
  };
  while (order.size() < faceCount) {
    ++blockCount;
    const size_t end = std::min<size_t>(faceCount, order.size() + blockSize);
    queue.clear();
    for (size_t i = 0; order.size() < end; ++i) {
      if (i == queue.size()) queue.push_back(nextStart());
      const uint32_t face = queue[i];
      if (queuedIn[face] == kOrdered) continue;
      queuedIn[face] = kOrdered;
      order.push_back(face);
      for (const uint32_t neighbour : neighbours[face])
        if (neighbour != kNoNeighbour && queuedIn[neighbour] < blockCount) {
          queuedIn[neighbour] = blockCount;
          queue.push_back(neighbour);
        }
      if (order.size() == end)
        frontier.insert(frontier.end(), queue.begin() + static_cast<ptrdiff_t>(i) + 1, queue.end());
    }
  }
  return order;
}

void FaceWindows::setBlock(std::span<const uint32_t> block, uint32_t ringCount) {
  for (const uint32_t face : faces_)
    if (face != kNoNeighbour) localOf_[face] = kOutside;
  faces_.assign(1, kNoNeighbour);
  faces_.insert(faces_.end(), block.begin(), block.end());
  for (size_t i = 1; i < faces_.size(); ++i) localOf_[faces_[i]] = static_cast<uint32_t>(i);
  rows_.assign(3, 0);
  size_t parent = 1;
  for (uint32_t ring = 0; ring < ringCount; ++ring)
    for (const size_t end = faces_.size(); parent < end; ++parent)
      for (const uint32_t face : neighbours_[faces_[parent]]) {
        if (face != kNoNeighbour && localOf_[face] == kOutside) {
          localOf_[face] = static_cast<uint32_t>(faces_.size());
          faces_.push_back(face);
        }
        rows_.push_back(face == kNoNeighbour ? 0 : localOf_[face]);
      }
  if (visitedBy_.size() < faces_.size()) visitedBy_.resize(faces_.size());
}

void FaceWindows::search(uint32_t i, std::span<uint32_t> window, std::span<uint32_t> ringEnds) {
  const uint32_t search = ++searchCount_;
  uint32_t* const visitedBy = visitedBy_.data();
  uint32_t* const faces = window.data();
  const uint32_t* const rows = rows_.data();
  visitedBy[0] = visitedBy[i + 1] = search;
  faces[0] = i + 1;
  uint32_t count = 1, parent = 0;
  ringEnds[0] = 1;
  for (size_t ring = 1; ring < ringEnds.size(); ++ring) {
    for (const uint32_t end = count; parent < end; ++parent) {
      const uint32_t* const row = rows + 3 * size_t{faces[parent]};
      const uint32_t a = row[0], b = row[1], c = row[2];
      // Branch-free, because the condition (whether a neighbour is new) is unpredictable.
      faces[count] = a;
      count += visitedBy[a] != search ? 1 : 0;
      visitedBy[a] = search;
      faces[count] = b;
      count += visitedBy[b] != search ? 1 : 0;
      visitedBy[b] = search;
      faces[count] = c;
      count += visitedBy[c] != search ? 1 : 0;
      visitedBy[c] = search;
    }
    ringEnds[ring] = count;
  }
}

}  // namespace asdfvk
