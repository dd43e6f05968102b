#include "seeds/dart_block.h"

#include <algorithm>
#include <atomic>

#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr size_t kThrowsPerTask = 512;
constexpr size_t kDisksPerTask = 32;

// While a block is thrown, the distance of a face of the block is replaced by its position, as a negative number, so
// that disks find their conflicts without another table. A float holds every integer up to 2^24.
constexpr float markOf(size_t position) { return -1.0f - static_cast<float>(position); }
constexpr uint32_t positionOf(float mark) { return static_cast<uint32_t>(-1.0f - mark); }
constexpr size_t kMaxPosition = (size_t{1} << 24) - 2;

template <typename Body>
void forEachPart(size_t count, size_t perPart, const Body& body) {
  forEachTask((count + perPart - 1) / perPart,
              [&](size_t part) { body(part, part * perPart, std::min(count, (part + 1) * perPart)); });
}

void lowerTo(float& distance, float to) {
  const std::atomic_ref<float> shared(distance);
  float last = shared.load(std::memory_order_relaxed);
  while (to < last && !shared.compare_exchange_weak(last, to, std::memory_order_relaxed)) {
  }
}

}  // namespace

void DartBlock::throwAt(std::span<const uint32_t> faces, float radius, uint64_t maxDarts) {
  ASDFVK_CHECK_OP(faces.size(), <=, kMaxPosition);
  darts_.clear();
  isOverfull_ = false;
  read(faces);
  open_.clear();
  for (size_t position = 0; position < faces.size(); ++position)
    if (throws_[position].whenThrown >= radius) open_.push_back(static_cast<uint32_t>(position));
  if (maxDarts == 0 && !open_.empty()) {
    isOverfull_ = true;
    return;
  }
  search(faces, radius);
  decide(radius, maxDarts);
  if (!isOverfull_) write(faces);
}

void DartBlock::read(std::span<const uint32_t> faces) {
  throws_.resize(faces.size());
  const std::span<float> distances = distances_.values();
  forEachPart(faces.size(), kThrowsPerTask, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (i + SurfaceDistances::kPrefetchDistance < end)
        distances_.prefetch(faces[i + SurfaceDistances::kPrefetchDistance]);
      float& distance = distances[faces[i]];
      throws_[i] = {distance, distance};
      distance = markOf(i);
    }
  });
}

void DartBlock::search(std::span<const uint32_t> faces, float radius) {
  const size_t taskCount = (open_.size() + kDisksPerTask - 1) / kDisksPerTask;
  if (disks_.size() < taskCount) disks_.resize(taskCount);
  const std::span<const float> before = distances_.values();
  forEachPart(open_.size(), kDisksPerTask, [&](size_t task, size_t begin, size_t end) {
    Disks& disks = disks_[task];
    disks.reached.clear();
    disks.conflicts.clear();
    disks.ends.clear();
    disks.isDart.assign(end - begin, 0);
    DiskSearch& search = searches_.local();
    for (size_t i = begin; i < end; ++i) {
      if (i + 4 < end) distances_.prefetchArcs(faces[open_[i + 4]]);
      if (i + 8 < end) distances_.prefetch(faces[open_[i + 8]]);
      search.find(distances_.graph(), distances_.arcLengths(), before, faces[open_[i]], radius);
      for (const FaceDistance& member : std::span(search.members()).subspan(1)) {
        if (const float mark = before[member.face]; mark >= 0)
          disks.reached.push_back(member);
        else
          disks.conflicts.push_back({member.distance, positionOf(mark)});
      }
      disks.ends.push_back({disks.reached.size(), disks.conflicts.size()});
    }
  });
}

void DartBlock::decide(float radius, uint64_t maxDarts) {
  for (size_t i = 0; i < open_.size(); ++i) {
    const uint32_t position = open_[i];
    if (throws_[position].whenThrown < radius) continue;
    if (darts_.size() == maxDarts) {
      isOverfull_ = true;
      return;
    }
    darts_.push_back(position);
    throws_[position].afterwards = 0;
    Disks& disks = disks_[i / kDisksPerTask];
    const size_t disk = i % kDisksPerTask;
    disks.isDart[disk] = 1;
    for (size_t c = disk == 0 ? 0 : disks.ends[disk - 1].conflictEnd; c < disks.ends[disk].conflictEnd; ++c) {
      const Conflict& conflict = disks.conflicts[c];
      Throw& other = throws_[conflict.position];
      other.afterwards = std::min(other.afterwards, conflict.distance);
      if (conflict.position > position) other.whenThrown = std::min(other.whenThrown, conflict.distance);
    }
  }
}

void DartBlock::write(std::span<const uint32_t> faces) {
  const std::span<float> distances = distances_.values();
  forEachPart(faces.size(), kThrowsPerTask, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) distances[faces[i]] = throws_[i].afterwards;
  });
  forEachPart(open_.size(), kDisksPerTask, [&](size_t task, size_t begin, size_t end) {
    const Disks& disks = disks_[task];
    for (size_t disk = 0, reached = 0; disk < end - begin; ++disk) {
      const size_t reachedEnd = disks.ends[disk].reachedEnd;
      if (disks.isDart[disk])
        for (; reached < reachedEnd; ++reached)
          lowerTo(distances[disks.reached[reached].face], disks.reached[reached].distance);
      reached = reachedEnd;
    }
  });
}

}  // namespace asdfvk
