#include "cli/options.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include "batch/message_channel.h"
#include "cli/one_mesh.h"
#include "cli/refusal.h"
#include "cli/scratch_folder.h"
#include "trace/vulkan/vulkan_trace_choice.h"

namespace asdfvk {
namespace {

TEST_CASE("a mesh alone gives the defaults") {
  const CommandLine line = parseCommandLine({"a.ply"});
  CHECK_EQ(line.meshes, std::vector<std::string>{"a.ply"});
  CHECK(line.computation.options.seeds.kind == SeedCount::Kind::Automatic);
  CHECK_EQ(line.computation.options.cone.rayCount, 30);
  CHECK_EQ(line.computation.options.cone.openingAngleDegrees, 120);
  CHECK(line.computation.recipe == Recipe::Balanced);
  CHECK_EQ(line.computation.options.sampler, "blue-noise");
  CHECK(line.computation.options.interpolation.weights == ArcWeights::Feature);
  CHECK(line.computation.options.interpolation.guidance == Guidance::Prediction);
  CHECK_EQ(line.computation.options.interpolation.pooling, 0);
  CHECK(line.computation.options.cone.rotation == ConeRotation::Fixed);
  CHECK(line.computation.options.estimatesError);
  CHECK_FALSE(line.computation.options.rounds.areSet());
  CHECK(line.computation.options.orientation == Orientation::Keep);
  CHECK_EQ(line.computation.options.solver, "auto");
  CHECK_EQ(line.session.backend, "auto");
  const TraceVariant& variant = line.session.variant;
  CHECK((variant.kernel.empty() && variant.fetch.empty()));
  CHECK_EQ(fieldNames(line.outputs, line.computation.options), std::vector<std::string>{"sdf", "seed"});
  CHECK_FALSE(line.computation.options.checkCount.has_value());
  CHECK_FALSE(line.answer.has_value());
  CHECK(line.outputs.path.empty());
  CHECK_FALSE((line.outputs.json || line.outputs.quiet || line.outputs.ascii || line.listDevices || line.deviceReport ||
               line.session.requireGpu));
}

TEST_CASE("the options of a picture") {
  CHECK(parseCommandLine({"a.ply"}).outputs.picture.empty());
  const CommandLine line = parseCommandLine(
      {"a.ply", "--picture", "b.PNG", "--picture-of", "seed", "--picture-view", "-20,7.5", "--picture-up", "-x"});
  CHECK_EQ(line.outputs.picture, "b.PNG");
  CHECK_EQ(parseCommandLine({"a.ply", "--picture", "b.png", "--picture-of", "seeds"}).outputs.pictureOf, "seed");
  CHECK(line.outputs.pictureOf == "seed");
  CHECK_EQ(line.outputs.pictureView.azimuthDegrees, -20);
  CHECK_EQ(line.outputs.pictureView.elevationDegrees, 7.5);
  CHECK(line.outputs.pictureView.up == Up::MinusX);
  CHECK_FALSE(
      parseCommandLine({"a.ply", "--picture", "b.png", "--picture-up", "auto"}).outputs.pictureView.up.has_value());
  for (const char* view : {"30", "30,91", "30,-91", "361,0", "a,b", "1,2,3", ","})
    CHECK_MESSAGE(refusal({"a.ply", "--picture", "b.png", "--picture-view", view}) != "accepted", view);
  CHECK(refusal({"a.ply", "--picture", "b.jpg"}).find(".png") != std::string::npos);
  CHECK(refusal({"a.ply", "--picture-of", "seeds"}).find("--picture") != std::string::npos);
  CHECK(refusal({"a.ply", "b.ply", "--picture", "c.png"}).find("one mesh") != std::string::npos);
  CHECK(refusal({"a.ply", "-o", "-", "--picture", "-"}).find("standard output") != std::string::npos);
}

std::string hashOfOptions(const CommandLine& line) { return optionsHash(line.computation, line.session, line.outputs); }

/// The fields that are written.
std::vector<std::string> fieldsIn(const CommandLine& line) {
  return fieldNames(line.outputs, line.computation.options);
}

/// An option with a value that is not the default, and whether the value is in its field.
struct OptionCase {
  std::vector<std::string> arguments;
  bool (*isSet)(const CommandLine& line);
};

const std::vector<OptionCase>& optionCases() {
  using Line = CommandLine;
  static const std::vector<OptionCase> cases{
      {{"--seeds", "25%"}, [](const Line& l) { return l.computation.options.seeds.share == 0.25; }},
      {{"--rng-seed", "18446744073709551615"},
       [](const Line& l) { return l.computation.options.randomSeed == std::numeric_limits<uint64_t>::max(); }},
      {{"--rays", "64"}, [](const Line& l) { return l.computation.options.cone.rayCount == 64; }},
      {{"--angle", "90.5"}, [](const Line& l) { return l.computation.options.cone.openingAngleDegrees == 90.5; }},
      {{"--false-hit-angle", "45"},
       [](const Line& l) { return l.computation.options.cone.falseHitAngleDegrees == 45; }},
      {{"--outlier-deviations", "1.5"},
       [](const Line& l) { return l.computation.options.cone.outlierDeviations == 1.5; }},
      {{"--cone-rotation", "hashed"},
       [](const Line& l) { return l.computation.options.cone.rotation == ConeRotation::Hashed; }},
      {{"--definition", "cgal"},
       [](const Line& l) {
         return l.computation.options.cone.definition == Definition::Cgal &&
                l.computation.options.cone.rayCount == 25 && l.computation.options.seeds.kind == SeedCount::Kind::All;
       }},
      {{"--recipe", "quality"}, [](const Line& l) { return l.computation.recipe == Recipe::Quality; }},
      {{"--sampler", "farthest-point"},
       [](const Line& l) { return l.computation.options.sampler == "farthest-point"; }},
      {{"--max-error", "1.5%"}, [](const Line& l) { return l.computation.options.rounds.maxError == 0.015; }},
      {{"--max-error", "5%rel"},
       [](const Line& l) {
         return l.computation.options.rounds.maxRelativeError == 0.05 &&
                !l.computation.options.rounds.maxError.has_value();
       }},
      {{"--time-budget", "2.5s"}, [](const Line& l) { return l.computation.options.rounds.timeBudgetSeconds == 2.5; }},
      {{"--no-estimate"}, [](const Line& l) { return !l.computation.options.estimatesError; }},
      {{"--weights", "distance"},
       [](const Line& l) { return l.computation.options.interpolation.weights == ArcWeights::Distance; }},
      {{"--guidance", "curvature"},
       [](const Line& l) { return l.computation.options.interpolation.guidance == Guidance::Curvature; }},
      {{"--pooling", "0.3"}, [](const Line& l) { return l.computation.options.interpolation.pooling == 0.3; }},
      {{"--smooth", "3x2"},
       [](const Line& l) {
         const SmoothingOptions& smoothing = l.computation.options.smoothing;
         return smoothing.isOn && smoothing.window == SmoothingOptions::Window{.rings = 3, .passes = 2};
       }},
      {{"--postprocess", "cgal"},
       [](const Line& l) {
         return l.computation.options.postprocess == Postprocess::Cgal &&
                l.computation.options.segmentation == Segmentation::None;
       }},
      {{"--measure", "thickness"}, [](const Line& l) { return l.computation.options.measure == Measure::Thickness; }},
      {{"--colour-of", "seed"}, [](const Line& l) { return l.outputs.colourOf == "seed"; }},
      {{"--vertex-colours"}, [](const Line& l) { return l.outputs.coloursVertices; }},
      {{"--thinner-than", "0.5"}, [](const Line& l) { return l.computation.options.thickness.thinnerThan == 0.5; }},
      {{"--fail-if-thinner", "0.25"}, [](const Line& l) { return l.computation.failIfThinner == 0.25; }},
      {{"--allow-sharp-edges", "--thinner-than", "0.5"},
       [](const Line& l) { return l.computation.options.thickness.allowsSharpEdges; }},
      {{"--wall-angle", "150", "--measure", "thickness"},
       [](const Line& l) { return l.computation.options.thickness.wallAngleDegrees == 150; }},
      {{"--segment", "cgal"},
       [](const Line& l) {
         return l.computation.options.segmentation == Segmentation::Cgal &&
                l.computation.options.postprocess == Postprocess::Cgal;
       }},
      {{"--parts", "7", "--segment", "parts"},
       [](const Line& l) {
         return l.computation.options.segmentation == Segmentation::Parts &&
                l.computation.options.parts.partCount == 7u && l.computation.options.postprocess == Postprocess::None;
       }},
      {{"--detail", "2.5", "--segment"},
       [](const Line& l) {
         return l.computation.options.parts.detail == 2.5 && !l.computation.options.parts.partCount;
       }},
      {{"--clusters", "3", "--segment", "cgal"},
       [](const Line& l) { return l.computation.options.cgalSegmentation.clusterCount == 3; }},
      {{"--smoothness", "0.5", "--segment", "cgal"},
       [](const Line& l) { return l.computation.options.cgalSegmentation.smoothness == 0.5; }},
      {{"--cgal-expansion", "first", "--segment", "cgal"},
       [](const Line& l) { return l.computation.options.cgalSegmentation.expansion == CgalExpansion::First; }},
      {{"--recursive"}, [](const Line& l) { return l.batch.recurses; }},
      {{"--files-from", "list"}, [](const Line& l) { return l.batch.list == "list"; }},
      {{"--null", "--files-from", "list"}, [](const Line& l) { return l.batch.isNullSeparated; }},
      {{"--shard", "2/7"}, [](const Line& l) { return l.batch.shard && l.batch.shard->index == 2; }},
      {{"--log", "log"}, [](const Line& l) { return l.batch.log == "log"; }},
      {{"--skip-existing"}, [](const Line& l) { return l.batch.skipsExisting; }},
      {{"--timeout", "2.5s"}, [](const Line& l) { return l.batch.timeoutSeconds == 2.5; }},
      {{"--memory-limit", "2M"}, [](const Line& l) { return l.batch.memoryBytes == 2u << 20; }},
      {{"--isolate"}, [](const Line& l) { return l.batch.isolates; }},
      {{"--jobs", "3"}, [](const Line& l) { return l.batch.jobCount == 3; }},
      {{"--open"}, [](const Line& l) { return l.outputs.opensPage; }},
      {{"--solver", "jacobi"}, [](const Line& l) { return l.computation.options.solver == "jacobi"; }},
      {{"--tolerance", "1e-3"}, [](const Line& l) { return l.computation.options.solverOptions.tolerance == 1e-3; }},
      {{"--max-iterations", "77"},
       [](const Line& l) { return l.computation.options.solverOptions.maxIterations == 77; }},
      {{"--orient", "flip"}, [](const Line& l) { return l.computation.options.orientation == Orientation::Flip; }},
      {{"--check=all"},
       [](const Line& l) { return l.computation.options.checkCount == std::numeric_limits<uint64_t>::max(); }},
      {{"--output", "b.ply"}, [](const Line& l) { return l.outputs.path == "b.ply"; }},
      {{"-o", "b.ply"}, [](const Line& l) { return l.outputs.path == "b.ply"; }},
      {{"--format", "vtu"}, [](const Line& l) { return l.outputs.format == "vtu"; }},
      {{"--fields", "error,sdf"},
       [](const Line& l) {
         return l.outputs.fields == std::vector<std::string>{"error", "sdf"};
       }},
      {{"--fields", "centre"}, [](const Line& l) { return l.computation.options.computesCentres; }},
      {{"--per", "vertex"}, [](const Line& l) { return l.computation.options.per == PerElement::Vertices; }},
      {{"--points", "b.PLY"},
       [](const Line& l) { return l.outputs.points == "b.PLY" && l.computation.options.computesCentres; }},
      {{"--points", "b.swc"}, [](const Line& l) { return l.outputs.points == "b.swc"; }},
      {{"--fields", "component"}, [](const Line& l) { return l.computation.options.computesCentres; }},
      {{"--points", "-"}, [](const Line& l) { return l.outputs.points == "-"; }},
      {{"--ascii"}, [](const Line& l) { return l.outputs.ascii; }},
      {{"--open", "-o", "b.html"}, [](const Line& l) { return l.outputs.opensPage; }},
      {{"--json"}, [](const Line& l) { return l.outputs.json; }},
      {{"--quiet"}, [](const Line& l) { return l.outputs.quiet; }},
      {{"--verbose"}, [](const Line& l) { return l.outputs.verbose; }},
      {{"--picture", "b.png"},
       [](const Line& l) { return l.outputs.picture == "b.png" && l.computation.options.keepsScene; }},
      {{"--picture-of", "error", "--picture", "b.png"}, [](const Line& l) { return l.outputs.pictureOf == "error"; }},
      {{"--picture-view", "5,7.5", "--picture", "b.png"},
       [](const Line& l) {
         return l.outputs.pictureView.azimuthDegrees == 5 && l.outputs.pictureView.elevationDegrees == 7.5;
       }},
      {{"--picture-up", "-x", "--picture", "b.png"},
       [](const Line& l) { return l.outputs.pictureView.up == Up::MinusX; }},
      {{"--backend", "reference"}, [](const Line& l) { return l.session.backend == "reference"; }},
      {{"--device", "llvmpipe"}, [](const Line& l) { return l.session.device == "llvmpipe"; }},
      {{"--require-gpu"}, [](const Line& l) { return l.session.requireGpu; }},
      {{"--threads", "3"}, [](const Line& l) { return l.session.threadCount == 3; }},
      {{"--kernel", "packet"}, [](const Line& l) { return l.session.variant.kernel == "packet"; }},
      {{"--fetch", "storage"}, [](const Line& l) { return l.session.variant.fetch == "storage"; }},
  };
  return cases;
}

/// "--seeds" of "  --seeds N%|N|all   Faces ..." and so on.
std::set<std::string> optionsIn(const std::string& help) {
  std::set<std::string> names;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  -")) continue;
    const size_t begin = line.find("--");
    names.insert(line.substr(begin, line.find_first_of(" [", begin) - begin));
  }
  return names;
}

TEST_CASE("every option reaches its field") {
  const CommandLine defaults = parseCommandLine({"a.ply"});
  for (const OptionCase& option : optionCases()) {
    INFO(option.arguments.front());
    CHECK_FALSE(option.isSet(defaults));
    std::vector<std::string> arguments = option.arguments;
    arguments.emplace_back("a.ply");
    const CommandLine line = parseCommandLine(arguments);
    CHECK(option.isSet(line));
    CHECK_EQ(line.meshes, std::vector<std::string>{"a.ply"});
  }
}

TEST_CASE("the table of options above is complete") {
  std::set<std::string> inTable{"--help", "--version", "--list-devices", "--device-report"};
  for (const OptionCase& option : optionCases()) {
    const std::string& name = option.arguments.front();
    if (name != "-o") inTable.insert(name.substr(0, name.find('=')));
  }
  CHECK(optionsIn(parseCommandLine({"--help=all"}).answer.value()) == inTable);
}

TEST_CASE("every option changes the hash that --skip-existing compares, except those that do not change an output") {
  const std::set<std::string> exceptions{
      "--json",       "--quiet",   "--verbose", "--open",  // Not in the output.
      "-o",           "--output",  "--points",  "--picture",   "--picture-of",  "--picture-view",
      "--picture-up",  // Other outputs.
      "--log",        "--shard",   "--null",    "--recursive", "--files-from",  "--skip-existing",
      "--jobs",       "--threads", "--isolate", "--timeout",   "--memory-limit"};
  const auto hashOf = [](std::vector<std::string> arguments, const std::vector<std::string>& more = {}) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.emplace_back("a.ply");
    return hashOfOptions(parseCommandLine(arguments));
  };
  std::set<std::string> hashes{hashOf({})};
  for (const OptionCase& option : optionCases()) {
    const std::string& name = option.arguments.front();
    INFO(name);
    if (exceptions.contains(name)) {
      // --points implies a field, --open a format; a batch refuses both.
      if (name != "--points" && name != "--open") CHECK_EQ(hashOf(option.arguments), hashOf({}));
    } else {
      CHECK_MESSAGE(hashes.insert(hashOf(option.arguments)).second, "the hash of other options");
    }
  }
}

TEST_CASE("a worker gets all settings") {
  const auto settingsFor = [](std::vector<std::string> arguments) {
    arguments.emplace_back("caf\xe9.ply");
    const CommandLine line = parseCommandLine(arguments);
    return MeshSettings{line.session, line.computation, line.outputs, line.batch.timeoutSeconds, true};
  };
  std::vector<std::vector<std::string>> calls{{"-o", "caf\xe9"}};
  for (const OptionCase& option : optionCases()) calls.push_back(option.arguments);
  for (const std::vector<std::string>& arguments : calls) {
    INFO(arguments.front());
    const MeshSettings sent = settingsFor(arguments);
    const MeshSettings received = settingsOf(decode(encode(toJson(sent))));
    CHECK_EQ(toJson(received), toJson(sent));
    CHECK_EQ(optionsHash(received.computation, received.session, received.outputs),
             optionsHash(sent.computation, sent.session, sent.outputs));
    CHECK_EQ(received.outputs.path, sent.outputs.path);
    CHECK_EQ(received.timeoutSeconds, sent.timeoutSeconds);
    CHECK(received.makesFolders);
  }
}

TEST_CASE("the hash of the options is of exact numbers, and of what a page shows") {
  const auto hashOf = [](const std::vector<std::string>& arguments) {
    return hashOfOptions(parseCommandLine(arguments));
  };
  CHECK_NE(hashOf({"a.ply", "--seeds", "1.00000001%"}), hashOf({"a.ply", "--seeds", "1%"}));
  CHECK_NE(hashOf({"a.ply", "--format", "html", "--fields", "sdf,seed"}), hashOf({"a.ply", "--format", "html"}));
}

TEST_CASE("the rows have the names of samplers, solvers, backends and kernel variants") {
  const auto withAuto = [](std::vector<std::string> names) {
    names.insert(names.begin(), "auto");
    return std::set<std::string>(names.begin(), names.end());
  };
  const auto namesIn = [&](const auto& table) {
    std::vector<std::string> names;
    for (const auto& row : table) names.emplace_back(row.first);
    return withAuto(names);
  };
  const auto ofRow = [](OptionRows rows, const char* name) {
    const std::vector<std::string> names = namesOf(*findOption(rows, name));
    return std::set<std::string>(names.begin(), names.end());
  };
  const std::vector<std::string> samplers = samplerNames();
  CHECK(ofRow(computationRows(), "sampler") == std::set<std::string>(samplers.begin(), samplers.end()));
  CHECK(ofRow(computationRows(), "solver") == withAuto(solverNames()));
  CHECK(ofRow(sessionRows(), "backend") == withAuto(backendNames()));
  CHECK(ofRow(sessionRows(), "kernel") == namesIn(kKernels));
  CHECK(ofRow(sessionRows(), "fetch") == namesIn(kFetches));
}

TEST_CASE("a kernel variant of auto is the default") {
  const TraceVariant variant = parseCommandLine({"a.ply", "--kernel", "auto", "--fetch", "auto"}).session.variant;
  CHECK((variant.kernel.empty() && variant.fetch.empty()));
}

TEST_CASE("--fields keeps the order of the names") {
  const auto fieldsOf = [](const char* text) { return parseCommandLine({"a.ply", "--fields", text}).outputs.fields; };
  CHECK_EQ(fieldsOf("seed"), std::vector<std::string>{"seed"});
  CHECK_EQ(fieldsOf("error,seed,sdf"), std::vector<std::string>{"error", "seed", "sdf"});
  CHECK_EQ(refusal({"a.ply", "--fields", "sdf,sdf"}), "--fields: 'sdf,sdf' names sdf twice");
  CHECK(refusal({"a.ply", "--fields", "sdf,depth"}).starts_with("--fields: 'depth' is not a field"));
  for (const char* text : {"", ",", "sdf,", ",sdf", "sdf,,seed", "sdf seed", "SDF"})
    CHECK_MESSAGE(refusal({"a.ply", "--fields", text}).starts_with("--fields: '"), text);
}

TEST_CASE("--segment without a value is --segment parts, wherever it stands") {
  using Arguments = std::vector<std::string>;
  for (const Arguments& arguments : {Arguments{"a.ply", "--segment"},
                                     {"--segment", "a.ply"},
                                     {"--segment", "a.ply", "--json"},
                                     {"--segment", "--json", "a.ply"},
                                     {"--segment", "folder/mesh"},
                                     {"--segment", "-"},
                                     {"--segment=parts", "a.ply"},
                                     {"--segment", "parts", "a.ply"},
                                     {"--segment", "--", "a.ply"}}) {
    const CommandLine line = parseCommandLine(arguments);
    CHECK(line.computation.options.segmentation == Segmentation::Parts);
    CHECK_EQ(line.meshes.size(), 1);
  }
  CHECK(parseCommandLine({"a.ply", "--segment", "none"}).computation.options.segmentation == Segmentation::None);
  CHECK_EQ(parseCommandLine({"a.ply", "--", "--segment"}).meshes, Arguments{"a.ply", "--segment"});
}

TEST_CASE("the value of --segment is no file, also where a file or folder has its name") {
  const test::ScratchFolder folder;
  for (const char* name : {"parts", "cgal"}) (void)folder.write(name, "");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / ".");
  std::vector<CommandLine> lines;
  for (const char* name : {"parts", "cgal"}) lines.push_back(parseCommandLine({"a.ply", "--segment", name}));
  std::filesystem::current_path(before);
  CHECK(lines[0].computation.options.segmentation == Segmentation::Parts);
  CHECK(lines[1].computation.options.segmentation == Segmentation::Cgal);
  for (const CommandLine& line : lines) CHECK_EQ(line.meshes, std::vector<std::string>{"a.ply"});
}

TEST_CASE("the fields of --postprocess and --segment are written without --fields") {
  const auto fieldsOf = [](std::vector<std::string> arguments) {
    arguments.emplace_back("a.ply");
    return fieldsIn(parseCommandLine(arguments));
  };
  CHECK_EQ(fieldsOf({"--postprocess", "cgal"}), std::vector<std::string>{"sdf", "seed", "normalized"});
  CHECK_EQ(fieldsOf({"--segment", "cgal"}), std::vector<std::string>{"sdf", "seed", "normalized", "segment"});
  CHECK_EQ(fieldsOf({"--segment"}), std::vector<std::string>{"sdf", "seed", "segment"});
  CHECK_EQ(fieldsOf({"--segment", "cgal", "--fields", "segment"}), std::vector<std::string>{"segment"});
  CHECK_EQ(fieldsOf({"--segment", "none", "--postprocess", "none"}), std::vector<std::string>{"sdf", "seed"});
}

TEST_CASE("--check without a number does not parse the next mesh name as one") {
  for (const auto& arguments : {std::vector<std::string>{"--check", "a.ply"}, {"a.ply", "--check"}}) {
    const CommandLine line = parseCommandLine(arguments);
    CHECK_EQ(line.meshes, std::vector<std::string>{"a.ply"});
    CHECK_EQ(line.computation.options.checkCount.value(), 2000);
  }
  CHECK_EQ(parseCommandLine({"--check=5", "a.ply"}).computation.options.checkCount.value(), 5);
  CHECK_EQ(parseCommandLine({"--", "--check"}).meshes, std::vector<std::string>{"--check"});
}

TEST_CASE("meshes: many, standard input, odd names") {
  CHECK_EQ(parseCommandLine({"a.ply", "--quiet", "-", "b c.off"}).meshes,
           std::vector<std::string>{"a.ply", "-", "b c.off"});
  CHECK_EQ(parseCommandLine({"--", "-x.ply"}).meshes, std::vector<std::string>{"-x.ply"});
  CHECK(refusal({"-", "-"}).find("once") != std::string::npos);
  CHECK(refusal({""}).find("empty") != std::string::npos);
  CHECK(refusal({"--quiet"}).find("no mesh") != std::string::npos);
  CHECK(parseCommandLine({"--list-devices"}).listDevices);
  CHECK(parseCommandLine({"--device-report"}).deviceReport);
  CHECK(refusal({"--device-report", "a.ply"}).find("--device-report") != std::string::npos);
}

TEST_CASE("each sampler, weight and guidance has its name") {
  const auto optionsWith = [](const char* option, const char* name) {
    return parseCommandLine({"a.ply", option, name}).computation.options;
  };
  for (const std::string& name : samplerNames()) CHECK_EQ(optionsWith("--sampler", name.c_str()).sampler, name);
  CHECK(optionsWith("--weights", "distance").interpolation.weights == ArcWeights::Distance);
  CHECK(optionsWith("--guidance", "none").interpolation.guidance == Guidance::None);
  CHECK(optionsWith("--guidance", "curvature").interpolation.guidance == Guidance::Curvature);
  CHECK(optionsWith("--cone-rotation", "hashed").cone.rotation == ConeRotation::Hashed);
}

TEST_CASE("single options override the recipe, in any order") {
  for (const auto& arguments : {std::vector<std::string>{"a.ply", "--recipe", "paper", "--weights", "feature"},
                                {"a.ply", "--weights", "feature", "--recipe", "paper"}}) {
    const CommandLine line = parseCommandLine(arguments);
    CHECK(line.computation.recipe == Recipe::Paper);
    CHECK(line.computation.options.interpolation.weights == ArcWeights::Feature);
    CHECK(line.computation.options.interpolation.guidance == Guidance::Curvature);
    CHECK_EQ(line.computation.options.sampler, "random");
  }
  const CommandLine line = parseCommandLine({"a.ply", "--sampler", "adaptive", "--pooling", "0", "--cone-rotation",
                                             "fixed", "--guidance", "none", "--recipe", "quality"});
  CHECK_EQ(line.computation.options.sampler, "adaptive");
  CHECK(line.computation.options.cone.rotation == ConeRotation::Fixed);
  CHECK(line.computation.options.interpolation.guidance == Guidance::None);
  CHECK_EQ(line.computation.options.interpolation.pooling, 0);
  CHECK(line.computation.options.interpolation.weights == ArcWeights::Feature);
  CHECK_EQ(parseCommandLine({"a.ply", "--seeds", "3", "--recipe", "paper"}).computation.options.seeds.count, 3);
}

TEST_CASE("--definition cgal has 25 rays and all faces unless they are given, in any order") {
  const auto coneOf = [](const std::vector<std::string>& arguments) {
    return parseCommandLine(arguments).computation.options.cone;
  };
  for (const auto& arguments :
       {std::vector<std::string>{"a.ply", "--definition", "cgal", "--rays", "12", "--seeds", "10%", "--angle", "90"},
        {"a.ply", "--angle", "90", "--seeds", "10%", "--rays", "12", "--definition", "cgal"}}) {
    const CommandLine line = parseCommandLine(arguments);
    CHECK(line.computation.options.cone.definition == Definition::Cgal);
    CHECK_EQ(line.computation.options.cone.rayCount, 12);
    CHECK_EQ(line.computation.options.cone.openingAngleDegrees, 90);
    CHECK_EQ(line.computation.options.seeds.share, 0.1);
  }
  CHECK_EQ(parseCommandLine({"a.ply", "--definition", "cgal", "--max-error", "1%"}).computation.options.seeds.share,
           0.02);
  CHECK_EQ(parseCommandLine({"a.ply", "--recipe", "paper", "--definition", "cgal"}).computation.options.sampler,
           "random");
  CHECK_EQ(coneOf({"a.ply", "--definition", "paper"}).rayCount, 30);
  CHECK(parseCommandLine({"a.ply", "--definition", "paper"}).computation.options.seeds.kind ==
        SeedCount::Kind::Automatic);
}

TEST_CASE("errors and times are read with their unit or without") {
  CHECK_EQ(parseCommandLine({"a.ply", "--max-error", "0.0999"}).computation.options.rounds.maxError.value(), 0.0999);
  for (const char* text : {"1%", "0.01", "1.0%", "1e-2"})
    CHECK_EQ(parseCommandLine({"a.ply", "--max-error", text}).computation.options.rounds.maxError.value(),
             doctest::Approx(0.01));
  for (const char* text : {"1%rel", "0.01rel"}) {
    const RoundOptions rounds = parseCommandLine({"a.ply", "--max-error", text}).computation.options.rounds;
    CHECK_EQ(rounds.maxRelativeError.value(), doctest::Approx(0.01));
    CHECK_FALSE(rounds.maxError.has_value());
  }
  for (const char* text : {"2s", "2", "2.0s", "2e0"})
    CHECK_EQ(parseCommandLine({"a.ply", "--time-budget", text}).computation.options.rounds.timeBudgetSeconds.value(),
             2);
}

TEST_CASE("smoothing is off, by the number of faces, or by a given window") {
  const auto smoothing = [](const char* text) {
    return parseCommandLine({"a.ply", "--smooth", text}).computation.options.smoothing;
  };
  CHECK_FALSE(parseCommandLine({"a.ply"}).computation.options.smoothing.isOn);
  CHECK_FALSE(smoothing("off").isOn);
  CHECK(smoothing("auto").isOn);
  CHECK_FALSE(smoothing("auto").window.has_value());
  CHECK_EQ(smoothing("4x100").window.value().passes, 100);
  for (const char* text : {"on", "2", "0x1", "5x1", "1x0", "1x101", "x", "2x", "1x1x1", "-1x1", ""})
    CHECK_MESSAGE(refusal({"a.ply", "--smooth", text}).starts_with("--smooth: '"), text);
}

TEST_CASE("rounds begin with few seeds unless --seeds is given") {
  CHECK_EQ(parseCommandLine({"a.ply", "--max-error", "1%"}).computation.options.seeds.share, 0.02);
  CHECK_EQ(parseCommandLine({"a.ply", "--max-error", "5%rel"}).computation.options.seeds.share, 0.02);
  CHECK_EQ(parseCommandLine({"a.ply", "--time-budget", "1s"}).computation.options.seeds.share, 0.02);
  CHECK_EQ(parseCommandLine({"a.ply", "--seeds", "5%", "--max-error", "1%"}).computation.options.seeds.share, 0.05);
  CHECK_EQ(parseCommandLine({"a.ply", "--max-error", "1%", "--seeds", "10%"}).computation.options.seeds.share, 0.1);
  CHECK_EQ(parseCommandLine({"a.ply", "--max-error", "1%", "--seeds", "auto"}).computation.options.seeds.share, 0.02);
}

TEST_CASE("--help has tasks with examples, of options that exist; --help=all has all options in groups") {
  const std::string basic = parseCommandLine({"--help"}).answer.value();
  CHECK_LE(std::count(basic.begin(), basic.end(), '\n'), 45);
  std::istringstream lines(basic);
  for (std::string line; std::getline(lines, line);) CHECK_MESSAGE(line.size() <= 80, line);
  for (const char* part : {"--segment", "--thinner-than", "--fail-if-thinner", " -r ", "summarize", "-o horse.html",
                           "--help=all lists all options"})
    CHECK_MESSAGE(basic.find(part) != std::string::npos, part);
  const std::string all = parseCommandLine({"--help=all"}).answer.value();
  const std::set<std::string> known = optionsIn(all);
  const std::regex option("--[a-z-]+");
  for (std::sregex_iterator match(basic.begin(), basic.end(), option), end; match != end; ++match)
    CHECK_MESSAGE(known.contains(match->str()), match->str());
  size_t previous = 0;
  for (const char* group : {"Options:", "Seeds and rays:", "Output:", "Segments:", "Thickness:",
                            "Experiments (the defaults are best):", "Picture:", "Many meshes:", "Device:"}) {
    const size_t position = all.find("\n" + std::string(group) + "\n");
    CHECK_MESSAGE(position != std::string::npos, group);
    CHECK_MESSAGE(position > previous, group);
    previous = position;
  }
  for (const char* part : {"--recipe paper|balanced|quality",
                           "--sampler random|blue-noise|farthest-point|normal-space|adaptive",
                           "--max-error E%[rel]",
                           "--per face|vertex",
                           "--points FILE.ply|FILE.swc",
                           "--time-budget SECONDS",
                           "--no-estimate",
                           "--cone-rotation fixed|hashed",
                           "--definition paper|cgal",
                           "--weights distance|feature",
                           "--guidance none|curvature|prediction",
                           "--pooling P",
                           "--picture-of sdf|seed|error|normalized|segment",
                           "--segment none|parts|cgal",
                           "--kernel auto|seed|ray|packet",
                           "--fetch auto|texel|storage",
                           "MESH...",
                           ".stl .ply .off .obj",
                           "--fields NAME,...",
                           "default balanced"})
    CHECK_MESSAGE(all.find(part) != std::string::npos, part);
  CHECK_EQ(parseCommandLine({"--", "--help=all"}).meshes, std::vector<std::string>{"--help=all"});
}

TEST_CASE("the text of a seed count is the one it was read from, and reads as the same count") {
  const OptionRow& row = *findOption(computationRows(), "seeds");
  for (const char* text : {"all", "auto", "10%", "12.5%", "100%", "0.001%", "1", "12345678901", "7.0000000000001%"}) {
    ComputationSettings computation, again;
    setOptionText(row, &computation, text);
    const std::string written = toText(computation.options.seeds);
    if (std::string_view(text).size() < 12) CHECK_EQ(written, text);
    setOptionText(row, &again, written);
    CHECK_EQ(again.options.seeds.share, computation.options.seeds.share);
    CHECK_EQ(again.options.seeds.count, computation.options.seeds.count);
  }
}

}  // namespace
}  // namespace asdfvk
