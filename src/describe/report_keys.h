// Written by scripts/write-report-keys from include/asdf_vk/thickness_report.h and include/asdf_vk/report.h.
// clang-format off
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "asdf_vk/report.h"

namespace asdfvk {

inline constexpr std::array kThinKindNames{"wall", "gap", "detail", "edge"};
inline constexpr std::array kWallChangeNames{"new", "thinner", "kept", "gone"};
inline constexpr std::array kThicknessVerdictNames{"passed", "failed", "notJudged"};
inline constexpr std::array kUnjudgedCauseNames{"border", "branching", "woundAgainst", "inverted", "doubleSided",
    "negativeVolumes", "coarseCoordinates"};
inline constexpr std::array kStageNames{"read", "geometry", "graph", "bvh", "encode", "upload", "sample", "trace",
    "thickness", "predict", "solve", "estimate", "smooth", "postprocess", "segment", "write"};
inline constexpr std::array kWarningCodeNames{"meshDefect", "invertedComponents", "componentsReversed", "facesReversed",
    "missingValues", "finishedOnCpu", "backendReplaced", "predictedOnCpu", "solvedOnCpu", "notConverged",
    "rangeDominated", "thinShell", "partCountDiffers", "onlySmallComponents", "skippedContent", "negativeVolumes",
    "coarseCoordinates", "uncertainParts", "coarseParts"};

/// Calls visit(key, member) for each member; names: the keys, separated by ", ".
template <typename Visit, typename... Members>
void visitNamed(std::string_view names, const Visit& visit, const Members&... members) {
  const auto next = [&names] {
    const std::string name(names.substr(0, names.find(',')));
    names.remove_prefix(std::min(name.size() + 2, names.size()));
    return name;
  };
  (visit(next(), members), ...);
}

// If a member is not named, the compiler reports an error.
#define ASDFVK_KEYS(Struct, ...)                                             \
  constexpr const char* structureName(const Struct&) { return #Struct; }     \
  template <typename Visit>                                                  \
  void visitKeys(const Struct& asdfvkValue, const Visit& asdfvkVisit) {      \
    const auto& [__VA_ARGS__] = asdfvkValue;                                 \
    visitNamed(#__VA_ARGS__, asdfvkVisit, __VA_ARGS__);                      \
  }
ASDFVK_KEYS(TraceVariant, kernel, fetch)
ASDFVK_KEYS(SolverReport, name, iterations, relativeResidual, converged, finishedOnCpu)
ASDFVK_KEYS(ValueRange, min, percentile1, median, percentile99, max)
ASDFVK_KEYS(PostprocessReport, min, max)
ASDFVK_KEYS(PartsReport, fewestCount, mostCount, agreement, thinShell, areaShares)
ASDFVK_KEYS(UnjudgedReason, cause, faceCount, edgeCount, face, place, bodies, isRepairable, amount)
ASDFVK_KEYS(UnjudgedFaces, openCount, invertedCount, degenerateCount, crossedCount, insideCount, reasons)
ASDFVK_KEYS(SectionBall, diameter, centre)
ASDFVK_KEYS(ChangedPlace, thickness, formerThickness, face, place)
ASDFVK_KEYS(ThinRegion, kind, min, minFace, place, opposite, oppositeFace, bodies, least, angleDegrees, width,
            faceCount, area, areaShare, change, changedPlace)
ASDFVK_KEYS(ThickBody, bodies, diameter, centre)
ASDFVK_KEYS(ThickReport, thickerThan, verdict, sentence, ratio, bodies)
ASDFVK_KEYS(ThicknessReport, isOfGaps, verdict, sentence, thinnerThan, countsDetails, countsEdges, min, minFace,
            minPlace, minOpposite, percentile1, percentile5, median, percentile95, max, noValueCount, unjudged,
            greatestSection, thinArea, thinAreaShare, regions, thick)
ASDFVK_KEYS(ThinnerRegion, thickness, formerThickness, face, place, faceCount, area, areaShare)
ASDFVK_KEYS(ComparisonReport, verdict, sentence, newCount, thinnerCount, keptCount, goneCount, formerVerdict, gone,
            unmatchedFaceCount, matchedFaceCount, thinnerArea, thinnerAreaShare, thinner)
ASDFVK_KEYS(SealedVoid, volume, face, place, size, looseBodies, isCertain)
ASDFVK_KEYS(BodyContact, bodies)
ASDFVK_KEYS(WorstFace, face, error)
ASDFVK_KEYS(ErrorEstimate, average, standardError, robustAverage, relativeMedian, relativePercentile90,
            relativeMedianStandardError, heldOutCount, worstFaces)
ASDFVK_KEYS(CheckReport, passed, independent, tracedCount, agreeingCount, noValueAgreeCount, medianDifference,
            worstDifference, worstFace, comparedCount, averageError, maximumError, interpolatedCount,
            interpolatedAverageError, interpolatedMaximumError)
ASDFVK_KEYS(MeshDefects, zeroAreaFaceCount, duplicateFaceCount, nonFiniteVertexCount, nonFiniteFaceCount,
            boundaryEdgeCount, nonManifoldEdgeCount, inconsistentEdgeCount, weldedVertexCount, unreferencedVertexCount,
            shortPolygonCount)
ASDFVK_KEYS(Warning, code, message, details)
ASDFVK_KEYS(Report, faceCount, regionFaceCount, triangleCount, vertexCount, componentCount, size, unit, chordError,
            seedCount, rayCount, redoneConeCount, noValueCount, clampedCount, reversedFaceCount, randomSeed, roundCount,
            backend, device, runsOnCpu, traceChoice, stageSeconds, raysPerSecond, solver, sdf, postprocess,
            segmentCount, parts, thickness, gap, comparison, voids, contacts, estimatedError, check, defects, warnings)
#undef ASDFVK_KEYS

}  // namespace asdfvk
