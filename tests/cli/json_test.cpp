#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

using Json = nlohmann::json;

Json onlyDocument(const ChildOutcome& outcome) {
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  REQUIRE(Json::accept(outcome.output));
  CHECK_EQ(linesOf(outcome.output).size(), 1);
  return Json::parse(outcome.output);
}

TEST_CASE("--json is exactly one document with every documented key and its type") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(16));
  const Json json = onlyDocument(
      runAsdf({mesh, "--json", "--backend", "reference", "--seeds", "10%", "--rng-seed", "7", "--check=all"}));
  CHECK_EQ(json.at("mesh").get<std::string>(), mesh);
  CHECK_EQ(json.at("output").get<std::string>(), folder / "sphere.asdf.ply");
  CHECK_EQ(json.at("faceCount").get<uint64_t>(), 960);
  CHECK_EQ(json.at("triangleCount").get<uint64_t>(), 960);
  CHECK_EQ(json.at("vertexCount").get<uint64_t>(), 482);
  CHECK_EQ(json.at("componentCount").get<uint64_t>(), 1);
  CHECK_EQ(json.at("seedCount").get<uint64_t>(), 96);
  CHECK_EQ(json.at("rayCount").get<uint64_t>(), 96 * 30);
  CHECK_EQ(json.at("noValueCount").get<uint64_t>(), 0);
  CHECK_EQ(json.at("redoneConeCount").get<uint64_t>(), 0);
  CHECK(json.at("clampedCount").is_number_unsigned());
  CHECK_EQ(json.at("randomSeed").get<uint64_t>(), 7);
  CHECK_EQ(json.at("backend").get<std::string>(), "reference");
  CHECK(json.at("device").is_string());
  CHECK(json.at("traceChoice").is_null());
  for (const char* stage : {"read", "geometry", "graph", "bvh", "encode", "upload", "sample", "trace", "predict",
                            "solve", "estimate", "smooth", "postprocess", "segment", "write"}) {
    CHECK(json.at("stageSeconds").at(stage).is_number());
    CHECK(json.at("stageSeconds").at(stage).get<double>() >= 0);
  }
  CHECK(json.at("raysPerSecond").get<double>() > 0);
  CHECK(json.at("solver").at("name").is_string());
  CHECK(json.at("solver").at("iterations").is_number_unsigned());
  CHECK(json.at("solver").at("relativeResidual").get<double>() < 1e-4);
  CHECK_FALSE(json.at("solver").at("finishedOnCpu").get<bool>());
  const Json& sdf = json.at("sdf");
  CHECK(sdf.at("min").get<double>() > 1);
  CHECK(sdf.at("min").get<double>() <= sdf.at("median").get<double>());
  CHECK(sdf.at("median").get<double>() <= sdf.at("max").get<double>());
  CHECK(sdf.at("max").get<double>() < 2);
  CHECK(json.at("warnings").empty());
  CHECK_EQ(json.at("reversedFaceCount").get<uint64_t>(), 0);
  CHECK_EQ(json.at("defects").at("boundaryEdgeCount").get<uint64_t>(), 0);
  const Json& check = json.at("check");
  CHECK_FALSE(check.at("independent").get<bool>());
  CHECK(check.at("passed").is_null());
  for (const char* key : {"tracedCount", "agreeingCount", "noValueAgreeCount", "worstFace"})
    CHECK_EQ(check.at(key).get<uint64_t>(), 0);
  for (const char* key : {"medianDifference", "worstDifference"}) CHECK_EQ(check.at(key).get<double>(), 0);
  CHECK_EQ(check.at("comparedCount").get<uint64_t>(), 960);
  CHECK_EQ(check.at("interpolatedCount").get<uint64_t>(), 960 - 96);
  for (const char* key : {"averageError", "maximumError", "interpolatedAverageError", "interpolatedMaximumError"})
    CHECK(check.at(key).get<double>() > 0);
  const Json& estimate = json.at("estimatedError");
  CHECK(estimate.at("average").get<double>() > 0);
  CHECK(estimate.at("average").get<double>() < 1);
  CHECK(estimate.at("standardError").get<double>() > 0);
  CHECK_EQ(estimate.at("heldOutCount").get<uint64_t>(), 96 / 4);
  CHECK(estimate.at("robustAverage").get<double>() > estimate.at("average").get<double>());
  CHECK(estimate.at("relativeMedian").get<double>() > 0);
  CHECK(estimate.at("relativeMedianStandardError").get<double>() > 0);
  CHECK(estimate.at("relativePercentile90").get<double>() > estimate.at("relativeMedian").get<double>());
  REQUIRE_EQ(estimate.at("worstFaces").size(), 5);
  for (const Json& worst : estimate.at("worstFaces")) {
    CHECK(worst.at("face").get<uint64_t>() < 960);
    CHECK(worst.at("error").get<double>() > 0);
  }
  CHECK_EQ(json.at("roundCount").get<uint64_t>(), 1);
  const Json& options = json.at("options");
  CHECK_EQ(options.at("seeds").get<std::string>(), "10%");
  const std::vector<std::pair<const char*, const char*>> names{
      {"recipe", "balanced"}, {"sampler", "blue-noise"},  {"coneRotation", "fixed"},
      {"weights", "feature"}, {"guidance", "prediction"}, {"orient", "keep"},
      {"smooth", "off"},      {"solver", "auto"},         {"postprocess", "none"},
      {"segment", "none"},    {"measure", "sdf"},         {"kernel", "auto"},
      {"fetch", "auto"},      {"backend", "reference"},   {"per", "face"}};
  for (const auto& [key, name] : names) CHECK_EQ(options.at(key).get<std::string>(), name);
  CHECK_EQ(options.at("rngSeed").get<uint64_t>(), 7);
  CHECK_EQ(options.at("check").get<std::string>(), "all");
  CHECK_EQ(options.at("estimate").get<bool>(), true);
  for (const char* key : {"maxError", "maxRelativeError", "parts", "detail", "clusters", "cgalExpansion"})
    CHECK(options.at(key).is_null());
  CHECK_EQ(options.at("pooling").get<double>(), 0);
  CHECK_EQ(options.at("definition").get<std::string>(), "paper");
  CHECK_EQ(options.at("falseHitAngleDegrees").get<double>(), 90);
  CHECK_EQ(options.at("outlierDeviations").get<double>(), 1);
}

TEST_CASE("options of the paper's definition are null with CGAL's") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  const Json json =
      onlyDocument(runAsdf({mesh, "--json", "--quiet", "--backend", "reference", "--definition", "cgal"}));
  const Json& options = json.at("options");
  CHECK_EQ(options.at("definition").get<std::string>(), "cgal");
  CHECK_EQ(options.at("rays").get<uint64_t>(), 25);
  CHECK_EQ(options.at("seeds").get<std::string>(), "all");
  for (const char* key : {"falseHitAngleDegrees", "outlierDeviations", "coneRotation"})
    CHECK(options.at(key).is_null());
}

TEST_CASE("the options of the command line are in the document") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  const Json json =
      onlyDocument(runAsdf({mesh, "--json", "--quiet", "--backend", "reference", "--recipe", "quality", "--sampler",
                            "adaptive", "--max-error", "50%", "--pooling", "0.5", "--smooth", "2x1"}));
  const Json& options = json.at("options");
  CHECK_EQ(options.at("recipe").get<std::string>(), "quality");
  CHECK_EQ(options.at("seeds").get<std::string>(), "2%");
  CHECK_EQ(options.at("sampler").get<std::string>(), "adaptive");
  CHECK_EQ(options.at("coneRotation").get<std::string>(), "hashed");
  CHECK_EQ(options.at("maxError").get<double>(), 0.5);
  CHECK_EQ(options.at("pooling").get<double>(), 0.5);
  CHECK_EQ(options.at("smooth").get<std::string>(), "2x1");
  CHECK(json.at("roundCount").get<uint64_t>() >= 2);  // The adaptive sampler's.
}

TEST_CASE("without an estimate it is null") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  for (const auto& further : {std::vector<std::string>{"--no-estimate"}, {"--seeds", "all"}, {"--seeds", "1"}}) {
    std::vector<std::string> arguments{mesh, "--json", "--quiet", "--backend", "reference"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    CHECK(onlyDocument(runAsdf(arguments)).at("estimatedError").is_null());
  }
}

TEST_CASE("--max-error adds seeds until the estimate is below it") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(16));
  const Json few = onlyDocument(runAsdf({mesh, "--json", "--quiet", "--backend", "reference", "--max-error", "90%"}));
  CHECK(few.at("seedCount").get<uint64_t>() < 200);
  CHECK(few.at("estimatedError").at("average").get<double>() <= 0.9);
  const Json all = onlyDocument(runAsdf({mesh, "--json", "--quiet", "--backend", "reference", "--max-error", "1e-9"}));
  CHECK_EQ(all.at("seedCount").get<uint64_t>(), 960);
  CHECK(all.at("roundCount").get<uint64_t>() > 1);
}

TEST_CASE("--max-error with rel adds seeds until the median of the relative error is below it") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(16));
  const Json json =
      onlyDocument(runAsdf({mesh, "--json", "--quiet", "--backend", "reference", "--max-error", "0.1%rel"}));
  CHECK(json.at("estimatedError").at("relativeMedian").get<double>() <= 0.001);
  CHECK_EQ(json.at("options").at("maxRelativeError").get<double>(), 0.001);
  CHECK(json.at("options").at("maxError").is_null());
  CHECK(json.at("roundCount").get<uint64_t>() > 1);
}

TEST_CASE("options that contradict each other only together with a recipe end with 1") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  checkFailure(runAsdf({mesh, "--quiet", "--backend", "reference", "--recipe", "paper", "--pooling", "0.5"}), 1,
               "pooling");
}

TEST_CASE("numbers that are not there are null") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Json json = onlyDocument(runAsdf({mesh, "--json", "--quiet", "--backend", "reference"}));
  CHECK_EQ(json.at("noValueCount").get<uint64_t>(), 1);
  CHECK(json.at("sdf").at("median").is_null());
  CHECK(json.at("check").is_null());
  REQUIRE_FALSE(json.at("warnings").empty());
  CHECK_EQ(json.at("warnings").back().at("code"), "missingValues");
  CHECK_EQ(json.at("warnings").back().at("details").at("cause"), "open");
}

TEST_CASE("the fields of a result are summarised in the document") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  const Json json = onlyDocument(runAsdf({mesh, "--json", "--quiet", "--backend", "reference", "--seeds", "10%"}));
  const Json& fields = json.at("fields");
  REQUIRE_EQ(fields.size(), 3);
  const std::vector<std::string> names{"sdf", "seed", "error"}, units{"length", "", "length"},
      types{"float64", "uint8", "float64"};
  for (size_t i = 0; i < 3; ++i) {
    CHECK_EQ(fields[i].at("name").get<std::string>(), names[i]);
    CHECK_EQ(fields[i].at("unit").get<std::string>(), units[i]);
    CHECK_EQ(fields[i].at("type").get<std::string>(), types[i]);
    CHECK_EQ(fields[i].at("per").get<std::string>(), "face");
    CHECK_EQ(fields[i].at("components").get<int>(), 1);
    CHECK_EQ(fields[i].at("missingCount").get<int>(), 0);
  }
  for (const char* key : {"min", "median", "max"}) CHECK_EQ(fields[0].at(key), json.at("sdf").at(key));
  CHECK_EQ(fields[1].at("max").get<double>(), 1);
}

TEST_CASE("of several meshes one bad one is reported and the others are done") {
  const ScratchFolder folder;
  const std::string good = folder.write("a.off", cubeOff());
  const std::string bad = folder.write("b.ply", "ply\nnonsense\n");
  const std::string alsoGood = folder.write("c.stl", cubeBinaryStl());
  const ChildOutcome outcome =
      runAsdf({good, bad, alsoGood, "--json", "--quiet", "--backend", "reference", "--format", "csv"});
  checkFailure(outcome, 7, "b.ply: ");
  const std::vector<std::string> lines = linesOf(outcome.output);
  REQUIRE_EQ(lines.size(), 3);
  const std::vector<std::string> meshes{good, bad, alsoGood};
  for (size_t i = 0; i < 3; ++i) CHECK_EQ(Json::parse(lines[i]).at("mesh").get<std::string>(), meshes[i]);
  CHECK_EQ(Json::parse(lines[0]).at("faceCount").get<int>(), 12);
  CHECK_FALSE(Json::parse(lines[1]).at("error").get<std::string>().empty());
  CHECK_EQ(Json::parse(lines[1]).at("code").get<std::string>(), "unreadableInput");
  CHECK_EQ(Json::parse(lines[2]).at("faceCount").get<int>(), 12);
  CHECK_EQ(folder.names(), std::vector<std::string>{"a.asdf.csv", "a.off", "b.ply", "c.asdf.csv", "c.stl"});
}

TEST_CASE("several meshes go into a directory") {
  const ScratchFolder folder;
  const ScratchFolder results;
  const std::string a = folder.write("a.off", cubeOff());
  const std::string b = folder.write("b.obj", cubeObj());
  const ChildOutcome outcome = runAsdf({a, b, "-o", results / "", "--backend", "reference", "--quiet"});
  CHECK_EQ(outcome.exitCode, 0);
  CHECK_EQ(results.names(), std::vector<std::string>{"a.asdf.ply", "b.asdf.ply"});
  CHECK_EQ(folder.names(), std::vector<std::string>{"a.off", "b.obj"});
}

TEST_CASE("a name that is not UTF-8 still gives a document") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("caf\xe9.off", cubeOff());
  const Json json = onlyDocument(runAsdf({mesh, "--json", "--quiet", "--backend", "reference"}));
  CHECK(json.at("mesh").get<std::string>().find("\xef\xbf\xbd") != std::string::npos);
}

TEST_CASE("the same call gives the same bits") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  for (const char* name : {"one.npy", "two.npy"})
    CHECK_EQ(runAsdf({mesh, "-o", folder / name, "--seeds", "10%", "--backend", "reference", "--quiet"}).exitCode, 0);
  CHECK_EQ(folder.read("one.npy"), folder.read("two.npy"));
  CHECK_EQ(runAsdf({mesh, "-o", folder / "three.npy", "--seeds", "10%", "--rng-seed", "2", "--backend", "reference",
                    "--quiet"})
               .exitCode,
           0);
  CHECK(folder.read("one.npy") != folder.read("three.npy"));
}

}  // namespace
}  // namespace asdfvk::test
