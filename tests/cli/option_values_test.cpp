// Values and combinations of options.
#include <doctest/doctest.h>

#include <filesystem>
#include <set>

#include "cli/command_line.h"
#include "cli/refusal.h"
#include "cli/scratch_folder.h"
#include "describe/option_values.h"

namespace asdfvk {
namespace {

/// The fields that are written.
std::vector<std::string> fieldsIn(const CommandLine& line) {
  return fieldNames(line.outputs, line.computation.options);
}

TEST_CASE("a mesh alone gives the defaults") {
  const CommandLine line = parseCommandLine({"a.ply"});
  CHECK_EQ(line.meshes, std::vector<std::string>{"a.ply"});
  CHECK(line.computation.options.seeds.kind == SeedCount::Kind::Automatic);
  CHECK_EQ(line.computation.options.cone.rayCount, 30);
  CHECK_EQ(line.computation.options.cone.openingAngleDegrees, 120);
  CHECK(line.computation.recipe == Recipe::Balanced);
  CHECK(line.computation.options.sampler == SamplerChoice::BlueNoise);
  CHECK(line.computation.options.interpolation.weights == ArcWeights::Feature);
  CHECK(line.computation.options.interpolation.guidance == Guidance::Prediction);
  CHECK_EQ(line.computation.options.interpolation.pooling, 0);
  CHECK(line.computation.options.cone.rotation == ConeRotation::Fixed);
  CHECK(line.computation.options.estimatesError);
  CHECK_FALSE(line.computation.options.rounds.areSet());
  CHECK(line.computation.options.orientation == Orientation::Keep);
  CHECK(line.computation.options.solver == SolverChoice::Automatic);
  CHECK(line.session.backend == BackendChoice::Automatic);
  const TraceVariant& variant = line.session.variant;
  CHECK_FALSE((variant.kernel || variant.fetch));
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
  CHECK_EQ(parseCommandLine({"a.ply", "--picture", "b/"}).outputs.picture, "b/");
  CHECK(refusal({"a.ply", "--picture-of", "seeds"}).find("--picture") != std::string::npos);
  CHECK(refusal({"a.ply", "b.ply", "--picture", "c.png"}).find("one mesh") != std::string::npos);
  CHECK(refusal({"a.ply", "-o", "-", "--picture", "-"}).find("standard output") != std::string::npos);
}

TEST_CASE("each option in braces in the texts of the rows exists") {
  CommandLine line;
  const std::vector<OptionRows> tables = optionTables(line);
  std::set<std::string> names;
  for (const OptionRows& rows : tables)
    for (const OptionRow& row : rows) names.insert(row.name);
  size_t count = 0;
  for (const OptionRows& rows : tables)
    for (const OptionRow& row : rows)
      for (const std::string text : {row.text, row.more, row.defaultText == nullptr ? "" : row.defaultText,
                                     row.wanted == nullptr ? "" : row.wanted})
        for (size_t at = text.find('{'); at != text.npos; at = text.find('{', at + 1)) {
          const std::string name = text.substr(at + 1, text.find_first_of("=}", at) - at - 1);
          CHECK_MESSAGE(names.contains(name), row.name << ": " << name);
          ++count;
        }
  CHECK(count >= 30);
}

TEST_CASE("a kernel variant of auto is the default") {
  const TraceVariant variant = parseCommandLine({"a.ply", "--kernel", "auto", "--fetch", "auto"}).session.variant;
  CHECK_FALSE((variant.kernel || variant.fetch));
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
  for (const auto& sampler : kSamplerNames) CHECK(optionsWith("--sampler", sampler.first).sampler == sampler.second);
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
    CHECK(line.computation.options.sampler == SamplerChoice::Random);
  }
  const CommandLine line = parseCommandLine({"a.ply", "--sampler", "adaptive", "--pooling", "0", "--cone-rotation",
                                             "fixed", "--guidance", "none", "--recipe", "quality"});
  CHECK(line.computation.options.sampler == SamplerChoice::Adaptive);
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
  CHECK(parseCommandLine({"a.ply", "--recipe", "paper", "--definition", "cgal"}).computation.options.sampler ==
        SamplerChoice::Random);
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
  CHECK_EQ(parseCommandLine({"a.ply", "--seeds", "5%", "--max-error", "1%"}).computation.options.seeds.share, 0.05);
  CHECK_EQ(parseCommandLine({"a.ply", "--max-error", "1%", "--seeds", "10%"}).computation.options.seeds.share, 0.1);
  CHECK_EQ(parseCommandLine({"a.ply", "--max-error", "1%", "--seeds", "auto"}).computation.options.seeds.share, 0.02);
}

TEST_CASE("the text of a seed count is the one it was read from, and reads as the same count") {
  for (const char* text : {"all", "auto", "10%", "12.5%", "100%", "0.001%", "1", "12345678901", "7.0000000000001%"}) {
    ComputationSettings computation, again;
    setOptionText(*findOption(computationRows(computation), "seeds"), text);
    const std::string written = toText(SeedCountCodec::write(computation.options.seeds));
    if (std::string_view(text).size() < 12) CHECK_EQ(written, text);
    setOptionText(*findOption(computationRows(again), "seeds"), written);
    CHECK_EQ(again.options.seeds.share, computation.options.seeds.share);
    CHECK_EQ(again.options.seeds.count, computation.options.seeds.count);
  }
}

}  // namespace
}  // namespace asdfvk
