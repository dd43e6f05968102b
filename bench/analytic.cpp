// Does the value converge to the exact one as a mesh gets finer? Spheres, slabs and long cylinders, whose values are
// known in closed form, at growing resolution.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bench_program.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "exact_cone.h"
#include "file_run.h"
#include "generate/analytic_shapes.h"
#include "spread.h"
#include "traced_sample.h"

namespace {

using namespace asdfvk;

constexpr SphereParameters kSphere;
constexpr SlabParameters kSlab;
constexpr CylinderParameters kCylinder;

/// A shape, its exact value at a face, and the faces that it holds for.
struct Family {
  std::string title;
  std::function<GeneratedShape(uint64_t)> make;
  std::function<double(const bench::TracedFace&)> exactValue;
  std::function<bool(const Vec3d&)> wanted;
};

std::vector<Family> families(const ConeOptions& cone) {
  const bench::ExactCone exact(cone);
  const double slope = std::tan(cone.openingAngleDegrees / 2 * std::numbers::pi / 180);
  // How far along x and y, or along z, a ray can get before it is on the other side; a tenth more to be sure.
  const double slabReach = 1.1 * kSlab.thickness * slope, cylinderReach = 1.1 * 2 * kCylinder.radius * slope;
  return {
      {fmt::format("sphere, radius {}: chords 2 R cos t", kSphere.radius),
       [](uint64_t faceCount) { return makeIcosphere(faceCount, kSphere); },
       [exact](const bench::TracedFace&) { return exact.onSphere(kSphere.radius); }, [](const Vec3d&) { return true; }},
      {fmt::format("slab, {} x {} x {}, faces {:.2f} from the rim: thickness / cos t", kSlab.width, kSlab.width,
                   kSlab.thickness, slabReach),
       [](uint64_t faceCount) { return makeSlab(faceCount, kSlab); },
       [exact](const bench::TracedFace&) { return exact.inSlab(kSlab.thickness); },
       [slabReach](const Vec3d& p) {
         return std::max(std::abs(p.x), std::abs(p.y)) < kSlab.width / 2 - slabReach &&
                std::abs(p.z) > 0.49 * kSlab.thickness;
       }},
      {fmt::format("cylinder, radius {}, length {}, faces {:.2f} from the caps: rays in an endless one",
                   kCylinder.radius, kCylinder.length, cylinderReach),
       [](uint64_t faceCount) { return makeCylinder(faceCount, kCylinder); },
       [exact](const bench::TracedFace& face) {
         return exact.inCylinder(kCylinder.radius, face.barycentre, face.normal);
       },
       [cylinderReach](const Vec3d& p) { return std::abs(p.z) < kCylinder.length / 2 - cylinderReach; }}};
}

struct Errors {
  uint64_t faceCount = 0, tracedCount = 0, noValueCount = 0;
  bench::Spread relative;
  double mean = 0;
};

Errors errorsOf(const Family& family, uint64_t faceCount, uint64_t seedCount, uint64_t randomSeed,
                const ConeOptions& cone, ComputeBackend& backend, const RunControl& control) {
  Mesh mesh = family.make(faceCount).mesh;
  Errors errors{mesh.faceCount(), 0, 0, {}, 0};
  std::vector<double> relative;
  for (const bench::TracedFace& face :
       bench::traceSample(backend, mesh, cone, family.wanted, seedCount, randomSeed, control)) {
    ++errors.tracedCount;
    if (std::isnan(face.value)) {
      ++errors.noValueCount;
      continue;
    }
    const double exactValue = family.exactValue(face);
    relative.push_back(std::abs(face.value - exactValue) / exactValue);
    errors.mean += relative.back();
  }
  errors.mean /= static_cast<double>(std::max<size_t>(1, relative.size()));
  errors.relative = bench::spreadOf(std::move(relative));
  return errors;
}

/// p in "the error falls as h^p", h the length of an edge, which falls as the square root of the face count rises.
std::string order(double coarseError, double fineError, uint64_t coarseCount, uint64_t fineCount) {
  if (!(coarseError > 0 && fineError > 0) || coarseCount == fineCount) return "-";
  const double edgeRatio = 0.5 * std::log(static_cast<double>(fineCount) / static_cast<double>(coarseCount));
  return fmt::format("{:.2f}", std::log(coarseError / fineError) / edgeRatio);
}

std::string row(const Errors& errors, const std::optional<Errors>& coarser) {
  const auto orderOf = [&](double coarse, double fine) {
    return coarser ? order(coarse, fine, coarser->faceCount, errors.faceCount) : std::string("-");
  };
  return fmt::format("| {:>9} | {:>6} | {:>8} | {:>9.2e} | {:>9.2e} | {:>9.2e} | {:>9} | {:>8} |\n",
                     groupDigits(errors.faceCount), errors.tracedCount, errors.noValueCount, errors.mean,
                     errors.relative.median, errors.relative.max, coarser ? orderOf(coarser->mean, errors.mean) : "-",
                     coarser ? orderOf(coarser->relative.max, errors.relative.max) : "-");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Relative error against exact values on spheres, slabs and cylinders of growing resolution.",
               "asdfvk-bench-analytic");
  std::string backendName = "vulkan", device;
  std::vector<uint64_t> faceCounts{320, 1280, 5120, 20480, 81920, 327680, 1310720};
  uint64_t seedCount = 2000, randomSeed = 1;
  ConeOptions cone;
  app.add_option("--backend", backendName, "vulkan or reference")->capture_default_str();
  app.add_option("--device", device, "As asdf-vk takes it");
  app.add_option("--faces", faceCounts, "Resolutions, rising")->delimiter(',')->capture_default_str();
  app.add_option("--seeds", seedCount, "Random faces to trace of each mesh, at most")->capture_default_str();
  app.add_option("--rng-seed", randomSeed, "Of their choice")->capture_default_str();
  app.add_option("--rays", cone.rayCount, "Per cone")->capture_default_str();
  return bench::runBenchProgram(app, argc, argv, [&](const RunControl& control) {
    ComputeBackend backend(bench::sessionOptionsOf(backendName, device));
    writeStandardOutput(fmt::format("{} ({}), {} rays; relative errors, order in the length of an edge\n",
                                    backend.deviceName(), backend.name(), cone.rayCount));
    for (const Family& family : families(cone)) {
      writeStandardOutput(
          fmt::format("\n{}\n\n| {:>9} | {:>6} | {:>8} | {:>9} | {:>9} | {:>9} | {:>9} | {:>8} |\n"
                      "|----------:|-------:|---------:|----------:|----------:|----------:|----------:|---------:|\n",
                      family.title, "faces", "traced", "no value", "mean", "median", "max", "mean order", "max order"));
      std::optional<Errors> coarser;
      for (const uint64_t faceCount : faceCounts) {
        const Errors errors = errorsOf(family, faceCount, seedCount, randomSeed, cone, backend, control);
        writeStandardOutput(row(errors, coarser));
        coarser = errors;
      }
    }
    backend.requireSilentValidation();
  });
}
