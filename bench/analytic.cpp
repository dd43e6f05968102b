// Does the value converge to the exact one as a mesh gets finer? Spheres, slabs and long cylinders, whose values are
// known in closed form, at growing resolution.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analytic_family.h"
#include "bench_program.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "core/text.h"
#include "file_run.h"
#include "spread.h"

namespace {

using namespace asdfvk;

struct Arguments {
  std::string backend = "vulkan", device;
  std::vector<uint64_t> faceCounts{320, 1280, 5120, 20480, 81920, 327680, 1310720};
  std::vector<double> angles{120, 80};
  uint32_t rayCount = 30;
  uint64_t seedCount = 2000, randomSeed = 1;
};

/// Relative errors. A face is decided when no ray of its cone is so near to being kept or dropped otherwise that the
/// mesh's flat faces could tip it.
struct Errors {
  uint64_t faceCount = 0, noValueCount = 0;
  std::vector<double> all, decided;
};

Errors errorsOf(const bench::AnalyticFamily& family, uint64_t faceCount, const ConeOptions& cone,
                const Arguments& arguments, ComputeBackend& backend, const RunControl& control) {
  Mesh mesh = family.make(faceCount).mesh;
  const double facetAngle = facetAngleOf(family, mesh);
  Errors errors{mesh.faceCount(), 0, {}, {}};
  for (const bench::TracedFace& face :
       bench::traceSample(backend, mesh, cone, family.wanted, arguments.seedCount, arguments.randomSeed, control)) {
    const bench::ExactValue exact = family.exactValue(face);
    if (std::isnan(face.value) || std::isnan(exact.value)) {
      ++errors.noValueCount;
      continue;
    }
    const bench::Deviation deviation = deviationAt(family, face, facetAngle, cone);
    errors.all.push_back(std::abs(face.value - exact.value) / exact.value);
    if (exact.cosineMargin > deviation.cosine && exact.lengthMargin > deviation.length)
      errors.decided.push_back(errors.all.back());
  }
  return errors;
}

double meanOf(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(std::max<size_t>(1, numbers.size()));
}

/// p in "the error falls as h^p", h the length of an edge, which falls as the square root of the face count rises.
std::string order(double coarseError, double fineError, const Errors& coarse, const Errors& fine) {
  // Below, rounding to float32 is all that is left.
  if (!(coarseError > 1e-6 && fineError > 1e-6) || coarse.faceCount == fine.faceCount) return "-";
  const double edgeRatio = 0.5 * std::log(static_cast<double>(fine.faceCount) / static_cast<double>(coarse.faceCount));
  return fmt::format("{:.2f}", std::log(coarseError / fineError) / edgeRatio);
}

std::string row(const Errors& errors, const Errors* coarser) {
  const bench::Spread all = bench::spreadOf(errors.all), decided = bench::spreadOf(errors.decided);
  std::string medianOrder = "-", maximumOrder = "-";
  if (coarser != nullptr) {
    medianOrder = order(bench::spreadOf(coarser->all).median, all.median, *coarser, errors);
    maximumOrder = order(bench::spreadOf(coarser->decided).max, decided.max, *coarser, errors);
  }
  return fmt::format("| {:>9} | {:>6} | {:>8} | {:.2e} | {:.2e} | {:.2e} | {:>5} | {:>7} | {:>11} | {:>5} |\n",
                     groupDigits(errors.faceCount), errors.all.size() + errors.noValueCount, errors.noValueCount,
                     meanOf(errors.all), all.max, all.median, medianOrder, errors.decided.size(),
                     errors.decided.empty() ? "-" : fmt::format("{:.2e}", decided.max), maximumOrder);
}

void tabulate(const bench::AnalyticFamily& family, const ConeOptions& cone, const Arguments& arguments,
              ComputeBackend& backend, const RunControl& control) {
  writeStandardOutput(fmt::format(
      "\n{}; cone of {:g} degrees\n\n"
      "|     faces | traced | no value | mean     | max      | median   | order | decided | max of them | order |\n"
      "|----------:|-------:|---------:|---------:|---------:|---------:|------:|--------:|------------:|------:|\n",
      family.title, cone.openingAngleDegrees));
  std::optional<Errors> coarser;
  for (const uint64_t faceCount : arguments.faceCounts) {
    Errors errors = errorsOf(family, faceCount, cone, arguments, backend, control);
    writeStandardOutput(row(errors, coarser ? &*coarser : nullptr));
    coarser = std::move(errors);
  }
}

void run(const Arguments& arguments, const RunControl& control) {
  ComputeBackend backend(bench::sessionOptionsOf(arguments.backend, arguments.device));
  writeStandardOutput(fmt::format(
      "{} ({}), {} rays\nrelative errors of up to {} random faces; order: p in error ~ edge length^p; decided: faces\n"
      "whose rays are all farther from being kept or dropped otherwise than the mesh is from the shape\n",
      backend.deviceName(), backend.name(), arguments.rayCount, arguments.seedCount));
  for (const double angle : arguments.angles) {
    const ConeOptions cone{arguments.rayCount, angle};
    for (const bench::AnalyticFamily& family : bench::analyticFamilies(cone))
      tabulate(family, cone, arguments, backend, control);
  }
  backend.requireSilentValidation();
}

}  // namespace

int main(int argc, char** argv) {
  bench::BenchProgram program("asdfvk-bench-analytic",
                              "Relative errors against exact values on spheres, slabs and cylinders of growing "
                              "resolution.");
  Arguments arguments;
  program.add("--backend", arguments.backend, "vulkan, cpu or reference");
  program.add("--device", arguments.device, "As asdf-vk takes it");
  program.add("--faces", arguments.faceCounts, "Resolutions, rising");
  program.add("--seeds", arguments.seedCount, "Faces to trace of each mesh");
  program.add("--rng-seed", arguments.randomSeed, "Of their random choice");
  program.add("--rays", arguments.rayCount, "Per cone");
  program.add("--angles", arguments.angles, "Cones, in degrees");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
