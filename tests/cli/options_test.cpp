// Every option reaches its field, the hash, a worker and the help.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include "batch/message_channel.h"
#include "cli/command_line.h"
#include "cli/one_mesh.h"

namespace asdfvk {
namespace {

std::string hashOfOptions(const CommandLine& line) {
  return optionsHash(line.computation, line.session, line.reading, line.outputs);
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
       [](const Line& l) { return l.computation.options.sampler == SamplerChoice::FarthestPoint; }},
      {{"--max-error", "1.5%"}, [](const Line& l) { return l.computation.options.rounds.maxError == 0.015; }},
      {{"--max-error", "5%rel"},
       [](const Line& l) {
         return l.computation.options.rounds.maxRelativeError == 0.05 &&
                !l.computation.options.rounds.maxError.has_value();
       }},
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
      {{"--thicker-than", "2"}, [](const Line& l) { return l.computation.options.thickness.thickerThan == 2.0; }},
      {{"--fail-if-thicker", "2"}, [](const Line& l) { return l.computation.failIfThicker == 2.0; }},
      {{"--closer-than", "0.5"}, [](const Line& l) { return l.computation.options.thickness.closerThan == 0.5; }},
      {{"--fail-if-closer", "0.5"}, [](const Line& l) { return l.computation.failIfCloser == 0.5; }},
      {{"--with", "b.stl", "--with", "c.stl"},
       [](const Line& l) {
         return l.others.with == std::vector<std::string>{"b.stl", "c.stl"};
       }},
      {{"--compare", "b.stl"}, [](const Line& l) { return l.others.former == "b.stl" && l.computation.compares; }},
      {{"--fail-if-voids"}, [](const Line& l) { return l.computation.failsIfVoids; }},
      {{"--fail-if-contact"}, [](const Line& l) { return l.computation.failsIfContact; }},
      {{"--count-details", "--thinner-than", "0.5"},
       [](const Line& l) { return l.computation.options.thickness.countsDetails; }},
      {{"--count-edges", "--thinner-than", "0.5"},
       [](const Line& l) { return l.computation.options.thickness.countsEdges; }},
      {{"--next-wall", "--measure", "thickness"},
       [](const Line& l) { return l.computation.options.thickness.findsNextWall; }},
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
      {{"--tar"}, [](const Line& l) { return l.batch.readsTars; }},
      {{"--keep-members", "--tar"}, [](const Line& l) { return l.batch.keepsMembers; }},
      {{"--shard", "2/7"}, [](const Line& l) { return l.batch.shard && l.batch.shard->index == 2; }},
      {{"--log", "log"}, [](const Line& l) { return l.batch.log == "log"; }},
      {{"--skip-existing"}, [](const Line& l) { return l.batch.skipsExisting; }},
      {{"--timeout", "2.5s"}, [](const Line& l) { return l.batch.timeoutSeconds == 2.5; }},
      {{"--chord-error", "0.02mm"},
       [](const Line& l) {
         return l.reading.chordError == 0.02 && l.reading.chordErrorUnit == LengthUnit::Millimetre;
       }},
      {{"--memory-limit", "2M"}, [](const Line& l) { return l.batch.memoryBytes == 2u << 20; }},
      {{"--isolate"}, [](const Line& l) { return l.batch.isolates; }},
      {{"--max-faces", "1000"}, [](const Line& l) { return l.reading.maxFaces == 1000; }},
      {{"--jobs", "3"}, [](const Line& l) { return l.batch.jobCount == 3; }},
      {{"--open"}, [](const Line& l) { return l.outputs.opensPage; }},
      {{"--solver", "jacobi"}, [](const Line& l) { return l.computation.options.solver == SolverChoice::Jacobi; }},
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
      {{"--limits", "b.json"}, [](const Line& l) { return l.outputs.limits == "b.json" && !l.outputs.writesResult; }},
      {{"--baseline", "b.json"}, [](const Line& l) { return l.outputs.baseline == "b.json"; }},
      {{"--update-baseline", "--baseline", "b.json"}, [](const Line& l) { return l.outputs.updatesBaseline; }},
      {{"--report-format", "junit"},
       [](const Line& l) { return l.outputs.reportFormat == "junit" && l.outputs.report == "-"; }},
      {{"--report", "b.xml", "--report-format", "junit"}, [](const Line& l) { return l.outputs.report == "b.xml"; }},
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
      {{"--backend", "reference"}, [](const Line& l) { return l.session.backend == BackendChoice::Reference; }},
      {{"--device", "llvmpipe"}, [](const Line& l) { return l.session.device == "llvmpipe"; }},
      {{"--require-gpu"}, [](const Line& l) { return l.session.requireGpu; }},
      {{"--threads", "3"}, [](const Line& l) { return l.session.threadCount == 3; }},
      {{"--kernel", "packet"}, [](const Line& l) { return l.session.variant.kernel == TraceKernel::Packet; }},
      {{"--fetch", "storage"}, [](const Line& l) { return l.session.variant.fetch == BvhFetch::Storage; }},
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
  std::set<std::string> inTable{"--help", "--version", "--list-devices", "--device-report", "--print-schema"};
  for (const OptionCase& option : optionCases()) {
    const std::string& name = option.arguments.front();
    if (name != "-o") inTable.insert(name.substr(0, name.find('=')));
  }
  CHECK(optionsIn(parseCommandLine({"--help=all"}).answer.value()) == inTable);
}

TEST_CASE("every option changes the hash that --skip-existing compares, except those that do not change an output") {
  const std::set<std::string> exceptions{"--report-format",
                                         "--limits",
                                         "--baseline",
                                         "--update-baseline",
                                         "--report",
                                         "--json",
                                         "--quiet",
                                         "--verbose",
                                         "--open",  // Not in the output.
                                         "-o",
                                         "--output",
                                         "--points",
                                         "--picture",  // Other outputs.
                                         "--log",
                                         "--shard",
                                         "--null",
                                         "--tar",
                                         "--keep-members",
                                         "--recursive",
                                         "--files-from",
                                         "--skip-existing",
                                         "--jobs",
                                         "--threads",
                                         "--isolate",
                                         "--timeout",
                                         "--memory-limit",
                                         "--max-faces",
                                         "--with",  // For one mesh only.
                                         "--compare"};
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
      // --points implies a field, --open a format, --compare a measure; a batch refuses them.
      if (name != "--limits" && name != "--points" && name != "--open" && name != "--compare")
        CHECK_EQ(hashOf(option.arguments), hashOf({}));
    } else {
      CHECK_MESSAGE(hashes.insert(hashOf(option.arguments)).second, "the hash of other options");
    }
  }
}

TEST_CASE("a worker gets all settings") {
  const auto settingsFor = [](std::vector<std::string> arguments) {
    arguments.emplace_back("caf\xe9.ply");
    const CommandLine line = parseCommandLine(arguments);
    return MeshSettings{.session = line.session,
                        .computation = line.computation,
                        .reading = line.reading,
                        .outputs = line.outputs,
                        .timeoutSeconds = line.batch.timeoutSeconds,
                        .makesFolders = true};
  };
  std::vector<std::vector<std::string>> calls{{"-o", "caf\xe9"}};
  for (const OptionCase& option : optionCases()) calls.push_back(option.arguments);
  for (const std::vector<std::string>& arguments : calls) {
    INFO(arguments.front());
    const MeshSettings sent = settingsFor(arguments);
    const MeshSettings received = settingsOf(decode(encode(toJson(sent))));
    CHECK_EQ(toJson(received), toJson(sent));
    CHECK_EQ(optionsHash(received.computation, received.session, received.reading, received.outputs),
             optionsHash(sent.computation, sent.session, sent.reading, sent.outputs));
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

TEST_CASE("--help has tasks with examples, of options that exist; --help=all has all options in groups") {
  const std::string basic = parseCommandLine({"--help"}).answer.value();
  CHECK_LE(std::count(basic.begin(), basic.end(), '\n'), 45);
  std::istringstream lines(basic);
  for (std::string line; std::getline(lines, line);) CHECK_MESSAGE(line.size() <= 80, line);
  for (const char* part : {"--segment", "--thinner-than", "--fail-if-thinner", " -r ", "summarize", "-o horse.html",
                           "default 10%, at least 3,000", "--help=all lists all options"})
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
  for (const char* part :
       {"--recipe paper|balanced|quality", "--sampler random|blue-noise|farthest-point|normal-space|adaptive",
        "--max-error E%[rel]", "--per face|vertex", "--points FILE.ply|FILE.swc", "--no-estimate",
        "--cone-rotation fixed|hashed", "--definition paper|cgal", "--weights distance|feature",
        "--guidance none|curvature|prediction", "--pooling P", "--picture-of sdf|seed|error|normalized|segment",
        "--segment none|parts|cgal", "--kernel auto|seed|ray|packet", "--fetch auto|texel|storage", "MESH...",
        ".stl .ply .off .obj", "--fields NAME,...", "default balanced"})
    CHECK_MESSAGE(all.find(part) != std::string::npos, part);
  CHECK_EQ(parseCommandLine({"--", "--help=all"}).meshes, std::vector<std::string>{"--help=all"});
}

TEST_CASE("the chord error of a check is a fiftieth of the limit") {
  const ReadOptions reading = parseCommandLine({"a.step", "--thinner-than", "0.8mm"}).reading;
  CHECK(reading.chordError == doctest::Approx(0.016));
  CHECK(reading.chordErrorUnit == LengthUnit::Millimetre);
  CHECK(parseCommandLine({"a.step", "--fail-if-thinner", "1", "--chord-error", "3"}).reading.chordError == 3);
  CHECK(parseCommandLine({"a.step"}).reading.chordError == 0);
}

}  // namespace
}  // namespace asdfvk
