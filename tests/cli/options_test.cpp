#include "cli/options.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <limits>

#include "cli/option_values.h"
#include "cli/scratch_folder.h"
#include "core/error.h"

namespace asdfvk {
namespace {

/// The message of the usage error, or "accepted".
std::string refusal(const std::vector<std::string>& arguments) {
  try {
    (void)parseCommandLine(arguments);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Usage);
    CHECK_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "accepted";
}

TEST_CASE("a mesh alone means the defaults") {
  const CommandLine line = parseCommandLine({"a.ply"});
  CHECK_EQ(line.meshes, std::vector<std::string>{"a.ply"});
  CHECK(line.options.seeds.kind == SeedCount::Kind::Share);
  CHECK_EQ(line.options.seeds.share, 0.1);
  CHECK_EQ(line.options.cone.rayCount, 30);
  CHECK_EQ(line.options.cone.openingAngleDegrees, 120);
  CHECK_EQ(line.options.guidance, 0);
  CHECK(line.options.orientation == Orientation::Keep);
  CHECK(line.options.solver == SolverChoice::Auto);
  CHECK(line.session.backend == Backend::Auto);
  CHECK_FALSE(line.options.checkCount.has_value());
  CHECK_FALSE(line.answer.has_value());
  CHECK(line.output.empty());
  CHECK_FALSE((line.json || line.quiet || line.ascii || line.listDevices || line.session.requireGpu));
}

TEST_CASE("every option reaches its field") {
  const CommandLine line = parseCommandLine({"a.ply",
                                             "--seeds",
                                             "25%",
                                             "--rng-seed",
                                             "18446744073709551615",
                                             "--rays",
                                             "64",
                                             "--angle",
                                             "90.5",
                                             "--false-hit-angle",
                                             "45",
                                             "--outlier-deviations",
                                             "1.5",
                                             "--solver",
                                             "jacobi",
                                             "--guidance",
                                             "-0.5",
                                             "--tolerance",
                                             "1e-3",
                                             "--orient",
                                             "flip",
                                             "-o",
                                             "b.ply",
                                             "--max-iterations",
                                             "77",
                                             "--ascii",
                                             "--format",
                                             "ply",
                                             "--backend",
                                             "vulkan",
                                             "--device",
                                             "llvmpipe",
                                             "--require-gpu",
                                             "--check=all",
                                             "--json",
                                             "--quiet",
                                             "--threads",
                                             "3"});
  CHECK_EQ(line.options.seeds.share, 0.25);
  CHECK_EQ(line.options.randomSeed, std::numeric_limits<uint64_t>::max());
  CHECK_EQ(line.options.cone.rayCount, 64);
  CHECK_EQ(line.options.cone.openingAngleDegrees, 90.5);
  CHECK_EQ(line.options.cone.falseHitAngleDegrees, 45);
  CHECK_EQ(line.options.cone.outlierDeviations, 1.5);
  CHECK(line.options.solver == SolverChoice::Jacobi);
  CHECK_EQ(line.options.guidance, -0.5);
  CHECK_EQ(line.options.solverOptions.tolerance, 1e-3);
  CHECK_EQ(line.options.solverOptions.maxIterations, 77);
  CHECK(line.options.orientation == Orientation::Flip);
  CHECK_EQ(line.output, "b.ply");
  CHECK_EQ(line.format, "ply");
  CHECK(line.session.backend == Backend::Vulkan);
  CHECK_EQ(line.session.device, "llvmpipe");
  CHECK_EQ(line.options.checkCount.value(), std::numeric_limits<uint64_t>::max());
  CHECK_EQ(line.threadCount, 3);
  CHECK((line.ascii && line.json && line.quiet && line.session.requireGpu));
}

TEST_CASE("--check without a number does not take the mesh after it for one") {
  for (const auto& arguments : {std::vector<std::string>{"--check", "a.ply"}, {"a.ply", "--check"}}) {
    const CommandLine line = parseCommandLine(arguments);
    CHECK_EQ(line.meshes, std::vector<std::string>{"a.ply"});
    CHECK_EQ(line.options.checkCount.value(), kDefaultCheckCount);
  }
  CHECK_EQ(parseCommandLine({"--check=5", "a.ply"}).options.checkCount.value(), 5);
  CHECK_EQ(parseCommandLine({"--", "--check"}).meshes, std::vector<std::string>{"--check"});
}

TEST_CASE("a number after --check that was meant for it is told, not taken for a mesh") {
  CHECK_EQ(refusal({"a.ply", "--check", "5"}), "--check takes its number with an equals sign: --check=5");
  CHECK_EQ(refusal({"--check", "all", "a.ply"}), "--check takes its number with an equals sign: --check=all");
  CHECK_EQ(refusal({"--check", "5.ply", "7"}), "accepted");
  const test::ScratchFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  folder.write("5", "");
  const std::string answer = refusal({"--check", "5"});
  std::filesystem::current_path(before);
  CHECK_EQ(answer, "accepted");
}

TEST_CASE("the last words on meshes: many, standard input, odd names") {
  CHECK_EQ(parseCommandLine({"a.ply", "--quiet", "-", "b c.off"}).meshes,
           std::vector<std::string>{"a.ply", "-", "b c.off"});
  CHECK_EQ(parseCommandLine({"--", "-x.ply"}).meshes, std::vector<std::string>{"-x.ply"});
  CHECK(refusal({"-", "-"}).find("once") != std::string::npos);
  CHECK(refusal({""}).find("empty") != std::string::npos);
  CHECK(refusal({"--quiet"}).find("no mesh") != std::string::npos);
  CHECK(parseCommandLine({"--list-devices"}).listDevices);
}

TEST_CASE("values out of range are refused with the option's name") {
  const std::vector<std::vector<std::string>> bad{{"--rays", "0"},
                                                  {"--rays", "1025"},
                                                  {"--rays", "ten"},
                                                  {"--rays", "3.5"},
                                                  {"--rays", "-3"},
                                                  {"--angle", "0"},
                                                  {"--angle", "180"},
                                                  {"--angle", "nan"},
                                                  {"--angle", "1e999"},
                                                  {"--false-hit-angle", "181"},
                                                  {"--outlier-deviations", "0"},
                                                  {"--tolerance", "0"},
                                                  {"--tolerance", "1"},
                                                  {"--max-iterations", "0"},
                                                  {"--guidance", "inf"},
                                                  {"--solver", "best"},
                                                  {"--orient", "inwards"},
                                                  {"--backend", "cuda"},
                                                  {"--format", "stl"},
                                                  {"--threads", "0"},
                                                  {"--rng-seed", "-1"},
                                                  {"--rng-seed", "0x10"},
                                                  {"--max-iterations", ""},
                                                  {"--threads", "1000000"},
                                                  {"--seeds", "nan%"},
                                                  {"--seeds", "1e3"}};
  for (const auto& arguments : bad) {
    const std::string message = refusal({"a.ply", arguments[0], arguments[1]});
    CHECK_MESSAGE(message.starts_with(arguments[0] + ": '" + arguments[1] + "' is not "), message);
  }
  CHECK(refusal({"a.ply", "--check=0"}).starts_with("--check: '0'"));
  CHECK(refusal({"a.ply", "--check=-1"}).starts_with("--check: "));
  CHECK(refusal({"a.ply", "-o", ""}).starts_with("--output: "));
}

TEST_CASE("unknown, doubled and bare options are refused") {
  CHECK(refusal({"a.ply", "--bogus"}).find("--bogus") != std::string::npos);
  CHECK(refusal({"a.ply", "--rays", "3", "--rays", "4"}).find("--rays") != std::string::npos);
  CHECK(refusal({"a.ply", "--rays"}).find("--rays") != std::string::npos);
}

TEST_CASE("options that contradict each other are refused") {
  CHECK(refusal({"a.ply", "-o", "-", "--json"}) != "accepted");
  for (const char* backend : {"cpu", "reference"}) {
    CHECK(refusal({"a.ply", "--backend", backend, "--require-gpu"}).find("--require-gpu") != std::string::npos);
    CHECK(refusal({"a.ply", "--backend", backend, "--device", "0"}).find("--device") != std::string::npos);
    for (const char* solver : {"cg", "jacobi"})
      CHECK(refusal({"a.ply", "--backend", backend, "--solver", solver}).find("--solver") != std::string::npos);
    CHECK_EQ(refusal({"a.ply", "--backend", backend, "--solver", "eigen"}), "accepted");
  }
}

TEST_CASE("seed counts are read as they are told") {
  for (const char* text : {"all", "10%", "12.5%", "100%", "0.001%", "1", "12345678901"})
    CHECK_EQ(toText(parseSeedCount(text)), text);
}

}  // namespace
}  // namespace asdfvk
