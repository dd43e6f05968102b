// Written by scripts/write-report-keys from include/asdf_vk/report.h.
// clang-format off
#pragma once

#include <array>

#include "asdf_vk/report.h"

namespace asdfvk {

inline constexpr std::array kStageNames{"read", "geometry", "graph", "bvh", "encode", "upload", "sample", "trace",
    "thickness", "predict", "solve", "estimate", "smooth", "postprocess", "segment", "write"};
inline constexpr std::array kWarningCodeNames{"meshDefect", "invertedComponents", "componentsReversed", "missingValues",
    "finishedOnCpu", "backendReplaced", "predictedOnCpu", "solvedOnCpu", "notConverged", "rangeDominated", "thinShell",
    "partCountDiffers", "onlySmallComponents"};
inline constexpr std::array kThicknessVerdictNames{"passed", "failed", "notJudged"};

// visitKeys(value, visit) calls visit(key, member) for each member, in their order.

constexpr const char* structureName(const TraceVariant&) { return "TraceVariant"; }
template <typename Visit>
void visitKeys(const TraceVariant& value, const Visit& visit) {
  visit("kernel", value.kernel);
  visit("bvh", value.bvh);
  visit("fetch", value.fetch);
}

constexpr const char* structureName(const SolverReport&) { return "SolverReport"; }
template <typename Visit>
void visitKeys(const SolverReport& value, const Visit& visit) {
  visit("name", value.name);
  visit("iterations", value.iterations);
  visit("relativeResidual", value.relativeResidual);
  visit("converged", value.converged);
  visit("finishedOnCpu", value.finishedOnCpu);
}

constexpr const char* structureName(const ValueRange&) { return "ValueRange"; }
template <typename Visit>
void visitKeys(const ValueRange& value, const Visit& visit) {
  visit("min", value.min);
  visit("percentile1", value.percentile1);
  visit("median", value.median);
  visit("percentile99", value.percentile99);
  visit("max", value.max);
}

constexpr const char* structureName(const PostprocessReport&) { return "PostprocessReport"; }
template <typename Visit>
void visitKeys(const PostprocessReport& value, const Visit& visit) {
  visit("min", value.min);
  visit("max", value.max);
}

constexpr const char* structureName(const PartsReport&) { return "PartsReport"; }
template <typename Visit>
void visitKeys(const PartsReport& value, const Visit& visit) {
  visit("fewestCount", value.fewestCount);
  visit("mostCount", value.mostCount);
  visit("agreement", value.agreement);
  visit("thinShell", value.thinShell);
  visit("areaShares", value.areaShares);
}

constexpr const char* structureName(const UnjudgedFaces&) { return "UnjudgedFaces"; }
template <typename Visit>
void visitKeys(const UnjudgedFaces& value, const Visit& visit) {
  visit("openCount", value.openCount);
  visit("invertedCount", value.invertedCount);
  visit("degenerateCount", value.degenerateCount);
  visit("crossedCount", value.crossedCount);
  visit("selfCrossedCount", value.selfCrossedCount);
}

constexpr const char* structureName(const SectionBall&) { return "SectionBall"; }
template <typename Visit>
void visitKeys(const SectionBall& value, const Visit& visit) {
  visit("diameter", value.diameter);
  visit("centre", value.centre);
}

constexpr const char* structureName(const SharpEdge&) { return "SharpEdge"; }
template <typename Visit>
void visitKeys(const SharpEdge& value, const Visit& visit) {
  visit("angleDegrees", value.angleDegrees);
  visit("length", value.length);
  visit("edgeCount", value.edgeCount);
  visit("place", value.place);
  visit("face", value.face);
}

constexpr const char* structureName(const ThinRegion&) { return "ThinRegion"; }
template <typename Visit>
void visitKeys(const ThinRegion& value, const Visit& visit) {
  visit("isSharp", value.isSharp);
  visit("min", value.min);
  visit("minFace", value.minFace);
  visit("place", value.place);
  visit("opposite", value.opposite);
  visit("faceCount", value.faceCount);
  visit("area", value.area);
  visit("areaShare", value.areaShare);
}

constexpr const char* structureName(const ThicknessReport&) { return "ThicknessReport"; }
template <typename Visit>
void visitKeys(const ThicknessReport& value, const Visit& visit) {
  visit("verdict", value.verdict);
  visit("thinnerThan", value.thinnerThan);
  visit("allowsSharpEdges", value.allowsSharpEdges);
  visit("min", value.min);
  visit("minFace", value.minFace);
  visit("minPlace", value.minPlace);
  visit("minOpposite", value.minOpposite);
  visit("percentile1", value.percentile1);
  visit("percentile5", value.percentile5);
  visit("median", value.median);
  visit("percentile95", value.percentile95);
  visit("max", value.max);
  visit("noValueCount", value.noValueCount);
  visit("unjudged", value.unjudged);
  visit("greatestSection", value.greatestSection);
  visit("sharpEdges", value.sharpEdges);
  visit("thinArea", value.thinArea);
  visit("thinAreaShare", value.thinAreaShare);
  visit("regions", value.regions);
}

constexpr const char* structureName(const WorstFace&) { return "WorstFace"; }
template <typename Visit>
void visitKeys(const WorstFace& value, const Visit& visit) {
  visit("face", value.face);
  visit("error", value.error);
}

constexpr const char* structureName(const ErrorEstimate&) { return "ErrorEstimate"; }
template <typename Visit>
void visitKeys(const ErrorEstimate& value, const Visit& visit) {
  visit("average", value.average);
  visit("standardError", value.standardError);
  visit("robustAverage", value.robustAverage);
  visit("relativeMedian", value.relativeMedian);
  visit("relativePercentile90", value.relativePercentile90);
  visit("relativeMedianStandardError", value.relativeMedianStandardError);
  visit("heldOutCount", value.heldOutCount);
  visit("worstFaces", value.worstFaces);
}

constexpr const char* structureName(const CheckReport&) { return "CheckReport"; }
template <typename Visit>
void visitKeys(const CheckReport& value, const Visit& visit) {
  visit("passed", value.passed);
  visit("independent", value.independent);
  visit("tracedCount", value.tracedCount);
  visit("agreeingCount", value.agreeingCount);
  visit("noValueAgreeCount", value.noValueAgreeCount);
  visit("medianDifference", value.medianDifference);
  visit("worstDifference", value.worstDifference);
  visit("worstFace", value.worstFace);
  visit("comparedCount", value.comparedCount);
  visit("averageError", value.averageError);
  visit("maximumError", value.maximumError);
  visit("interpolatedCount", value.interpolatedCount);
  visit("interpolatedAverageError", value.interpolatedAverageError);
  visit("interpolatedMaximumError", value.interpolatedMaximumError);
}

constexpr const char* structureName(const MeshDefects&) { return "MeshDefects"; }
template <typename Visit>
void visitKeys(const MeshDefects& value, const Visit& visit) {
  visit("zeroAreaFaceCount", value.zeroAreaFaceCount);
  visit("duplicateFaceCount", value.duplicateFaceCount);
  visit("nonFiniteVertexCount", value.nonFiniteVertexCount);
  visit("nonFiniteFaceCount", value.nonFiniteFaceCount);
  visit("boundaryEdgeCount", value.boundaryEdgeCount);
  visit("nonManifoldEdgeCount", value.nonManifoldEdgeCount);
  visit("inconsistentEdgeCount", value.inconsistentEdgeCount);
  visit("unreferencedVertexCount", value.unreferencedVertexCount);
  visit("shortPolygonCount", value.shortPolygonCount);
}

constexpr const char* structureName(const Warning&) { return "Warning"; }
template <typename Visit>
void visitKeys(const Warning& value, const Visit& visit) {
  visit("code", value.code);
  visit("message", value.message);
  visit("details", value.details);
}

constexpr const char* structureName(const Report&) { return "Report"; }
template <typename Visit>
void visitKeys(const Report& value, const Visit& visit) {
  visit("faceCount", value.faceCount);
  visit("regionFaceCount", value.regionFaceCount);
  visit("triangleCount", value.triangleCount);
  visit("vertexCount", value.vertexCount);
  visit("componentCount", value.componentCount);
  visit("size", value.size);
  visit("seedCount", value.seedCount);
  visit("rayCount", value.rayCount);
  visit("redoneConeCount", value.redoneConeCount);
  visit("noValueCount", value.noValueCount);
  visit("clampedCount", value.clampedCount);
  visit("reversedFaceCount", value.reversedFaceCount);
  visit("randomSeed", value.randomSeed);
  visit("roundCount", value.roundCount);
  visit("backend", value.backend);
  visit("device", value.device);
  visit("runsOnCpu", value.runsOnCpu);
  visit("traceChoice", value.traceChoice);
  visit("stageSeconds", value.stageSeconds);
  visit("raysPerSecond", value.raysPerSecond);
  visit("traceDeviceSeconds", value.traceDeviceSeconds);
  visit("solver", value.solver);
  visit("sdf", value.sdf);
  visit("postprocess", value.postprocess);
  visit("segmentCount", value.segmentCount);
  visit("parts", value.parts);
  visit("thickness", value.thickness);
  visit("estimatedError", value.estimatedError);
  visit("check", value.check);
  visit("defects", value.defects);
  visit("warnings", value.warnings);
}

}  // namespace asdfvk
