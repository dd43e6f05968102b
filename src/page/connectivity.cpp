#include "page/connectivity.h"

#include "core/check.h"
#include "page/half_edges.h"

namespace asdfvk {
namespace {

/// A half-edge of a visited face. Gates form rings: the end of a gate is the start of the next one.
struct Gate {
  enum class State : uint8_t { Open, Closed, Removed };  ///< Closed: without a face behind it; still in its ring.

  uint32_t halfEdge;
  uint32_t face;      ///< Place of the visited face in the page.
  uint32_t start;     ///< Vertex of the page.
  uint32_t opposite;  ///< Vertex of the visited face that is not on the gate.
  uint32_t previous, next;
  uint32_t earlierAtStart;  ///< Another gate with the same start, created earlier.
  State state = State::Open;
};

class Walk {
 public:
  explicit Walk(const TriangleMesh& mesh)
      : mesh_(mesh),
        opposite_(pairHalfEdges(mesh)),
        placeOf_(mesh.vertices.size(), kNone),
        isVisited_(mesh.faces.size(), 0) {
    const size_t faceCount = mesh.faces.size();
    result_.faces.reserve(faceCount);
    result_.neighboursOf.reserve(faceCount);
    result_.vertices.reserve(faceCount / 2 + 2);
    result_.frontOf.reserve(faceCount / 2 + 2);
    latestAtStart_.reserve(faceCount / 2 + 2);
    gates_.reserve(faceCount / 2 * 3 + 3);
  }

  Connectivity run() {
    for (uint32_t face = 0; face < mesh_.faceCount(); ++face) {
      if (isVisited_[face]) continue;
      start(face);
      while (active_ != kNone && result_.faces.size() < mesh_.faces.size()) step();
      active_ = kNone;
      stack_.clear();
    }
    result_.gateCount = static_cast<uint32_t>(gates_.size());
    return std::move(result_);
  }

 private:
  void put(WalkSymbol symbol) {
    const auto bits = static_cast<uint8_t>(symbol);
    if (symbolCount_++ % 2 == 0) {
      result_.symbols.push_back(bits);
    } else {
      result_.symbols.back() = static_cast<uint8_t>(result_.symbols.back() | bits << 4);
    }
  }

  void putReference(uint32_t number) {
    for (; number >= 0x80; number >>= 7) result_.references.push_back(static_cast<uint8_t>(number | 0x80));
    result_.references.push_back(static_cast<uint8_t>(number));
  }

  uint32_t addVertex(uint32_t vertex, const std::array<uint32_t, 3>& front) {
    placeOf_[vertex] = static_cast<uint32_t>(result_.vertices.size());
    result_.vertices.push_back(vertex);
    result_.frontOf.push_back(front);
    latestAtStart_.push_back(kNone);
    return placeOf_[vertex];
  }

  uint32_t addFace(uint32_t face, uint32_t neighbour, uint32_t otherNeighbour) {
    isVisited_[face] = 1;
    result_.faces.push_back(face);
    result_.neighboursOf.push_back({neighbour, otherNeighbour});
    return static_cast<uint32_t>(result_.faces.size() - 1);
  }

  uint32_t addGate(uint32_t halfEdge, uint32_t face, uint32_t start, uint32_t opposite) {
    const auto gate = static_cast<uint32_t>(gates_.size());
    gates_.push_back({halfEdge, face, start, opposite, kNone, kNone, latestAtStart_[start]});
    latestAtStart_[start] = gate;
    return gate;
  }

  void link(uint32_t gate, uint32_t next) {
    gates_[gate].next = next;
    gates_[next].previous = gate;
  }
  void remove(uint32_t gate) { gates_[gate].state = Gate::State::Removed; }

  /// The latest gate of a ring that starts at the vertex, or kNone.
  uint32_t gateAt(uint32_t vertex) {
    uint32_t& gate = latestAtStart_[vertex];
    while (gate != kNone && gates_[gate].state == Gate::State::Removed) gate = gates_[gate].earlierAtStart;
    return gate;
  }

  void start(uint32_t face) {
    const bool isAlone = !isConnectable(mesh_, face) || hasNoNeighbour(face);
    put(isAlone ? WalkSymbol::Alone : WalkSymbol::Start);
    Face corners = mesh_.faces[face];
    if (!mesh_.hasFiniteCorners(face)) corners = {corners[0], corners[0], corners[0]};
    std::array<uint32_t, 3> places{};
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t place = placeOf_[corners[i]];
      putReference(place == kNone ? 0 : static_cast<uint32_t>(result_.vertices.size()) - place);
      places[i] = place == kNone ? addVertex(corners[i], {kNone, kNone, kNone}) : place;
    }
    const uint32_t before = result_.faces.empty() ? kNone : static_cast<uint32_t>(result_.faces.size() - 1);
    const uint32_t place = addFace(face, before, before);
    if (isAlone) return;
    std::array<uint32_t, 3> gates{};
    for (uint32_t i = 0; i < 3; ++i) gates[i] = addGate(3 * face + i, place, places[i], places[(i + 2) % 3]);
    for (uint32_t i = 0; i < 3; ++i) link(gates[i], gates[(i + 1) % 3]);
    stack_ = {gates[2], gates[1]};
    active_ = gates[0];
  }

  [[nodiscard]] bool hasNoNeighbour(uint32_t face) const {
    for (uint32_t i = 0; i < 3; ++i)
      if (const uint32_t other = opposite_[3 * face + i]; other != kNone && !isVisited_[other / 3]) return false;
    return true;
  }

  void popGate() {
    active_ = kNone;
    while (active_ == kNone && !stack_.empty()) {
      if (gates_[stack_.back()].state == Gate::State::Open) active_ = stack_.back();
      stack_.pop_back();
    }
  }

  /// Codes what is behind the active gate.
  void step() {
    const uint32_t g = active_;
    const Gate gate = gates_[g];
    const uint32_t entered = opposite_[gate.halfEdge];
    if (entered == kNone || isVisited_[entered / 3]) {
      put(WalkSymbol::Closed);
      gates_[g].state = Gate::State::Closed;
      popGate();
      return;
    }
    const uint32_t face = entered / 3;
    const uint32_t fromStart = nextHalfEdge(entered), toEnd = previousHalfEdge(entered);
    const Gate previous = gates_[gate.previous], next = gates_[gate.next];
    const bool joinsPrevious = opposite_[fromStart] == previous.halfEdge;
    const bool joinsNext = opposite_[toEnd] == next.halfEdge;
    const uint32_t end = next.start;
    remove(g);
    if (joinsPrevious && joinsNext) {
      put(WalkSymbol::Both);
      addFace(face, gate.face, next.face);
      remove(gate.previous);
      remove(gate.next);
      link(previous.previous, next.next);
      popGate();
    } else if (joinsPrevious) {
      put(WalkSymbol::Previous);
      const uint32_t place = addFace(face, gate.face, previous.face);
      remove(gate.previous);
      active_ = addGate(toEnd, place, previous.start, gate.start);
      link(previous.previous, active_);
      link(active_, gate.next);
    } else if (joinsNext) {
      put(WalkSymbol::Next);
      const uint32_t place = addFace(face, gate.face, next.face);
      remove(gate.next);
      active_ = addGate(fromStart, place, gate.start, end);
      link(gate.previous, active_);
      link(active_, next.next);
    } else {
      stepOnto(face, fromStart, toEnd, gate, end);
    }
  }

  /// The same where the face has no further edge in common with the neighbours of the gate in its ring.
  void stepOnto(uint32_t face, uint32_t fromStart, uint32_t toEnd, const Gate& gate, uint32_t end) {
    const uint32_t vertex = mesh_.faces[face][toEnd % 3];
    uint32_t place = placeOf_[vertex];
    uint32_t there = kNone;
    if (place == kNone) {
      put(WalkSymbol::New);
      place = addVertex(vertex, {gate.start, end, gate.opposite});
    } else if (there = gateAt(place); there != kNone) {
      put(WalkSymbol::Gate);
      putReference(static_cast<uint32_t>(gates_.size()) - there);
    } else {
      put(WalkSymbol::Old);
      putReference(static_cast<uint32_t>(result_.vertices.size()) - place);
    }
    const uint32_t facePlace = addFace(face, gate.face, gate.face);
    const uint32_t first = addGate(fromStart, facePlace, gate.start, end);
    const uint32_t second = addGate(toEnd, facePlace, place, gate.start);
    if (there == kNone) {
      link(first, second);
    } else {  // Splits the ring of the gate, or joins it with another one.
      link(gates_[there].previous, second);
      link(first, there);
    }
    link(gate.previous, first);
    link(second, gate.next);
    stack_.push_back(first);
    active_ = second;
  }

  const TriangleMesh& mesh_;
  const std::vector<uint32_t> opposite_;
  std::vector<uint32_t> placeOf_;  ///< Per vertex of the mesh: its place in the page.
  std::vector<uint8_t> isVisited_;
  std::vector<Gate> gates_;
  std::vector<uint32_t> latestAtStart_;  ///< Per vertex of the page; see Gate::earlierAtStart.
  std::vector<uint32_t> stack_;
  uint32_t active_ = kNone;
  uint64_t symbolCount_ = 0;
  Connectivity result_;
};

}  // namespace

Connectivity encodeConnectivity(const TriangleMesh& mesh) { return Walk(mesh).run(); }

}  // namespace asdfvk
