#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <string>

#include "asdf_vk/choices.h"
#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "bvh/bvh.h"
#include "pipeline/prepared_mesh.h"
#include "trace/cone_tracer.h"

namespace asdfvk::bench {

/// Throws Error{UnknownName} for a name that is not in `names`.
template <typename T, size_t N>
[[nodiscard]] T choiceNamed(const ChoiceNames<T, N>& names, const std::string& name) {
  const T* const found = findChoice(names, name);
  if (found == nullptr) throw Error(ErrorCode::UnknownName, fmt::format("'{}' is not one of {}", name, joined(names)));
  return *found;
}

/// backend: a name of kBackendNames; throws Error{UnknownName} for another. device: only for the backend vulkan.
[[nodiscard]] SessionOptions sessionOptionsOf(const std::string& backend, const std::string& device);

/// Reads "10%" (above 0, at most 100), "2000" (at least 1) or "all". Throws Error{OptionOutOfRange}.
[[nodiscard]] SeedCount parseSeedCount(const std::string& text);

/// Options of a recipe with seeds at `percent` of the faces.
[[nodiscard]] Options recipeOptions(Recipe recipe, double percent, uint64_t randomSeed = 1);

/// Options of the truth: many rays at every face, with hashed cones.
[[nodiscard]] Options truthOptions(uint32_t rayCount);

struct FileRun {
  Report report;            ///< Includes the stages read and write.
  double totalSeconds = 0;  ///< Seconds of reading, computation and writing together.
};

/// Reads the mesh, computes and writes `output`, as the command line does.
[[nodiscard]] FileRun runFile(Session& session, const std::filesystem::path& mesh, const Options& options,
                              const std::filesystem::path& output, const RunControl& control);

/// Absolute differences of two fields, divided by the range (max - min) of the first field, as in Table 1 of the ASDF
/// paper. Faces with a value in both fields are compared. Seeds, whose error is usually 0, are compared too.
struct FieldErrors {
  double average = 0, maximum = 0;
  double robustAverage = 0;  ///< Average error, divided by the 99th minus the 1st percentile of the first field.
  /// Percentiles of difference / value, with the values of the first field.
  double relativeMedian = 0, relativePercentile90 = 0;
};

/// full, approximate: #I, NaN for no value. All errors are 0 if the range is empty.
[[nodiscard]] FieldErrors errorsOverRange(std::span<const double> full, std::span<const double> approximate);

struct TraceableMesh {
  Mesh mesh;
  PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  Bvh bvh = buildBvh(prepared.mesh, prepared.geometry, prepared.representatives);

  explicit TraceableMesh(Mesh source) : mesh(std::move(source)) {}
  TraceableMesh(const TraceableMesh&) = delete;
  TraceableMesh& operator=(const TraceableMesh&) = delete;

  [[nodiscard]] TraceScene scene() const { return {prepared.mesh, prepared.geometry, prepared.representatives, bvh}; }
};

}  // namespace asdfvk::bench
