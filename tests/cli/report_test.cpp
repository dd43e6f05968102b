#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "cli/device_output.h"
#include "cli/report_json.h"
#include "cli/report_text.h"
#include "describe/report_text.h"
#include "diagnose/device_report.h"
#include "support/kept_json.h"

namespace asdfvk {
namespace {

const std::string kMesh = "horse.ply";
const std::string kOutput = "horse.asdf.ply";

Result sampleResult() {
  Result result;
  Report& report = result.report;
  report.faceCount = 96966;
  report.triangleCount = 96966;
  report.vertexCount = 48485;
  report.componentCount = 1;
  report.seedCount = 9697;
  report.rayCount = 290910;
  report.backend = "vulkan";
  report.device = "some device";
  report.raysPerSecond = 1.25e6;
  report.solver = {"cg", 73, 9e-6, true};
  report.sdf = {.min = 0.5, .median = 1.5, .max = 2.5};
  return result;
}

MeshOutcome outcomeOf(const CommandLine& line, const Result& result) {
  return {kMesh, kOutput, line.computation, line.session, line.others, line.outputs, result};
}

CommandLine fullReport() {
  CommandLine line;
  line.outputs.verbose = true;
  return line;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("the full report begins with the short one, and has seeds, device, solver and times in plain words") {
  const CommandLine line = fullReport();
  Result result = sampleResult();
  Report& report = result.report;
  report.traceChoice = TraceVariant{TraceKernel::Ray, BvhFetch::Storage};
  report.sdf.percentile1 = 0.6;
  report.sdf.percentile99 = 2.25;
  report.regionFaceCount = report.faceCount;
  report.stageSeconds[Stage::Sample] = 0.25;
  report.stageSeconds[Stage::Predict] = 0.5;
  const std::string text = textReport(outcomeOf(line, result));
  CHECK_EQ(text,
           "horse.ply: 96,966 faces, 48,485 vertices, 1 component\n"
           "  diameter  0.5 to 2.5, median 1.5\n"
           "  size      0 x 0 x 0, bounding box\n"
           "  spread    98 % of the faces have 0.6 to 2.25\n"
           "  seeds     9,697 of 96,966 triangles cast 290,910 rays, random seed 0\n"
           "  backend   vulkan\n"
           "  device    some device; kernel ray, fetch storage\n"
           "  solver    cg, 73 iterations, relative residual 9e-06\n"
           "  rate      1.25 million rays per second\n"
           "  time      0.75 s, sample 0.25, predict 0.5\n"
           "  output    horse.asdf.ply\n");
}

TEST_CASE("the full report has the times of the device, and on a GPU a hint where rays from all faces are faster") {
  const CommandLine line = fullReport();
  Result result = sampleResult();
  Report& report = result.report;
  report.seedCount = 9696;
  report.stageSeconds[Stage::Trace] = 0.03;
  report.stageSeconds[Stage::Solve] = 0.08;
  DeviceTimes& times = report.deviceTimes.emplace();
  times.kernels[Stage::Trace] = 0.01;
  times.copies[Stage::Trace] = 0.002;
  times.raysPerSecond = 29.1e6;
  const std::string slow = textReport(outcomeOf(line, result));
  CHECK(holds(slow,
              "\n  on device kernels 0.01 s, trace 0.01; copies 0.002 s, trace 0.002; 29.1 million rays per second of "
              "kernels\n"));
  CHECK(holds(slow,
              "\n  faster    --seeds all would trace for about 0.1 s here, instead of 0.11 s for seeds and "
              "interpolation\n"));
  report.stageSeconds[Stage::Solve] = 0.06;
  CHECK_FALSE(holds(textReport(outcomeOf(line, result)), "  faster  "));
  report.stageSeconds[Stage::Solve] = 1;
  report.runsOnCpu = true;
  CHECK_FALSE(holds(textReport(outcomeOf(line, result)), "  faster  "));
}

TEST_CASE("the full report says why the automatic backend is a GPU or the CPU, and that lavapipe is slow") {
  const CommandLine line = fullReport();
  Result result = sampleResult();
  Report& report = result.report;
  report.leastRaysForGpu = 6'400'000;
  report.runsOnCpu = false;
  report.backend = "vulkan";
  CHECK(holds(textReport(outcomeOf(line, result)),
              "\n  choice    at least the 6,400,000 rays from which a GPU is faster\n"));
  CHECK_EQ(deviceChoiceLine(report, false), "");
  CHECK(deviceChoiceLine(report, true).ends_with(": at least the 6,400,000 rays from which a GPU is faster\n"));
  report.runsOnCpu = true;
  report.backend = "cpu";
  CHECK(holds(textReport(outcomeOf(line, result)),
              "\n  choice    fewer than the 6,400,000 rays from which a GPU is faster\n"));
  CHECK(deviceChoiceLine(report, false).starts_with("asdf-vk: cpu: "));
  report.leastRaysForGpu.reset();
  CHECK_FALSE(holds(textReport(outcomeOf(line, result)), "\n  choice "));
  report.backend = "vulkan";
  CHECK(holds(textReport(outcomeOf(line, result)), "\n  choice    a CPU device; --backend cpu is faster\n"));
}

TEST_CASE("the full report has the areas of parts, the estimate and every exception") {
  const CommandLine line = fullReport();
  Result result = sampleResult();
  Report& report = result.report;
  report.segmentCount = 12;
  report.parts = PartsReport{3, 5, 0.956, false, std::vector<double>(12, 1 / 12.0)};
  report.estimatedError = ErrorEstimate{.average = 0.01,
                                        .standardError = 0.002,
                                        .relativePercentile90 = 0.125,
                                        .heldOutCount = 400,
                                        .worstFaces = {{77, 0.5}, {3, 0.25}}};
  report.regionFaceCount = 1000;
  report.redoneConeCount = 3;
  report.roundCount = 2;
  report.clampedCount = 1;
  report.reversedFaceCount = 12;
  report.solver.converged = false;
  const std::string text = textReport(outcomeOf(line, result));
  for (const char* part :
       {"\n  areas     in order of the parts 8.3, 8.3, 8.3, 8.3, 8.3, 8.3, 8.3, 8.3, 8.3, 8.3, ... %; agreement "
        "0.96\n",
        "\n  estimate  standard error 0.2 %, 90 % of the faces within 12.5 % of their value, by 400 held-out faces; "
        "worst 50 % of the range, face 77\n",
        ", 2 rounds; 3 cones by the reference\n", "\n  region    1,000 faces\n",
        "\n  clamped   1 triangle, to the range of the seeds of its component\n", "\n  reversed  12 faces\n",
        ", not converged\n"})
    CHECK_MESSAGE(holds(text, part), text);
  CHECK(std::count(text.begin(), text.end(), '\n') <= 25);
}

TEST_CASE(
    "the short report has at most six lines, of 100 columns after the first, and no device, seeds, times or solver") {
  CommandLine line;
  line.outputs.points = "points.ply";
  line.outputs.picture = "picture.png";
  Result result = sampleResult();
  Report& report = result.report;
  report.sdf = {.min = 1.23456e-12, .median = 1.23456e-10, .max = 1.23456e-11};
  report.noValueCount = 12'345'678;
  report.estimatedError = ErrorEstimate{.average = 0.01234, .relativeMedian = 0.0234};
  report.segmentCount = 123;
  report.parts = PartsReport{98, 1234, 0.956, false, std::vector<double>(123, 1 / 123.0)};
  const auto lines = [&] {
    const std::string text = textReport(outcomeOf(line, result));
    std::vector<std::string> found;
    for (size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1)
      found.push_back(text.substr(begin, text.find('\n', begin) - begin));
    CHECK(found.size() <= 6);
    for (size_t i = 0; i < found.size(); ++i) CHECK_MESSAGE(found[i].size() <= (i == 0 ? 200 : 100), found[i]);
    return found;
  };
  std::vector<std::string> found = lines();
  REQUIRE(found.size() == 5);
  CHECK_EQ(found[0], "horse.ply: 96,966 faces, 48,485 vertices, 1 component");
  CHECK_EQ(found[1], "  diameter  1.235e-12 to 1.235e-11, median 1.235e-10; 12,345,678 faces without a value");
  CHECK_EQ(found[2], "  parts     123 (98 to 1,234 at nearby detail); the largest 0.81, 0.81 and 0.81 % of the area");
  CHECK_EQ(found[3], "  error     about 1.2 % of the range on average, 2.3 % of the value in the median");
  CHECK_EQ(found[4], "  output    horse.asdf.ply, points points.ply, picture picture.png");

  report.check = CheckReport{.passed = true, .tracedCount = 2000, .agreeingCount = 1999, .comparedCount = 2000};
  report.check->averageError = 0.0123;
  CHECK_EQ(lines()[3],
           "  error     1.2 % of the range on average, against the reference; 1,999 of 2,000 traced faces agree");

  ThicknessReport& thickness = report.thickness.emplace();
  report.size = {1.23456e-5, 2, 3};
  thickness.verdict = ThicknessVerdict::NotJudged;
  thickness.thinnerThan = 0.812345;
  thickness.min = 1.23456e-10;
  thickness.minFace = 1'234'567;
  thickness.minPlace = thickness.minOpposite = Vec3d{-123.456, -23.4567, -123.456};
  thickness.median = thickness.max = 1.23456e-10;
  thickness.unjudged.reasons = {{.faceCount = 12345, .edgeCount = 12345, .face = 12345, .place = {1, 2, 3}}, {}};
  for (const UnjudgedCause cause : {UnjudgedCause::Border, UnjudgedCause::Branching, UnjudgedCause::WoundAgainst,
                                    UnjudgedCause::Inverted, UnjudgedCause::DoubleSided}) {
    thickness.unjudged.reasons[0].cause = cause;
    thickness.unjudged.reasons[0].place = {-123.456, -23.4567, -123.456};
    thickness.unjudged.reasons[0].isRepairable = true;
    CHECK(lines()[1].find(", first at (-123.456, -23.4567, -123.456), face 12345") != std::string::npos);
  }
  thickness.unjudged.reasons[0].amount = 123;
  thickness.unjudged.reasons[0].cause = UnjudgedCause::NegativeVolumes;
  CHECK_EQ(lines()[1], "  unjudged  123 negative volumes not subtracted; subtract before the export; 1 more");
  thickness.unjudged.reasons[0].cause = UnjudgedCause::CoarseCoordinates;
  CHECK_EQ(lines()[1], "  unjudged  coordinates have steps of 123; move the mesh to the origin; 1 more");
  thickness.unjudged.reasons[0].cause = UnjudgedCause::Border;
  thickness.unjudged.reasons[0].place = {1, 2, 3};
  thickness.regions.assign(1234, {});
  thickness.thinAreaShare = 0.123;
  found = lines();
  REQUIRE(found.size() == 6);
  CHECK_EQ(found[0], "horse.ply: NOT JUDGED: no wall thinner than 0.812345 was found; 1,234 edges not counted");
  CHECK_EQ(found[1], "  unjudged  12,345 open edges, first at (1, 2, 3), face 12345; close the mesh; 1 more");
  CHECK_EQ(found[2], "  thickness median 1.235e-10, greatest 1.235e-10; 12.3 % of the area below 0.812345 (--verbose)");
  CHECK_EQ(found[3], "  mesh      96,966 faces, bounding box 1.235e-05 x 2 x 3");
  thickness.verdict = ThicknessVerdict::Failed;
  thickness.unjudged = {};
  thickness.countsEdges = true;
  found = lines();
  CHECK_EQ(found[0].substr(0, 64), "horse.ply: FAIL: 1,234 edges thinner than 0.812345: 1.235e-10 at");
  CHECK_EQ(found[1].substr(0, 12), "  thickness ");
  thickness.verdict = ThicknessVerdict::Passed;
  thickness.regions.clear();
  CHECK_EQ(lines()[1], "  thickness median 1.235e-10, greatest 1.235e-10");
}

TEST_CASE("a count of one has a singular noun") {
  const CommandLine line;
  Result result = sampleResult();
  result.report.faceCount = result.report.triangleCount = result.report.vertexCount = 1;
  CHECK(holds(textReport(outcomeOf(line, result)), ": 1 face, 1 vertex, 1 component\n"));
}

TEST_CASE("the text report names exceptions") {
  const CommandLine line;
  Result result = sampleResult();
  result.report.triangleCount = 100000;
  result.report.noValueCount = 2;
  const std::string text = textReport(outcomeOf(line, result));
  for (const char* part : {"(100,000 triangles)", "2 faces without a value"}) CHECK_MESSAGE(holds(text, part), text);
}

TEST_CASE("the document has the smoothed range and the number of segments") {
  const CommandLine line;
  Result result = sampleResult();
  result.report.postprocess = PostprocessReport{0.25, 2.5};
  result.report.segmentCount = 1234;
  CHECK(holds(textReport(outcomeOf(line, result)), "\n  segments  1,234\n"));
  const nlohmann::json json = test::keptDocument(jsonReport(outcomeOf(line, result)));
  CHECK_EQ(json.at("postprocess"), nlohmann::json({{"min", 0.25}, {"max", 2.5}}));
  CHECK_EQ(json.at("segmentCount"), 1234);
}

TEST_CASE("the reports have the parts, how stable their number is, and their areas") {
  const CommandLine line;
  Result result = sampleResult();
  result.report.segmentCount = 3;
  result.report.parts = PartsReport{3, 5, 0.956, false, {0.085, 0.7149, 0.2}};
  CHECK(holds(textReport(outcomeOf(line, result)),
              "\n  parts     3 (3 to 5 at nearby detail); 71, 20 and 8.5 % of the area\n"));
  const nlohmann::json json = test::keptDocument(jsonReport(outcomeOf(line, result)));
  CHECK_EQ(json.at("segmentCount"), 3);
  const nlohmann::json& parts = json.at("parts");
  CHECK_EQ(parts.at("fewestCount"), 3);
  CHECK_EQ(parts.at("mostCount"), 5);
  CHECK_EQ(parts.at("agreement"), 0.956);
  CHECK_EQ(parts.at("thinShell"), false);
  CHECK_EQ(parts.at("areaShares").size(), 3);
  result.report.parts = PartsReport{3, 3, {}, false, {1}};
  CHECK(holds(textReport(outcomeOf(line, result)), "\n  parts     3\n"));
  CHECK(test::keptDocument(jsonReport(outcomeOf(line, result))).at("parts").at("agreement").is_null());
  result.report.parts.reset();
  CHECK(test::keptDocument(jsonReport(outcomeOf(line, result))).at("parts").is_null());
}

TEST_CASE("JSON has the estimate, or null") {
  const CommandLine line = fullReport();
  Result result = sampleResult();
  Report& report = result.report;
  CHECK(test::keptDocument(jsonReport(outcomeOf(line, result))).at("estimatedError").is_null());
  report.estimatedError = ErrorEstimate{.average = 0.01,
                                        .standardError = 0.002,
                                        .relativeMedian = 0.02,
                                        .relativePercentile90 = std::numeric_limits<double>::infinity(),
                                        .heldOutCount = 400,
                                        .worstFaces = {{77, 0.5}, {3, 0.25}}};
  report.roundCount = 4;
  const nlohmann::json json = test::keptDocument(jsonReport(outcomeOf(line, result)));
  const nlohmann::json& estimate = json.at("estimatedError");
  CHECK_EQ(estimate.at("average").get<double>(), 0.01);
  CHECK_EQ(estimate.at("standardError").get<double>(), 0.002);
  CHECK_EQ(estimate.at("heldOutCount").get<int>(), 400);
  CHECK_EQ(estimate.at("relativeMedian").get<double>(), 0.02);
  CHECK(estimate.at("relativePercentile90").is_null());
  CHECK_EQ(estimate.at("worstFaces").at(1).at("face").get<int>(), 3);
  CHECK_EQ(estimate.at("worstFaces").at(1).at("error").get<double>(), 0.25);
  CHECK_EQ(json.at("roundCount").get<int>(), 4);
}

TEST_CASE("the failure of a check has the agreeing faces, a share that is never rounded up to all of them") {
  CheckReport check;
  check.tracedCount = 1000000;
  check.agreeingCount = 999999;
  CHECK(holds(checkFailure(check), "99.99 % of 1,000,000 traced faces"));
  check.agreeingCount = 1000000;
  CHECK(holds(checkFailure(check), "100 % of"));
  check.tracedCount = 103;
  check.agreeingCount = 99;
  check.noValueAgreeCount = 3;
  CHECK(holds(checkFailure(check), "99 % of 100 traced faces"));
  CHECK(holds(checkFailure(check), "; 3 more without a value in either computation"));
  check.tracedCount = check.noValueAgreeCount = 1;
  CHECK(holds(checkFailure(check), "1 traced face, none with a value in either computation"));
}

TEST_CASE("a check that compared nothing is reported as such and not as passed") {
  const CommandLine line = fullReport();
  Result result = sampleResult();
  Report& report = result.report;
  report.check.emplace().passed = false;
  CHECK(holds(checkFailure(*report.check), "nothing was compared"));
  CHECK(holds(textReport(outcomeOf(line, result)), "nothing was compared"));
  const nlohmann::json json = test::keptDocument(jsonReport(outcomeOf(line, result)));
  CHECK_FALSE(json.at("check").at("passed").get<bool>());
}

TEST_CASE("JSON has null for numbers that are not finite and is one line") {
  const CommandLine line = fullReport();
  Result result = sampleResult();
  Report& report = result.report;
  report.sdf = {};
  report.check.emplace();
  report.check->worstDifference = std::numeric_limits<double>::infinity();
  report.warnings = {{WarningCode::MeshDefect, "two\nlines", {}}};
  result.fields = {{.name = "sdf", .values = std::vector<double>{kNoValue, kNoValue}}};
  const std::string text = jsonReport(outcomeOf(line, result));
  CHECK_EQ(text.find('\n'), text.size() - 1);
  const nlohmann::json json = test::keptDocument(text);
  for (const char* key : {"min", "median", "max"}) CHECK(json.at("sdf").at(key).is_null());
  CHECK(json.at("check").at("worstDifference").is_null());
  CHECK(json.at("fields").at(0).at("median").is_null());
  CHECK_EQ(json.at("fields").at(0).at("missingCount").get<int>(), 2);
}

TEST_CASE("a warning ends with the options that help, in both reports with its code") {
  CHECK_EQ(textWarning({WarningCode::MeshDefect, "2 faces have no area", {}}, OptionSpelling::Flag),
           "2 faces have no area");
  CHECK(holds(textWarning({WarningCode::InvertedComponents, "x", {}}, OptionSpelling::Flag), "x; --orient auto "));
  CHECK(holds(textWarning({WarningCode::NotConverged, "x", {}}, OptionSpelling::Flag), "--max-iterations"));
  CHECK(holds(textWarning({WarningCode::FinishedOnCpu, "x", {}}, OptionSpelling::Flag), "--solver cpu"));
  CHECK_EQ(textWarning({WarningCode::MissingValues, "x", {}}, OptionSpelling::Flag), "x");
  CHECK(holds(textWarning({WarningCode::MissingValues, "x", {{"cause", "inverted"}}}, OptionSpelling::Flag),
              "--orient auto"));
  CHECK(holds(textWarning({WarningCode::MissingValues, "x", {{"cause", "open"}}}, OptionSpelling::Flag),
              "--orient flip"));
  const std::string both =
      textWarning({WarningCode::MissingValues, "x", {{"cause", "inverted or open"}}}, OptionSpelling::Flag);
  CHECK((holds(both, "--orient auto") && holds(both, "--orient flip")));
  const CommandLine line = fullReport();
  Result result = sampleResult();
  result.report.warnings = {{WarningCode::NotConverged, "x", {}}, {WarningCode::InvertedComponents, "y", {}}};
  const nlohmann::json json = test::keptDocument(jsonReport(outcomeOf(line, result)));
  CHECK_EQ(json.at("warnings").at(0).at("code"), "notConverged");
  CHECK_EQ(json.at("warnings").at(1).at("code"), "invertedComponents");
  CHECK_EQ(json.at("warnings").at(1).at("message"), textWarning(result.report.warnings[1], OptionSpelling::Flag));
  CHECK(json.at("warnings").at(1).at("details").empty());
}

TEST_CASE("a failure as JSON has mesh, error and code; an invalid command line has no mesh") {
  const std::string text = jsonFailure("a.ply", "deviceLost", "two\nlines");
  CHECK_EQ(text.find('\n'), text.size() - 1);
  CHECK_EQ(test::keptDocument(text),
           nlohmann::json({{"formatVersion", 1}, {"mesh", "a.ply"}, {"error", "two\nlines"}, {"code", "deviceLost"}}));
  CHECK(test::keptDocument(jsonFailure("", "optionConflict", "x")).at("mesh").is_null());
}

TEST_CASE("devices are listed with number and reason, or the reason why there are none") {
  const std::vector<DeviceInfo> devices{{"A", "a 1.0", "discrete GPU", true, "chosen"},
                                        {"Bee", "b", "CPU", false, "has no queue for compute work"}};
  CHECK_EQ(textDevices(devices, ""),
           "0  A     discrete GPU   driver a 1.0   chosen\n"
           "1  Bee   CPU            driver b       not usable: has no queue for compute work\n");
  CHECK_EQ(textDevices({}, "no loader"), "no Vulkan device: no loader\n");
  const nlohmann::json json = test::keptDocument(jsonDevices(devices, ""));
  CHECK_EQ(json.at("devices").at(1).at("name").get<std::string>(), "Bee");
  CHECK_FALSE(json.at("devices").at(1).at("usable").get<bool>());
}

TEST_CASE("the report on a device as JSON has the device, the defaults and each test") {
  DeviceReport report;
  DeviceFacts& device = report.device.emplace();
  device.name = "some GPU";
  device.kind = DeviceKind::Discrete;
  device.vendor = DeviceVendor::Amd;
  device.apiVersion = (1u << 22) | (3u << 12) | 230;
  device.subgroupSize = 64;
  report.choice = defaultTraceChoice(device);
  report.tracers = {
      {.backend = "vulkan",
       .variant = TraceVariant{TraceKernel::Ray, BvhFetch::Storage},
       .isDefault = true,
       .comparedCount = 64,
       .passed = true,
       .raysPerSecond = 2e9},
      {.backend = "vulkan", .variant = TraceVariant{TraceKernel::Ray, BvhFetch::Texel}, .refusal = "too few texels"},
      {.backend = "cpu", .differingCount = 7}};
  report.solvers = {{.name = "cg", .failure = "the device was lost"}};
  const nlohmann::json json = test::keptDocument(jsonDeviceReport(report));
  CHECK_FALSE(json.at("passed").get<bool>());
  CHECK_EQ(json.at("device").at("name"), "some GPU");
  CHECK_EQ(json.at("device").at("kind"), "discrete GPU");
  CHECK_EQ(json.at("device").at("apiVersion"), "1.3.230");
  CHECK_EQ(json.at("device").at("subgroupSize"), 64);
  CHECK_EQ(json.at("defaults").at("variant").at("kernel"), "seed");
  CHECK_EQ(json.at("defaults").at("variant").at("fetch"), "storage");
  CHECK_EQ(json.at("fastest"), json.at("tracers").at(0));
  const nlohmann::json& tracers = json.at("tracers");
  CHECK(tracers.at(0).at("passed").get<bool>());
  CHECK_EQ(tracers.at(0).at("raysPerSecond"), 2e9);
  CHECK_FALSE(tracers.at(1).at("passed").get<bool>());
  CHECK_EQ(tracers.at(1).at("refusal"), "too few texels");
  CHECK_EQ(tracers.at(1).at("variant").at("fetch"), "texel");
  CHECK(tracers.at(2).at("variant").is_null());
  CHECK_EQ(tracers.at(2).at("differingCount"), 7);
  CHECK_FALSE(json.at("solvers").at(0).at("passed").get<bool>());
  CHECK_EQ(json.at("solvers").at(0).at("failure"), "the device was lost");
}

}  // namespace
}  // namespace asdfvk
