#pragma once

#include "asdf_vk/choices.h"
#include "asdf_vk/report.h"

/// Keys of the JSON report, which are the members of its dataclasses in Python, and names of its enumerators.
namespace asdfvk {

inline constexpr ChoiceNames<ThinKind, 4> kThinKindNames{
    {{"wall", ThinKind::Wall}, {"gap", ThinKind::Gap}, {"detail", ThinKind::Detail}, {"edge", ThinKind::Edge}}};

inline constexpr ChoiceNames<WallChange, 4> kWallChangeNames{{{"new", WallChange::New},
                                                              {"thinner", WallChange::Thinner},
                                                              {"kept", WallChange::Kept},
                                                              {"gone", WallChange::Gone}}};

inline constexpr ChoiceNames<ThicknessVerdict, 3> kThicknessVerdictNames{{{"passed", ThicknessVerdict::Passed},
                                                                          {"failed", ThicknessVerdict::Failed},
                                                                          {"notJudged", ThicknessVerdict::NotJudged}}};

inline constexpr ChoiceNames<UnjudgedCause, 7> kUnjudgedCauseNames{
    {{"border", UnjudgedCause::Border},
     {"branching", UnjudgedCause::Branching},
     {"woundAgainst", UnjudgedCause::WoundAgainst},
     {"inverted", UnjudgedCause::Inverted},
     {"doubleSided", UnjudgedCause::DoubleSided},
     {"negativeVolumes", UnjudgedCause::NegativeVolumes},
     {"coarseCoordinates", UnjudgedCause::CoarseCoordinates}}};

inline constexpr ChoiceNames<FindingKind, 8> kFindingKindNames{{{"thinWall", FindingKind::ThinWall},
                                                                {"thinDetail", FindingKind::ThinDetail},
                                                                {"thinEdge", FindingKind::ThinEdge},
                                                                {"narrowGap", FindingKind::NarrowGap},
                                                                {"thickBody", FindingKind::ThickBody},
                                                                {"sealedVoid", FindingKind::SealedVoid},
                                                                {"bodiesInContact", FindingKind::BodiesInContact},
                                                                {"unjudged", FindingKind::Unjudged}}};

inline constexpr ChoiceNames<FindingLevel, 3> kFindingLevelNames{
    {{"failure", FindingLevel::Failure}, {"notJudged", FindingLevel::NotJudged}, {"note", FindingLevel::Note}}};

inline constexpr ChoiceNames<Stage, 16> kStageNames{{{"read", Stage::Read},
                                                     {"geometry", Stage::Geometry},
                                                     {"graph", Stage::Graph},
                                                     {"bvh", Stage::Bvh},
                                                     {"encode", Stage::Encode},
                                                     {"upload", Stage::Upload},
                                                     {"sample", Stage::Sample},
                                                     {"trace", Stage::Trace},
                                                     {"thickness", Stage::Thickness},
                                                     {"predict", Stage::Predict},
                                                     {"solve", Stage::Solve},
                                                     {"estimate", Stage::Estimate},
                                                     {"smooth", Stage::Smooth},
                                                     {"postprocess", Stage::Postprocess},
                                                     {"segment", Stage::Segment},
                                                     {"write", Stage::Write}}};

inline constexpr ChoiceNames<WarningCode, 19> kWarningCodeNames{
    {{"meshDefect", WarningCode::MeshDefect},
     {"invertedComponents", WarningCode::InvertedComponents},
     {"componentsReversed", WarningCode::ComponentsReversed},
     {"facesReversed", WarningCode::FacesReversed},
     {"missingValues", WarningCode::MissingValues},
     {"finishedOnCpu", WarningCode::FinishedOnCpu},
     {"backendReplaced", WarningCode::BackendReplaced},
     {"predictedOnCpu", WarningCode::PredictedOnCpu},
     {"solvedOnCpu", WarningCode::SolvedOnCpu},
     {"notConverged", WarningCode::NotConverged},
     {"rangeDominated", WarningCode::RangeDominated},
     {"thinShell", WarningCode::ThinShell},
     {"partCountDiffers", WarningCode::PartCountDiffers},
     {"onlySmallComponents", WarningCode::OnlySmallComponents},
     {"skippedContent", WarningCode::SkippedContent},
     {"negativeVolumes", WarningCode::NegativeVolumes},
     {"coarseCoordinates", WarningCode::CoarseCoordinates},
     {"uncertainParts", WarningCode::UncertainParts},
     {"coarseParts", WarningCode::CoarseParts}}};

// choicesOf(): the names. enumerationName(): the name of the type.
#define ASDFVK_NAMES(Enumeration, names)                                      \
  constexpr const char* enumerationName(Enumeration) { return #Enumeration; } \
  constexpr const auto& choicesOf(Enumeration) { return names; }
ASDFVK_NAMES(ThinKind, kThinKindNames)
ASDFVK_NAMES(WallChange, kWallChangeNames)
ASDFVK_NAMES(ThicknessVerdict, kThicknessVerdictNames)
ASDFVK_NAMES(UnjudgedCause, kUnjudgedCauseNames)
ASDFVK_NAMES(FindingKind, kFindingKindNames)
ASDFVK_NAMES(FindingLevel, kFindingLevelNames)
ASDFVK_NAMES(Stage, kStageNames)
ASDFVK_NAMES(WarningCode, kWarningCodeNames)
ASDFVK_NAMES(TraceKernel, kKernels)
ASDFVK_NAMES(BvhFetch, kFetches)
#undef ASDFVK_NAMES

// Applies the macro visit to each of at most 120 arguments.
#define ASDFVK_PARENTHESES ()
#define ASDFVK_EXPAND(...) ASDFVK_EXPAND4(ASDFVK_EXPAND4(ASDFVK_EXPAND4(__VA_ARGS__)))
#define ASDFVK_EXPAND4(...) ASDFVK_EXPAND3(ASDFVK_EXPAND3(ASDFVK_EXPAND3(__VA_ARGS__)))
#define ASDFVK_EXPAND3(...) ASDFVK_EXPAND2(ASDFVK_EXPAND2(ASDFVK_EXPAND2(__VA_ARGS__)))
#define ASDFVK_EXPAND2(...) ASDFVK_EXPAND1(ASDFVK_EXPAND1(ASDFVK_EXPAND1(__VA_ARGS__)))
#define ASDFVK_EXPAND1(...) __VA_ARGS__
#define ASDFVK_EACH(visit, ...) __VA_OPT__(ASDFVK_EXPAND(ASDFVK_EACH_STEP(visit, __VA_ARGS__)))
#define ASDFVK_EACH_STEP(visit, first, ...) \
  visit(first) __VA_OPT__(ASDFVK_EACH_AGAIN ASDFVK_PARENTHESES(visit, __VA_ARGS__))
#define ASDFVK_EACH_AGAIN() ASDFVK_EACH_STEP

// visitKeys() calls visit(key, member) for each member. If a member is not named, the compiler reports an error.
#define ASDFVK_VISIT(member) asdfvkVisit(#member, asdfvkValue.member);
#define ASDFVK_KEYS(Struct, ...)                                         \
  constexpr const char* structureName(const Struct&) { return #Struct; } \
  template <typename Visit>                                              \
  void visitKeys(const Struct& asdfvkValue, const Visit& asdfvkVisit) {  \
    { [[maybe_unused]] const auto& [__VA_ARGS__] = asdfvkValue; }        \
    ASDFVK_EACH(ASDFVK_VISIT, __VA_ARGS__)                               \
  }
ASDFVK_KEYS(TraceVariant, kernel, fetch)
ASDFVK_KEYS(SolverReport, name, iterations, relativeResidual, converged, finishedOnCpu)
ASDFVK_KEYS(ValueRange, min, percentile1, median, percentile99, max)
ASDFVK_KEYS(PostprocessReport, min, max)
ASDFVK_KEYS(PartBoundary, first, second, stability)
ASDFVK_KEYS(PartsReport, fewestCount, mostCount, agreement, thinShell, areaShares, boundaries)
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
ASDFVK_KEYS(Finding, kind, level, value, limit, place, opposite, face, oppositeFace, faceCount, isKnown, bodies,
            message, remedy)
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
ASDFVK_KEYS(DeviceTimes, kernels, copies, raysPerSecond)
ASDFVK_KEYS(Report, faceCount, regionFaceCount, triangleCount, vertexCount, componentCount, size, unit, chordError,
            seedCount, rayCount, redoneConeCount, noValueCount, clampedCount, reversedFaceCount, randomSeed, roundCount,
            backend, device, leastRaysForGpu, runsOnCpu, traceChoice, stageSeconds, raysPerSecond, deviceTimes, solver,
            sdf, postprocess, segmentCount, parts, thickness, gap, comparison, voids, contacts, findings,
            estimatedError, check, defects, warnings)
#undef ASDFVK_KEYS
#undef ASDFVK_VISIT
#undef ASDFVK_EACH
#undef ASDFVK_EACH_STEP
#undef ASDFVK_EACH_AGAIN
#undef ASDFVK_EXPAND
#undef ASDFVK_EXPAND1
#undef ASDFVK_EXPAND2
#undef ASDFVK_EXPAND3
#undef ASDFVK_EXPAND4
#undef ASDFVK_PARENTHESES

}  // namespace asdfvk
