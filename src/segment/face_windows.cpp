#include "segment/face_windows.h"

#include <algorithm>
#include <limits>

#include "core/simd.h"

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
  for (std::vector<SearchNumber>& visitedBy : visitedBy_) visitedBy.assign(faces_.size(), 0);
  searchNumber_ = 0;
}

/// A breadth-first search. `parent` is the face of the queue whose neighbours are visited next.
struct FaceWindows::Search {
  Search(const FaceWindow& window, SearchNumber* visitedByNumber, SearchNumber searchNumber)
      : visitedBy(visitedByNumber), faces(window.faces.data()), number(searchNumber) {
    faces[0] = window.centre + 1;
    visitedBy[0] = visitedBy[faces[0]] = number;
    window.ringEnds[0] = 1;
  }

  ASDFVK_ALWAYS_INLINE void step(const uint32_t* rows) {
    const uint32_t* const row = rows + 3 * size_t{faces[parent++]};
    for (const uint32_t face : {row[0], row[1], row[2]}) {
      // No branch, because the processor cannot predict whether the neighbour is new.
      faces[count] = face;
      count += visitedBy[face] != number ? 1 : 0;
      visitedBy[face] = number;
    }
  }

  SearchNumber* visitedBy;
  uint32_t* faces;
  SearchNumber number;
  uint32_t count = 1, parent = 0;
};

void FaceWindows::search(const FaceWindow& first, const FaceWindow& second) {
  if (++searchNumber_ == 0) {
    for (std::vector<SearchNumber>& visitedBy : visitedBy_) std::ranges::fill(visitedBy, SearchNumber{0});
    searchNumber_ = 1;
  }
  Search a(first, visitedBy_[0].data(), searchNumber_), b(second, visitedBy_[1].data(), searchNumber_);
  const uint32_t* const rows = rows_.data();
  for (size_t ring = 1; ring < first.ringEnds.size(); ++ring) {
    const uint32_t endOfA = a.count, endOfB = b.count;
    while (a.parent < endOfA && b.parent < endOfB) {
      a.step(rows);
      b.step(rows);
    }
    while (a.parent < endOfA) a.step(rows);
    while (b.parent < endOfB) b.step(rows);
    first.ringEnds[ring] = a.count;
    second.ringEnds[ring] = b.count;
  }
}

}  // namespace asdfvk
