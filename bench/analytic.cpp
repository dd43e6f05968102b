// Does the value converge to the exact one as the mesh becomes finer? Spheres, slabs and long cylinders, whose values
// are known in closed form, at increasing resolution.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/text.h"
#include "exact_values.h"
#include "pipeline/backend.h"
#include "seeds/samplers.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::string backend = "vulkan", device;
  std::vector<uint64_t> faceCounts{320, 1280, 5120, 20480, 81920, 327680, 1310720};
  std::vector<double> angles{120, 80};
  uint32_t rayCount = 30;
  uint64_t seedCount = 2000, randomSeed = 1;
};

/// Relative errors. A face is stable when its exact value has greater margins than the mesh's deviation from the shape.
struct Errors {
  uint64_t faceCount = 0, noValueCount = 0;
  std::vector<double> all, stable;
};

/// Traces up to `count` random faces that have an exact value.
std::vector<TracedFace> traceRandomFaces(Backend& backend, Mesh mesh, const AnalyticShape& shape,
                                         const ConeOptions& coneOptions, const Arguments& arguments,
                                         const RunControl& control) {
  const TraceableMesh traceable(std::move(mesh));
  const FaceGeometry& geometry = traceable.prepared.geometry;
  std::vector<uint32_t> candidates;
  for (const uint32_t face : traceable.prepared.traceableFaces)
    if (shape.hasExactValue(geometry.barycentres[face])) candidates.push_back(face);
  const std::vector<uint32_t> faces = randomPermutationSeeds(candidates, arguments.seedCount, arguments.randomSeed);
  const Cone cone = makeCone(coneOptions);
  std::vector<double> values(faces.size());
  backend.makeTracer(traceable.scene(), cone, {})->trace(faces, {values}, control);
  std::vector<TracedFace> traced;
  for (size_t i = 0; i < faces.size(); ++i)
    traced.push_back({geometry.barycentres[faces[i]], geometry.normals[faces[i]], values[i]});
  return traced;
}

Errors errorsOf(const AnalyticShape& shape, uint64_t faceCount, const ConeOptions& cone, const Arguments& arguments,
                Backend& backend, const RunControl& control) {
  Mesh mesh = shape.makeMesh(faceCount).mesh;
  const double angle = facetAngle(shape, mesh);
  Errors errors{mesh.faceCount(), 0, {}, {}};
  for (const TracedFace& face : traceRandomFaces(backend, std::move(mesh), shape, cone, arguments, control)) {
    const ExactValue exact = shape.exactValue(face);
    if (std::isnan(face.value) || std::isnan(exact.value)) {
      ++errors.noValueCount;
      continue;
    }
    const Deviation deviation = deviationAt(shape, face, angle, cone);
    errors.all.push_back(std::abs(face.value - exact.value) / exact.value);
    if (exact.cosineMargin > deviation.cosine && exact.lengthMargin > deviation.length)
      errors.stable.push_back(errors.all.back());
  }
  return errors;
}

double meanOf(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(std::max<size_t>(1, numbers.size()));
}

/// The order of convergence p: error ~ h^p, with the edge length h ~ 1 / sqrt(face count).
std::string orderText(double coarseError, double fineError, const Errors& coarse, const Errors& fine) {
  // Smaller errors are the rounding to float32.
  if (!(coarseError > 1e-6 && fineError > 1e-6) || coarse.faceCount == fine.faceCount) return "-";
  const double edgeRatio = 0.5 * std::log(static_cast<double>(fine.faceCount) / static_cast<double>(coarse.faceCount));
  return fmt::format("{:.2f}", std::log(coarseError / fineError) / edgeRatio);
}

std::string row(const Errors& errors, const std::optional<Errors>& coarser) {
  const Dispersion all = dispersionOf(errors.all), stable = dispersionOf(errors.stable);
  std::string medianOrder = "-", maximumOrder = "-";
  if (coarser) {
    medianOrder = orderText(dispersionOf(coarser->all).median, all.median, *coarser, errors);
    maximumOrder = orderText(dispersionOf(coarser->stable).max, stable.max, *coarser, errors);
  }
  return fmt::format("| {:>9} | {:>6} | {:>8} | {:.2e} | {:.2e} | {:.2e} | {:>5} | {:>6} | {:>10} | {:>5} |\n",
                     groupDigits(errors.faceCount), errors.all.size() + errors.noValueCount, errors.noValueCount,
                     meanOf(errors.all), all.max, all.median, medianOrder, errors.stable.size(),
                     errors.stable.empty() ? "-" : fmt::format("{:.2e}", stable.max), maximumOrder);
}

void printTable(const AnalyticShape& shape, const ConeOptions& cone, const Arguments& arguments, Backend& backend,
                const RunControl& control) {
  writeOutput(fmt::format(
      "\n{}; cone of {:g} degrees\n\n"
      "|     faces | traced | no value | mean     | max      | median   | order | stable | stable max | order |\n"
      "|----------:|-------:|---------:|---------:|---------:|---------:|------:|-------:|-----------:|------:|\n",
      shape.title, cone.openingAngleDegrees));
  std::optional<Errors> coarser;
  for (const uint64_t faceCount : arguments.faceCounts) {
    Errors errors = errorsOf(shape, faceCount, cone, arguments, backend, control);
    writeOutput(row(errors, coarser));
    coarser = std::move(errors);
  }
}

void run(const Arguments& arguments, const RunControl& control) {
  const NamedBackend named = openBackend(sessionOptionsOf(arguments.backend, arguments.device));
  Backend& backend = *named.backend;
  writeOutput(fmt::format(
      "{} ({}), {} rays per cone\nrelative errors of up to {} random faces; order: p in error ~ edge length^p\n"
      "stable: faces with no ray so near to the thresholds of false intersections and outliers that the facets of the\n"
      "mesh can change its classification\n",
      backend.deviceName(), named.name, arguments.rayCount, arguments.seedCount));
  for (const double angle : arguments.angles) {
    const ConeOptions cone{arguments.rayCount, angle};
    for (const AnalyticShape& shape : analyticShapes(cone)) printTable(shape, cone, arguments, backend, control);
  }
  backend.requireSilentValidation();
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-analytic",
                  "Relative errors against exact values: spheres, slabs and cylinders of increasing resolution.");
  Arguments arguments;
  program.add("--backend", arguments.backend, "vulkan, cpu or reference");
  program.add("--device", arguments.device, "Vulkan device: index or part of its name");
  program.add("--faces", arguments.faceCounts, "Resolutions, ascending");
  program.add("--seeds", arguments.seedCount, "Faces to trace of each mesh");
  program.add("--rng-seed", arguments.randomSeed, "Seed of their random choice");
  program.add("--rays", arguments.rayCount, "Rays per cone");
  program.add("--angles", arguments.angles, "Opening angles of the cones in degrees");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
