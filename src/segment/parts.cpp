#include "segment/parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "core/parallel.h"
#include "segment/boundary_cut.h"
#include "segment/part_consensus.h"
#include "segment/part_merging.h"
#include "segment/part_surface.h"
#include "segment/patches.h"
#include "segment/rand_index.h"

namespace asdfvk {
namespace {

constexpr std::array<uint32_t, 5> kPatchCounts{200, 250, 300, 350, 400};
/// Coarse meshes have fewer patches, because one patch per face would give too many parts.
constexpr uint32_t kMinFacesPerPatch = 3;
/// Depth below the surface at which lines of sight end, in shape diameters.
constexpr double kSightDepth = 0.3;
/// Least ratio volume / (area * mean value) of a shape that is a thin wall. The ratio is about 0.4 for a wall, and 0.28
/// for a tube.
constexpr double kMinWallShape = 0.36;
/// Largest mean visibility of a thin shell. Plates are no thin shells: most pairs of their patches have a clear line of
/// sight.
constexpr double kMaxWallSight = 0.5;
/// A boundary of parts is in at least this share of the variants (PartConsensus).
constexpr double kMinStability = 0.5;
constexpr double kLeastThreshold = 1e-12;  ///< Greater than 0, for its logarithm.
/// If components below kMinPartArea have at most this share of the area together, they take neighbouring parts.
constexpr double kMaxAbsorbedArea = 0.05;

/// Whether two conditions hold: closed components with values have most of the area, and the volume of these components
/// is that of thin walls.
bool isWall(const PartsInput& input, const PartSurface& surface) {
  double volume = 0, valuedArea = 0, product = 0;
  for (uint32_t face = 0; face < surface.faceCount(); ++face) {
    const Component& component = input.components.components[input.components.componentOf[face]];
    if (!component.isClosed || !component.isConsistentlyWound) continue;
    const double faceArea = double{surface.areas[face]};
    volume += dot(surface.centres[face], input.geometry.normals[face]) * faceArea / 3;
    valuedArea += std::isnan(input.values[face]) ? 0 : faceArea;
    product += faceArea * std::exp(double{surface.logValues[face]});
  }
  return valuedArea > 0.5 && std::abs(volume) > kMinWallShape * product;
}

/// For each component: its share of the area, and the face farthest from its centre.
struct ComponentShapes {
  std::vector<double> areas;
  std::vector<uint32_t> farthestFaces;
};

ComponentShapes shapesOf(const PartSurface& surface, const Components& components) {
  const size_t count = components.components.size();
  ComponentShapes shapes{std::vector<double>(count, 0), std::vector<uint32_t>(count, 0)};
  std::vector<Vec3d> centres(count);
  std::vector<double> largest(count, -1);
  for (uint32_t face = 0; face < surface.faceCount(); ++face) {
    const uint32_t component = components.componentOf[face];
    shapes.areas[component] += double{surface.areas[face]};
    centres[component] += surface.centres[face] * double{surface.areas[face]};
  }
  for (uint32_t face = 0; face < surface.faceCount(); ++face) {
    const uint32_t component = components.componentOf[face];
    if (!(shapes.areas[component] > 0)) continue;
    const Vec3d fromCentre = surface.centres[face] - centres[component] / shapes.areas[component];
    if (const double squared = dot(fromCentre, fromCentre); squared > largest[component]) {
      largest[component] = squared;
      shapes.farthestFaces[component] = face;
    }
  }
  return shapes;
}

/// What becomes of the components. Components in neither list take the nearest part.
struct ComponentRoles {
  std::vector<uint32_t> firstSeeds;  ///< A face of each component that is divided into parts.
  std::vector<uint32_t> whole;       ///< Components that are not divided.
};

/// If the small components have much of the area, as in a file of many equal objects, each of them is a part.
/// Components that are small compared with the largest component are exceptions.
ComponentRoles rolesOf(const ComponentShapes& shapes) {
  double smallArea = 0, largest = 0;
  for (const double area : shapes.areas) {
    smallArea += area < kMinPartArea ? area : 0;
    largest = std::max(largest, area);
  }
  ComponentRoles roles;
  for (uint32_t component = 0; component < shapes.areas.size(); ++component) {
    if (const double area = shapes.areas[component]; area >= kMinPartArea)
      roles.firstSeeds.push_back(shapes.farthestFaces[component]);
    else if (smallArea > kMaxAbsorbedArea && area >= kMinPartArea * largest)
      roles.whole.push_back(component);
  }
  return roles;
}

/// The counts are large enough to give each requested part at least one patch.
std::array<uint32_t, 5> patchCountsFor(uint32_t faceCount, const PartsOptions& options) {
  std::array<uint32_t, 5> counts = kPatchCounts;
  const double scale = std::min(1.0, faceCount / double{kMinFacesPerPatch * kPatchCounts.back()});
  for (uint32_t& count : counts) count = std::max(static_cast<uint32_t>(count * scale), options.partCount.value_or(1));
  return counts;
}

struct SightSums {
  double seen = 0, all = 0;
};

SightMatrix findSight(const PartsInput& input, const PartSurface& surface, const PatchData& data,
                      const LineOfSight& sight, SightSums& sums) {
  const auto count = static_cast<uint32_t>(data.patches.size());
  std::vector<Vec3d> points;
  for (const PatchData::Patch& patch : data.patches) {
    const uint32_t face = patch.centreFace;
    const double diameter = std::exp(double{surface.logValues[face]}) * surface.meshLength;
    points.push_back(input.geometry.barycentres[face] - input.geometry.normals[face] * (kSightDepth * diameter));
  }
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  std::vector<LineSegment> segments;
  const auto componentOf = [&](uint32_t patch) { return input.components.componentOf[data.patches[patch].centreFace]; };
  for (uint32_t i = 0; i < count; ++i)
    for (uint32_t j = i + 1; j < count; ++j) {
      if (componentOf(i) != componentOf(j)) continue;
      pairs.emplace_back(i, j);
      segments.push_back({points[i], points[j]});
    }
  const std::vector<uint8_t> isClear = sight(segments);
  SightMatrix matrix(count);
  for (size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    matrix.set(i, j, isClear[k] ? 1.0f : 0.0f);
    const double weight = data.patches[i].area * data.patches[j].area;
    sums.all += weight;
    sums.seen += isClear[k] ? weight : 0;
  }
  return matrix;
}

/// Returns a threshold between the costs of the merges so far and the next cost.
double thresholdOf(const PartMerging& merging) {
  double last = 0;
  for (const PartMerging::Merge& merge : merging.merges()) last = std::max(last, merge.cost);
  const double next = std::max(last, merging.nextCost().value_or(last));
  return std::sqrt(last * next);
}

void mergeParts(PartMerging& merging, const PartsOptions& options, const MergeWeights& weights) {
  if (options.partCount)
    merging.mergeToCount(*options.partCount);
  else
    merging.mergeUpTo(weights.threshold / options.detail);
}

/// The threshold of the options. For a requested number of parts, the mean threshold of the divisions at this number.
double thresholdOf(std::span<const Division> divisions, const PartsOptions& options, const MergeWeights& weights) {
  if (!options.partCount) return weights.threshold / options.detail;
  double sum = 0;
  for (const Division& division : divisions) sum += std::log(std::max(thresholdOf(*division.merging), kLeastThreshold));
  return std::exp(sum / static_cast<double>(divisions.size()));
}

std::vector<uint32_t> labelsOf(const Patches& patches, std::span<const uint32_t> regions, uint32_t labelWithoutPatch) {
  std::vector<uint32_t> labels(patches.patchOf.size());
  for (size_t face = 0; face < labels.size(); ++face)
    labels[face] = patches.patchOf[face] == kNoPatch ? labelWithoutPatch : regions[patches.patchOf[face]];
  return labels;
}

/// Mean Rand index of the consensus with each division.
double agreementOf(const PartConsensus& consensus, std::span<const Division> divisions, std::span<const float> areas) {
  const std::vector<uint32_t> labels =
      labelsOf(divisions.back().patches, consensus.regionOfPatches(), consensus.regionCount());
  std::vector<double> indices(divisions.size());
  forEachTask(divisions.size(), [&](size_t i) {
    const auto& [patches, data, merging] = divisions[i];
    indices[i] = randIndex(labels, labelsOf(patches, merging->regionOfPatches(), merging->regionCount()), areas);
  });
  return std::accumulate(indices.begin(), indices.end(), 0.0) / static_cast<double>(indices.size());
}

uint32_t countAt(PartConsensus consensus, double stability, bool mergesSmall) {
  consensus.mergeUpTo(stability);
  if (mergesSmall) consensus.mergeSmallerThan(kMinPartArea);
  return consensus.regionCount();
}

/// The boundaries between parts that are regions of the consensus. patchOf: for each part, one of its patches.
std::vector<PartBoundary> boundariesOf(const PartSurface& surface, std::span<const uint32_t> partOf,
                                       std::span<const uint32_t> patchOf, const PartConsensus& consensus) {
  std::set<std::pair<uint32_t, uint32_t>> pairs;
  for (uint32_t face = 0; face < surface.faceCount(); ++face)
    for (uint32_t arc = surface.offsets[face]; arc < surface.offsets[face + 1]; ++arc)
      if (const uint32_t other = partOf[surface.arcs[arc].face]; partOf[face] < other && other < patchOf.size())
        pairs.emplace(partOf[face], other);
  std::vector<PartBoundary> boundaries;
  for (const auto& [a, b] : pairs) boundaries.push_back({a, b, consensus.stability(patchOf[a], patchOf[b])});
  return boundaries;
}

/// Labels the faces without a label. Components in `whole` get the labels from `labelCount` on. Other components get
/// the label of the patch or whole component nearest to their centre.
void labelSmallComponents(const PartsInput& input, const PartSurface& surface, const Division& division,
                          std::span<const uint32_t> whole, uint32_t labelCount, std::vector<uint32_t>& labels) {
  const size_t count = input.components.components.size();
  std::vector<Vec3d> centres(count);
  std::vector<uint32_t> faceCounts(count, 0), labelOf(count, kNoLabel);
  for (uint32_t face = 0; face < labels.size(); ++face) {
    if (labels[face] != kNoLabel) continue;
    const uint32_t component = input.components.componentOf[face];
    centres[component] += surface.centres[face];
    ++faceCounts[component];
  }
  for (size_t component = 0; component < count; ++component)
    centres[component] = centres[component] / std::max(1.0, static_cast<double>(faceCounts[component]));
  std::vector<std::pair<Vec3d, uint32_t>> targets;
  for (const PatchData::Patch& patch : division.data.patches)
    targets.emplace_back(patch.centre, labels[patch.centreFace]);
  for (const uint32_t component : whole) {
    labelOf[component] = labelCount++;
    targets.emplace_back(centres[component], labelOf[component]);
  }
  forEachInParallel(count, [&](uint32_t component) {
    if (faceCounts[component] == 0 || labelOf[component] != kNoLabel) return;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [centre, label] : targets) {
      const Vec3d between = centre - centres[component];
      if (const double squared = dot(between, between); squared < nearest) {
        nearest = squared;
        labelOf[component] = label;
      }
    }
  });
  for (uint32_t face = 0; face < labels.size(); ++face)
    if (labels[face] == kNoLabel) labels[face] = labelOf[input.components.componentOf[face]];
}

/// Numbers the parts by the mean of the values of the surface.
void numberByValue(const PartSurface& surface, Parts& parts) {
  std::vector<double> values;
  for (const float logValue : surface.logValues) values.push_back(std::exp(double{logValue}));
  numberByValue(values, parts);
}

}  // namespace

void numberByValue(std::span<const double> values, Parts& parts) {
  std::vector<double> sums(parts.partCount, 0), areas(parts.partCount, 0);
  for (size_t face = 0; face < values.size(); ++face) {
    if (std::isnan(values[face])) continue;
    const double area = std::max(parts.areas[face], 1e-12);  // Not 0, so that parts of zero area also have a mean.
    sums[parts.partOf[face]] += area * values[face];
    areas[parts.partOf[face]] += area;
  }
  const auto meanOf = [&](uint32_t part) {
    return areas[part] > 0 ? sums[part] / areas[part] : std::numeric_limits<double>::infinity();
  };
  std::vector<uint32_t> order(parts.partCount), rank(parts.partCount);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) { return meanOf(i) < meanOf(j); });
  for (uint32_t i = 0; i < parts.partCount; ++i) rank[order[i]] = i;
  for (uint32_t& part : parts.partOf) part = rank[part];
  for (PartBoundary& boundary : parts.boundaries) {
    const auto [low, high] = std::minmax(rank[boundary.first], rank[boundary.second]);
    boundary = {low, high, boundary.stability};
  }
  std::sort(parts.boundaries.begin(), parts.boundaries.end(), [](const PartBoundary& x, const PartBoundary& y) {
    return std::pair(x.first, x.second) < std::pair(y.first, y.second);
  });
}

Parts segmentIntoParts(const PartsInput& input, const PartsOptions& options, const LineOfSight& sight,
                       const RunControl& control) {
  const PartSurface surface = makePartSurface(input.mesh, input.geometry, input.graph, input.values);
  const ComponentShapes shapes = shapesOf(surface, input.components);
  const ComponentRoles roles = rolesOf(shapes);
  const auto wholeCount = static_cast<uint32_t>(roles.whole.size());
  PartsOptions dividing = options;  // Options for the components that are divided.
  if (options.partCount) dividing.partCount = *options.partCount - std::min(*options.partCount, wholeCount);
  Parts parts;
  parts.areas.assign(surface.areas.begin(), surface.areas.end());
  if (roles.firstSeeds.empty()) {
    parts.partOf.assign(input.components.componentOf.begin(), input.components.componentOf.end());
    parts.partCount = parts.fewest = parts.most = static_cast<uint32_t>(shapes.areas.size());
    numberByValue(surface, parts);
    return parts;
  }

  control.checkpoint(0);
  std::vector<Division> divisions(kPatchCounts.size());
  std::vector<Patches> patches =
      makePatches(surface, roles.firstSeeds, patchCountsFor(surface.faceCount(), options), control.withoutProgress());
  forEachTask(divisions.size(), [&](size_t i) {
    if (control.stop.stop_requested()) return;
    divisions[i].patches = std::move(patches[i]);
    divisions[i].data = describePatches(surface, input.geometry.normals, divisions[i].patches);
  });
  control.checkpoint(0.5);
  std::vector<SightMatrix> matrices;
  SightSums sums;
  for (const Division& division : divisions) matrices.push_back(findSight(input, surface, division.data, sight, sums));
  parts.meanSight = sums.all > 0 ? sums.seen / sums.all : 1;
  parts.isThinShell = parts.meanSight < kMaxWallSight && isWall(input, surface);
  const MergeWeights& weights = parts.isThinShell ? kShapeWeights : kSightWeights;
  forEachTask(divisions.size(), [&](size_t i) {
    divisions[i].merging.emplace(divisions[i].data, matrices[i], weights);
    mergeParts(*divisions[i].merging, dividing, weights);
  });
  const PartConsensus patchConsensus(surface, divisions, thresholdOf(divisions, dividing, weights));
  PartConsensus consensus = patchConsensus;
  if (dividing.partCount)
    consensus.mergeToCount(*dividing.partCount);
  else
    consensus.mergeUpTo(kMinStability);
  parts.agreement = agreementOf(consensus, divisions, surface.areas);
  const bool mergesSmall = !options.partCount;
  if (mergesSmall) consensus.mergeSmallerThan(kMinPartArea);
  const uint32_t regionCount = consensus.regionCount();
  parts.partCount = regionCount + wholeCount;
  const double step = std::log(kPartStabilityFactor) / 2;  // Stability is linear in half the logarithm of thresholds.
  parts.fewest = wholeCount + std::min(regionCount, countAt(patchConsensus, kMinStability + step, mergesSmall));
  parts.most = wholeCount + std::max(regionCount, countAt(patchConsensus, kMinStability - step, mergesSmall));
  control.checkpoint(0.8);
  const Division& division = divisions.back();
  const std::vector<uint32_t> regions = consensus.regionOfPatches();
  std::vector<uint32_t> patchOf(regionCount);  // A patch of each region.
  for (uint32_t patch = 0; patch < regions.size(); ++patch) patchOf[regions[patch]] = patch;
  parts.partOf = cutBoundaries(surface, labelsOf(division.patches, regions, kNoLabel), regionCount, control);
  labelSmallComponents(input, surface, division, roles.whole, regionCount, parts.partOf);
  parts.boundaries = boundariesOf(surface, parts.partOf, patchOf, consensus);
  numberByValue(surface, parts);
  return parts;
}

}  // namespace asdfvk
