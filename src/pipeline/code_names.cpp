#include <array>

#include "asdf_vk/report.h"

namespace asdfvk {

const char* nameOf(Stage stage) {
  constexpr std::array<const char*, kStageCount> kNames{
      "read",      "geometry", "graph", "bvh",      "encode", "upload",      "sample",  "trace",
      "thickness", "predict",  "solve", "estimate", "smooth", "postprocess", "segment", "write"};
  return kNames[static_cast<size_t>(stage)];
}

const char* nameOf(ThicknessVerdict verdict) {
  constexpr std::array<const char*, 3> kNames{"passed", "failed", "notJudged"};
  return kNames[static_cast<size_t>(verdict)];
}

const char* nameOf(WarningCode code) {
  switch (code) {
    case WarningCode::MeshDefect:
      return "meshDefect";
    case WarningCode::InvertedComponents:
      return "invertedComponents";
    case WarningCode::ComponentsReversed:
      return "componentsReversed";
    case WarningCode::MissingValues:
      return "missingValues";
    case WarningCode::FinishedOnCpu:
      return "finishedOnCpu";
    case WarningCode::BackendReplaced:
      return "backendReplaced";
    case WarningCode::PredictedOnCpu:
      return "predictedOnCpu";
    case WarningCode::SolvedOnCpu:
      return "solvedOnCpu";
    case WarningCode::NotConverged:
      return "notConverged";
    case WarningCode::RangeDominated:
      return "rangeDominated";
    case WarningCode::ThinShell:
      return "thinShell";
    case WarningCode::PartCountDiffers:
      return "partCountDiffers";
    case WarningCode::OnlySmallComponents:
      return "onlySmallComponents";
  }
  return "unknown";
}

}  // namespace asdfvk
