#include "seeds/disk_search.h"

namespace asdfvk {

struct DiskSearch::Labels {
  DiskSearch& search;
  std::span<const float> before;

  const DualGraph& graph;
  std::span<const float> arcLengths;

  [[nodiscard]] float at(uint32_t node) const { return search.members_[node].distance; }
  [[nodiscard]] uint32_t faceOf(uint32_t node) const { return search.members_[node].face; }
  bool lower(uint32_t face, float distance, uint32_t& node) const {
    if (const float earlier = before[face]; earlier >= 0 && distance >= earlier) return false;
    const size_t slot = search.slotOf(face);
    if (search.slots_[slot] == 0) {
      __builtin_prefetch(graph.neighbours.data() + graph.offsets[face]);
      __builtin_prefetch(arcLengths.data() + graph.offsets[face]);
      node = static_cast<uint32_t>(search.members_.size());
      search.insert(slot, {distance, face});
      return true;
    }
    node = search.slots_[slot] - 1;
    FaceDistance& member = search.members_[node];
    if (distance >= member.distance) return false;
    member.distance = distance;
    return true;
  }
};

void DiskSearch::find(const DualGraph& graph, std::span<const float> arcLengths, std::span<const float> before,
                      uint32_t centre, float radius) {
  constexpr int kFirstBits = 8;
  if (slots_.empty()) {
    slots_.assign(size_t{1} << kFirstBits, 0);
    shift_ = 32 - kFirstBits;
  }
  for (size_t slot : slotOfMember_) slots_[slot] = 0;
  members_.clear();
  slotOfMember_.clear();
  insert(slotOf(centre), {0, centre});
  pending_.assign(1, {0, 0, centre});
  correctLabels(graph, arcLengths, radius, pending_, Labels{*this, before, graph, arcLengths});
}

/// The slot of the face, or the empty one where it belongs.
size_t DiskSearch::slotOf(uint32_t face) const {
  const size_t mask = slots_.size() - 1;
  size_t slot = (face * 0x9e3779b1u) >> shift_;
  while (slots_[slot] != 0 && members_[slots_[slot] - 1].face != face) slot = (slot + 1) & mask;
  return slot;
}

void DiskSearch::insert(size_t slot, FaceDistance member) {
  members_.push_back(member);
  slotOfMember_.push_back(slot);
  slots_[slot] = static_cast<uint32_t>(members_.size());
  if (2 * members_.size() < slots_.size()) return;
  slots_.assign(2 * slots_.size(), 0);
  --shift_;
  for (size_t i = 0; i < members_.size(); ++i) {
    slotOfMember_[i] = slotOf(members_[i].face);
    slots_[slotOfMember_[i]] = static_cast<uint32_t>(i + 1);
  }
}

}  // namespace asdfvk
