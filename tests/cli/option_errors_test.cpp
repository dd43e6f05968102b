#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "cli/refusal.h"
#include "cli/scratch_folder.h"

namespace asdfvk {
namespace {

TEST_CASE("a number after --check and a space is an error, not a mesh") {
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

TEST_CASE("values out of range are refused with the option's name") {
  const std::vector<std::pair<std::string, std::vector<std::string>>> rejected{
      {"--rays", {"0", "1025", "ten", "3.5", "-3"}},
      {"--angle", {"0", "180", "nan", "1e999"}},
      {"--false-hit-angle", {"181"}},
      {"--outlier-deviations", {"0"}},
      {"--tolerance", {"0", "1"}},
      {"--max-iterations", {"0", ""}},
      {"--recipe", {"best", "Paper"}},
      {"--definition", {"shapira", ""}},
      {"--sampler", {"blue"}},
      {"--max-error", {"0%", "-1%", "100%", "1", "0%rel", "100%rel", "1rel"}},
      {"--cone-rotation", {"random"}},
      {"--weights", {"1"}},
      {"--guidance", {"0.5", "gauss"}},
      {"--fields", {"depth"}},
      {"--picture-of", {"curvature"}},
      {"--per", {"edge", "vertices", ""}},
      {"--kernel", {"wide"}},
      {"--pooling", {"-0.1", "1.1", "half"}},
      {"--solver", {"best"}},
      {"--orient", {"inwards"}},
      {"--backend", {"cuda"}},
      {"--format", {"stl"}},
      {"--postprocess", {"shapira", ""}},
      {"--segment", {"kmeans", "CGAL", "Parts"}},
      {"--parts", {"0", "101", "-1", "2.5", "many", "10%"}},
      {"--detail", {"0", "0.09", "10.1", "-1", "nan", "inf", "fine"}},
      {"--clusters", {"1", "101", "-2", "2.5", "five"}},
      {"--smoothness", {"-0.1", "1000.5", "nan", "inf", "much"}},
      {"--cgal-expansion", {"last"}},
      {"--threads", {"-1", "1000000"}},
      {"--rng-seed", {"-1", "0x10"}},
      {"--seeds", {"nan%", "1e3"}},
  };
  for (const auto& [option, values] : rejected)
    for (const std::string& value : values) {
      const std::string message = refusal({"a.ply", option, value});
      CHECK_MESSAGE(message.starts_with(option + ": '" + value + "' is not "), message);
    }
  for (const char* text : {"soon", "fiverel", "rel", "5%x", "150%", "150%rel"})
    CHECK_EQ(
        refusal({"a.ply", "--max-error", text}),
        fmt::format("--max-error: '{}' is not an error above 0% and below 100%, such as 1% (of the range) or 5%rel "
                    "(of the value)",
                    text));
  CHECK_EQ(refusal({"a.ply", "--timeout", "0s"}), "--timeout: '0s' is not a number above 0 and at most 1000000000");
  CHECK_EQ(refusal({"a.ply", "--recipe", "best"}), "--recipe: 'best' is not one of paper|balanced|quality");
  CHECK_EQ(refusal({"a.ply", "--sampler", "spiral"}),
           "--sampler: 'spiral' is not one of random|blue-noise|farthest-point|normal-space|adaptive");
  CHECK_EQ(refusal({"a.ply", "--guidance", "2"}), "--guidance: '2' is not one of none|curvature|prediction");
  for (const char* text : {"", "%", "1%%", "nan%", "1 %", "inf", "rel", "%rel", "5% rel", "5%relrel"})
    CHECK_MESSAGE(refusal({"a.ply", "--max-error", text}).starts_with("--max-error: "), text);
  for (const char* text : {"", "s", "2 s", "2ms", "inf", "nans", "2ss"})
    CHECK_MESSAGE(refusal({"a.ply", "--timeout", text}).starts_with("--timeout: "), text);
  CHECK(refusal({"a.ply", "--check=0"}).starts_with("--check: '0'"));
  CHECK(refusal({"a.ply", "--check=-1"}).starts_with("--check: "));
  CHECK(refusal({"a.ply", "-o", ""}).starts_with("--output: "));
}

TEST_CASE("unknown, doubled and bare options are refused") {
  CHECK_EQ(refusal({"a.ply", "--bogus"}), "--bogus is unknown; asdf-vk --help lists the options");
  CHECK_EQ(refusal({"a.ply", "--seed", "5"}), "--seed is unknown; did you mean --seeds or --rng-seed?");
  CHECK_EQ(refusal({"a.ply", "--segment", "5"}),
           "--segment: '5' is not one of none|parts|cgal; --parts sets the number of parts");
  CHECK(refusal({"a.ply", "--rays", "3", "--rays", "4"}).find("--rays") != std::string::npos);
  CHECK(refusal({"a.ply", "--rays"}).find("--rays") != std::string::npos);
  CHECK_EQ(refusal({"--help=some"}), "--help: 'some' is not 'all'; write --help or --help=all");
  CHECK_EQ(refusal({"a.ply", "--help="}), "--help= has no value");
}

TEST_CASE("options that contradict each other are refused") {
  CHECK(refusal({"a.ply", "-o", "-", "--json"}) != "accepted");
  for (const char* backend : {"cpu", "reference"}) {
    CHECK(refusal({"a.ply", "--backend", backend, "--require-gpu"}).find("--require-gpu") != std::string::npos);
    CHECK(refusal({"a.ply", "--backend", backend, "--device", "0"}).find("--device") != std::string::npos);
    for (const auto& [option, value] : {std::pair{"--kernel", "seed"}, {"--fetch", "texel"}}) {
      CHECK(refusal({"a.ply", "--backend", backend, option, value}).find(option) != std::string::npos);
      CHECK_EQ(refusal({"a.ply", "--backend", backend, option, "auto"}), "accepted");
    }
    for (const char* solver : {"cg", "jacobi"})
      CHECK(refusal({"a.ply", "--backend", backend, "--solver", solver}).find("--solver") != std::string::npos);
    for (const char* solver : {"auto", "cpu", "eigen"})
      CHECK_EQ(refusal({"a.ply", "--backend", backend, "--solver", solver}), "accepted");
  }
}

TEST_CASE("skeleton points go to one .ply file, and a picture shows none of their components") {
  CHECK_EQ(refusal({"a.ply", "--points", "b.obj"}), "--points: 'b.obj' is not a file that ends in .ply or .swc");
  CHECK_EQ(refusal({"a.ply", "--points", ""}), "--points: '' is not a file that ends in .ply or .swc");
  CHECK_EQ(refusal({"a.ply", "b.ply", "--points", "c.ply"}),
           "--points takes one mesh; name one mesh, or run asdf-vk once per mesh");
  for (const auto& other : {std::vector<std::string>{"--json"}, {"-o", "-"}, {"--picture", "-"}}) {
    std::vector<std::string> arguments{"a.ply", "--points", "-"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    CHECK(refusal(arguments).starts_with("--points -, --json, -o - and --picture - write to standard output"));
  }
  CHECK_EQ(refusal({"a.ply", "--picture", "b.png", "--picture-of", "centre"}),
           "--picture-of: 'centre' has three components; a picture shows a field of one component");
}

TEST_CASE("options of the segmentation need it, as do its fields") {
  for (const auto& [option, value] :
       {std::pair{"--clusters", "3"}, {"--smoothness", "1"}, {"--cgal-expansion", "all"}}) {
    const std::string message = std::string(option) + " needs --segment cgal";
    CHECK_EQ(refusal({"a.ply", option, value}), message);
    CHECK_EQ(refusal({"a.ply", option, value, "--segment", "none"}), message);
    CHECK_EQ(refusal({"a.ply", option, value, "--postprocess", "cgal"}), message);
    CHECK_EQ(refusal({"a.ply", option, value, "--segment", "cgal"}), "accepted");
  }
  CHECK_EQ(refusal({"a.ply", "--segment", "cgal", "--postprocess", "none"}),
           "--segment cgal contradicts --postprocess none; drop one of the two");
  CHECK_EQ(refusal({"a.ply", "--segment", "cgal", "--postprocess", "cgal"}), "accepted");
  CHECK_EQ(refusal({"a.ply", "--fields", "normalized"}), "--fields normalized needs --postprocess cgal");
  CHECK_EQ(refusal({"a.ply", "--fields", "segment", "--postprocess", "cgal"}), "--fields segment needs --segment");
  CHECK_EQ(refusal({"a.ply", "--fields", "normalized", "--segment", "cgal"}), "accepted");
  CHECK_EQ(refusal({"a.ply", "--picture", "b.png", "--picture-of", "segment"}), "--picture-of segment needs --segment");
  CHECK_EQ(refusal({"a.ply", "--picture", "b.png", "--picture-of", "segment", "--segment", "cgal"}), "accepted");
}

TEST_CASE("options of the parts need them, and contradict each other and CGAL's") {
  for (const auto& [option, value] : {std::pair{"--parts", "3"}, {"--detail", "2"}}) {
    const std::string message = std::string(option) + " needs --segment parts";
    CHECK_EQ(refusal({"a.ply", option, value}), message);
    CHECK_EQ(refusal({"a.ply", option, value, "--segment", "none"}), message);
    CHECK_EQ(refusal({"a.ply", option, value, "--segment", "cgal"}), message);
    CHECK_EQ(refusal({"a.ply", option, value, "--segment", "parts"}), "accepted");
    CHECK_EQ(refusal({"a.ply", option, value, "--segment"}), "accepted");
  }
  for (const auto& [option, value] : {std::pair{"--clusters", "3"}, {"--smoothness", "1"}, {"--cgal-expansion", "all"}})
    CHECK_EQ(refusal({"a.ply", option, value, "--segment", "parts"}), std::string(option) + " needs --segment cgal");
  CHECK_EQ(refusal({"a.ply", "--segment", "--parts", "3", "--detail", "2"}),
           "--parts and --detail contradict each other; drop one");
  CHECK_EQ(refusal({"a.ply", "--segment", "--postprocess", "none"}), "accepted");
  CHECK_EQ(refusal({"a.ply", "--segment", "--fields", "normalized"}), "--fields normalized needs --postprocess cgal");
  CHECK_EQ(refusal({"a.ply", "--segment", "--picture", "b.png", "--picture-of", "segment"}), "accepted");
  CHECK(refusal({"a.ply", "--segment", "twelve"}).starts_with("--segment: 'twelve' is not one of none|parts|cgal; "));
  CHECK_EQ(refusal({"a.ply", "--segment", "--segment"}), "--segment takes exactly one value, once");
}

TEST_CASE("options of the paper's definition are refused with another one") {
  for (const auto& [option, value] :
       {std::pair{"--false-hit-angle", "90"}, {"--outlier-deviations", "1"}, {"--cone-rotation", "fixed"}}) {
    CHECK_EQ(refusal({"a.ply", "--definition", "paper", option, value}), "accepted");
    for (const auto& arguments : {std::vector<std::string>{"a.ply", "--definition", "cgal", option, value},
                                  {"a.ply", option, value, "--definition", "cgal"}})
      CHECK_EQ(refusal(arguments), std::string(option) + " needs --definition paper");
  }
  CHECK(refusal({"a.ply", "--definition", "cgal", "--recipe", "quality"}).starts_with("--recipe quality rotates"));
  CHECK_EQ(refusal({"a.ply", "--definition", "cgal", "--recipe", "paper"}), "accepted");
  CHECK_EQ(refusal({"a.ply", "--definition", "CGAL"}), "--definition: 'CGAL' is not one of paper|cgal");
}

TEST_CASE("a picture or field of the error needs an estimate") {
  for (const auto& ofError : {std::vector<std::string>{"a.ply", "--picture", "b.png", "--picture-of", "error"},
                              {"a.ply", "--fields", "sdf,error"}}) {
    const auto with = [&](const std::vector<std::string>& further) {
      std::vector<std::string> arguments = ofError;
      arguments.insert(arguments.end(), further.begin(), further.end());
      return refusal(arguments);
    };
    CHECK_EQ(with({}), "accepted");
    CHECK(with({"--no-estimate"}).find("--no-estimate") != std::string::npos);
    CHECK(with({"--seeds", "all"}).find("--seeds all") != std::string::npos);
  }
}

TEST_CASE("options that would have no effect are refused") {
  const std::string withListing = "--list-devices is about devices only: ",
                    withReport = "--device-report is about devices only: ";
  const std::string end = " has no effect; drop one of the two";
  CHECK_EQ(refusal({"--list-devices", "a.ply"}), withListing + "a mesh" + end);
  CHECK_EQ(refusal({"--list-devices", "-o", "b.ply"}), withListing + "--output" + end);
  CHECK_EQ(refusal({"--list-devices", "--picture", "b.png"}), withListing + "--picture" + end);
  CHECK_EQ(refusal({"--list-devices", "--device-report"}), withListing + "--device-report" + end);
  CHECK_EQ(refusal({"--list-devices", "--device", "0"}), withListing + "--device" + end);
  CHECK_EQ(refusal({"--list-devices", "--files-from", "list"}), withListing + "--files-from" + end);
  CHECK_EQ(refusal({"--list-devices", "--require-gpu", "--json", "--quiet", "--threads", "1"}), "accepted");
  CHECK_EQ(refusal({"--device-report", "a.ply"}), withReport + "a mesh" + end);
  CHECK_EQ(refusal({"--device-report", "--kernel", "ray"}), withReport + "--kernel" + end);
  CHECK_EQ(refusal({"--device-report", "--backend", "vulkan", "--device", "0", "--require-gpu"}), "accepted");

  CHECK_EQ(refusal({"a.ply", "--no-estimate", "--max-error", "1%"}),
           "--max-error needs the error estimate, which --no-estimate excludes; drop one of the two");
  for (const auto& [option, value] : {std::pair{"--max-error", "1%"}, {"--max-error", "5%rel"}}) {
    CHECK_EQ(refusal({"a.ply", option, value, "--seeds", "all"}),
             fmt::format("{} adds seeds, but with --seeds all every face is a seed; drop one of the two", option));
    CHECK_EQ(refusal({"a.ply", option, value, "--seeds", "20%"}), "accepted");
    CHECK_EQ(refusal({"a.ply", option, value, "--definition", "cgal"}), "accepted");
  }
}

TEST_CASE("pooling without a prediction is refused") {
  const std::string message =
      "--pooling needs a prediction, which --recipe paper and --guidance none or curvature exclude; drop one of them";
  CHECK_EQ(refusal({"a.ply", "b.ply", "--pooling", "0.5", "--recipe", "paper"}), message);
  CHECK_EQ(refusal({"a.ply", "--recipe", "quality", "--guidance", "none"}), message);
  CHECK_EQ(refusal({"a.ply", "--recipe", "paper", "--pooling", "0"}), "accepted");
  CHECK_EQ(refusal({"a.ply", "--recipe", "paper", "--pooling", "0.5", "--guidance", "prediction"}), "accepted");
}

}  // namespace
}  // namespace asdfvk
