#include "segment/boundary_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "segment/alpha_expansion.h"
#include "segment/surface_front.h"

namespace asdfvk {
namespace {

constexpr double kDataWeight = 0.5;
constexpr double kConcaveRadians = 10 * std::numbers::pi / 180;  ///< Concave angle that halves the cost of an edge.
constexpr double kConvexRadians = 60 * std::numbers::pi / 180;   ///< Convex angle that doubles the cost.
constexpr uint32_t kMaxRoundCount = 3;

double edgeCost(double length, double angle) {
  const double concave = std::max(0.0, angle) / kConcaveRadians, convex = std::max(0.0, -angle) / kConvexRadians;
  return length / kCutReach / (1 + concave * concave) * (1 + std::min(1.0, convex));
}

struct Choice {
  uint32_t face, label;
  float distance;  ///< Distance from the label.
};

/// The labels that each face may take, other than its current label, ascending by label.
std::vector<Choice> choicesOf(const PartSurface& surface, std::span<const uint32_t> labels, uint32_t labelCount,
                              const RunControl& stopOnly) {
  std::vector<std::vector<std::pair<uint32_t, float>>> sources(labelCount);  // For each label, the faces next to it.
  for (uint32_t face = 0; face < surface.faceCount(); ++face)
    for (uint32_t arc = surface.offsets[face]; arc < surface.offsets[face + 1]; ++arc)
      if (const auto& [other, length] = surface.arcs[arc];
          labels[other] != labels[face] && labels[face] != kNoLabel && labels[other] != kNoLabel)
        sources[labels[face]].emplace_back(other, length);
  const auto reach = static_cast<float>(kCutReach);
  SurfaceFront front(surface.offsets, surface.arcs, stopOnly.stop);
  std::vector<Choice> choices;
  for (uint32_t label = 0; label < labelCount; ++label) {
    for (const auto& [face, distance] : sources[label])
      if (distance <= reach) front.add(face, distance, label);
    front.advance(reach, [&](uint32_t face) { return labels[face] != label && labels[face] != kNoLabel; });
    stopOnly.checkpoint(0);
    for (const uint32_t face : front.reached()) choices.push_back({face, label, front.distances()[face]});
    front.clear();
  }
  return choices;
}

/// For each label, the face of this label that is farthest from other labels. If some faces are beyond the reach of
/// other labels, the largest of these faces.
struct Anchors {
  std::vector<uint32_t> faces;   ///< One face per label.
  std::vector<float> distances;  ///< #F, to the nearest other label; kUnreached beyond the reach.
};

Anchors anchorsOf(const PartSurface& surface, std::span<const uint32_t> labels, uint32_t labelCount,
                  std::span<const Choice> choices) {
  Anchors anchors{std::vector<uint32_t>(labelCount, kNoLabel),
                  std::vector<float>(labels.size(), SurfaceFront::kUnreached)};
  std::vector<float>& nearest = anchors.distances;
  for (const Choice& choice : choices) nearest[choice.face] = std::min(nearest[choice.face], choice.distance);
  for (uint32_t face = 0; face < labels.size(); ++face) {
    if (labels[face] == kNoLabel) continue;
    uint32_t& anchor = anchors.faces[labels[face]];
    if (anchor == kNoLabel ||
        std::pair(nearest[face], surface.areas[face]) > std::pair(nearest[anchor], surface.areas[anchor]))
      anchor = face;
  }
  return anchors;
}

/// Removes the choices of faces that keep their label. The anchors keep their label. If all faces of a label are within
/// the reach of other labels, the inner half of these faces also keeps this label. Without this rule, the cut would
/// shrink small parts to points, because points have short boundaries.
void keepCores(std::vector<Choice>& choices, std::span<const uint32_t> labels, const Anchors& anchors) {
  std::erase_if(choices, [&](const Choice& choice) {
    const uint32_t anchor = anchors.faces[labels[choice.face]];
    const float depth = anchors.distances[anchor];
    const bool isInnerHalf = depth < SurfaceFront::kUnreached && anchors.distances[choice.face] > depth / 2;
    return choice.face == anchor || isInnerHalf;
  });
}

/// Improves the labels by a graph cut. The graph has the faces that may change, and the neighbours of these faces with
/// fixed labels.
void expandLabels(const PartSurface& surface, std::vector<uint32_t>& labels, uint32_t labelCount,
                  std::span<const Choice> choices, const RunControl& control) {
  std::vector<uint32_t> itemOf(labels.size(), kNoLabel), faces;
  const auto addItem = [&](uint32_t face) {
    if (itemOf[face] != kNoLabel) return;
    itemOf[face] = static_cast<uint32_t>(faces.size());
    faces.push_back(face);
  };
  for (const Choice& choice : choices) addItem(choice.face);
  const auto changeableCount = static_cast<uint32_t>(faces.size());
  for (uint32_t item = 0; item < changeableCount; ++item)
    for (uint32_t arc = surface.offsets[faces[item]]; arc < surface.offsets[faces[item] + 1]; ++arc)
      if (const uint32_t other = surface.arcs[arc].face; labels[other] != kNoLabel) addItem(other);
  // The first choice of each face is its own label, without a cost.
  std::vector<uint32_t> labelOf(faces.size()), firstChoices(faces.size() + 1, 0);
  for (const Choice& choice : choices) ++firstChoices[itemOf[choice.face] + 1];
  for (uint32_t item = 0; item < faces.size(); ++item) firstChoices[item + 1] += firstChoices[item] + 1;
  std::vector<LabelProblem::Choice> costs(firstChoices.back());
  std::vector<uint32_t> next(firstChoices.begin(), firstChoices.end() - 1);
  for (uint32_t item = 0; item < faces.size(); ++item) {
    labelOf[item] = labels[faces[item]];
    costs[next[item]++] = {labelOf[item], 0};
  }
  for (const auto& [face, label, distance] : choices)
    costs[next[itemOf[face]]++] = {
        label, kDataWeight * double{surface.areas[face]} / (kCutReach * kCutReach) * double{distance} / kCutReach};
  std::vector<LabelEdge> edges;
  for (uint32_t item = 0; item < changeableCount; ++item)
    for (uint32_t arc = surface.offsets[faces[item]]; arc < surface.offsets[faces[item] + 1]; ++arc) {
      const uint32_t other = itemOf[surface.arcs[arc].face];
      if (other > item && other != kNoLabel)
        edges.push_back({item, other, edgeCost(double{surface.edgeLengths[arc]}, double{surface.angles[arc]})});
    }
  AlphaExpansion().minimize({labelCount, {}, edges, firstChoices, costs}, labelOf, {.maxRoundCount = kMaxRoundCount},
                            control);
  for (uint32_t item = 0; item < changeableCount; ++item) labels[faces[item]] = labelOf[item];
}

struct Pieces {
  std::vector<uint32_t> pieceOf;  ///< #F; kNoLabel for a face without a label.
  std::vector<uint32_t> labels;   ///< One label per piece.
};

Pieces findPieces(const PartSurface& surface, std::span<const uint32_t> labels) {
  Pieces pieces{std::vector<uint32_t>(labels.size(), kNoLabel), {}};
  std::vector<uint32_t> stack;
  for (uint32_t first = 0; first < labels.size(); ++first) {
    if (labels[first] == kNoLabel || pieces.pieceOf[first] != kNoLabel) continue;
    const auto piece = static_cast<uint32_t>(pieces.labels.size());
    pieces.labels.push_back(labels[first]);
    pieces.pieceOf[first] = piece;
    stack.push_back(first);
    while (!stack.empty()) {
      const uint32_t face = stack.back();
      stack.pop_back();
      for (uint32_t arc = surface.offsets[face]; arc < surface.offsets[face + 1]; ++arc) {
        const uint32_t other = surface.arcs[arc].face;
        if (pieces.pieceOf[other] != kNoLabel || labels[other] != labels[face]) continue;
        pieces.pieceOf[other] = piece;
        stack.push_back(other);
      }
    }
  }
  return pieces;
}

/// Gives each piece without an anchor the neighbouring label with the longest common boundary.
void joinLoosePieces(const PartSurface& surface, std::vector<uint32_t>& labels, std::span<const uint32_t> anchors) {
  for (;;) {
    const Pieces pieces = findPieces(surface, labels);
    std::vector<uint8_t> isLoose(pieces.labels.size(), 1);
    for (const uint32_t anchor : anchors)
      if (anchor != kNoLabel) isLoose[pieces.pieceOf[anchor]] = 0;
    std::map<std::pair<uint32_t, uint32_t>, double> boundaries;  // Lengths, by loose piece and neighbouring label.
    for (uint32_t face = 0; face < labels.size(); ++face) {
      const uint32_t piece = pieces.pieceOf[face];
      if (piece == kNoLabel || !isLoose[piece]) continue;
      for (uint32_t arc = surface.offsets[face]; arc < surface.offsets[face + 1]; ++arc) {
        const uint32_t other = surface.arcs[arc].face;
        if (labels[other] != labels[face] && labels[other] != kNoLabel && !isLoose[pieces.pieceOf[other]])
          boundaries[{piece, labels[other]}] += double{surface.edgeLengths[arc]};
      }
    }
    if (boundaries.empty()) return;
    std::vector<uint32_t> newLabels = pieces.labels;
    std::vector<double> longest(pieces.labels.size(), -1);
    for (const auto& [key, length] : boundaries) {
      const auto [piece, label] = key;
      if (length <= longest[piece]) continue;
      longest[piece] = length;
      newLabels[piece] = label;
    }
    for (uint32_t face = 0; face < labels.size(); ++face)
      if (pieces.pieceOf[face] != kNoLabel) labels[face] = newLabels[pieces.pieceOf[face]];
  }
}

}  // namespace

std::vector<uint32_t> cutBoundaries(const PartSurface& surface, std::vector<uint32_t> labels, uint32_t labelCount,
                                    const RunControl& control) {
  std::vector<Choice> choices = choicesOf(surface, labels, labelCount, control.withoutProgress());
  const Anchors anchors = anchorsOf(surface, labels, labelCount, choices);
  keepCores(choices, labels, anchors);
  expandLabels(surface, labels, labelCount, choices, control);
  joinLoosePieces(surface, labels, anchors.faces);
  return labels;
}

}  // namespace asdfvk
