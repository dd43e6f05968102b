#include <doctest/doctest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "cli/outputs.h"
#include "cli/page_output.h"
#include "cli/program_under_test.h"
#include "cli/refusal.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

const std::vector<std::string> kQuick{"--quiet", "--backend", "reference"};

ChildOutcome runQuick(std::vector<std::string> arguments, const ChildOptions& options = {}) {
  arguments.insert(arguments.end(), kQuick.begin(), kQuick.end());
  return runAsdf(arguments, options);
}

nlohmann::json dataOf(const std::string& html) {
  const std::string tag = "<script type=\"application/json\" id=\"asdf-vk-page\">";
  const size_t begin = html.find(tag);
  REQUIRE(begin != std::string::npos);
  return nlohmann::json::parse(html.substr(begin + tag.size(), html.find("</script>", begin) - begin - tag.size()));
}

std::vector<std::string> fieldsOf(const nlohmann::json& mesh) {
  std::vector<std::string> names;
  for (const auto& field : mesh.at("fields")) names.push_back(field.at("name"));
  return names;
}

TEST_CASE("a page has all fields of one component, the summary and the fallback picture") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  const ChildOutcome outcome = runQuick({mesh, "-o", folder / "sphere.html", "--seeds", "10%", "--segment", "--json"});
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  CHECK_EQ(report.at("output"), folder / "sphere.html");
  const std::string html = folder.read("sphere.html");
  const auto page = dataOf(html);
  REQUIRE_EQ(page.at("meshes").size(), 1);
  const auto& data = page.at("meshes")[0];
  CHECK_EQ(data.at("name"), "sphere.off");
  CHECK_EQ(data.at("label"), "sphere.off, balanced, seeds 10 %");
  CHECK_EQ(data.at("faceCount"), 528);
  CHECK(fieldsOf(data) == std::vector<std::string>{"segment", "sdf", "seed", "error", "boundary_stability"});
  CHECK_EQ(data.at("summary")[0].at("title"), "Mesh");
  CHECK(data.at("summary")[0].at("value").get<std::string>().starts_with("528 faces, 266 vertices"));
  CHECK(data.at("errorSentence").get<std::string>().find("held out") != std::string::npos);
  REQUIRE_EQ(data.at("segments").size(), 1);
  CHECK_EQ(data.at("segments")[0].at("faceCount"), 528);
  CHECK(html.find("<img alt=\"sphere.off, balanced, seeds 10 %\" src=\"data:image/png;base64,iVBOR") !=
        std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"sphere.html", "sphere.off"});
}

TEST_CASE("a page has the fields of --fields in their order, thin regions, warnings and defects") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome = runQuick(
      {mesh, "-o", folder / "cube.html", "--thinner-than", "2", "--seeds", "all", "--fields", "seed,thickness"});
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  const auto data = dataOf(folder.read("cube.html")).at("meshes")[0];
  CHECK(fieldsOf(data) == std::vector<std::string>{"seed", "thickness"});
  const auto& thin = data.at("thin");
  CHECK_EQ(thin.at("limit"), 2);
  CHECK_EQ(thin.at("verdict"), "failed");
  REQUIRE_EQ(thin.at("regions").size(), 1);
  CHECK_EQ(thin.at("regions")[0].at("faceCount"), 12);
  CHECK_EQ(thin.at("regions")[0].at("value").get<double>(), doctest::Approx(1));
  CHECK_EQ(thin.at("surface").at("faceCount"), 12);
  CHECK(data.at("errorSentence").get<std::string>().starts_with("Every face cast rays"));

  const std::string open = folder.write("open.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 1\n3 0 1 2\n3 1 1 3\n");
  REQUIRE_EQ(runQuick({open, "-o", folder / "open.html"}).exitCode, 0);
  const auto broken = dataOf(folder.read("open.html")).at("meshes")[0];
  CHECK_FALSE(broken.at("defects").empty());
  CHECK_FALSE(broken.at("warnings").empty());
}

TEST_CASE("a page without a limit has no thin places, and an STL stands with z up") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("a.stl",
                                        "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 "
                                        "1 0\nendloop\nendfacet\nendsolid a\n");
  REQUIRE_EQ(runQuick({mesh, "-o", folder / "a.html"}).exitCode, 0);
  const auto data = dataOf(folder.read("a.html")).at("meshes")[0];
  CHECK_FALSE(data.contains("thin"));
  CHECK_EQ(data.at("up"), "z");
  CHECK(data.at("view") == nlohmann::json{30, 18});
}

TEST_CASE("several meshes are in one page, or in one each") {
  const ScratchFolder folder;
  const std::string sphere = folder.write("a.off", sphereOff(6)), cube = folder.write("b.off", cubeOff());
  REQUIRE_EQ(runQuick({sphere, cube, "-o", folder / "both.html"}).exitCode, 0);
  const auto both = dataOf(folder.read("both.html"));
  REQUIRE_EQ(both.at("meshes").size(), 2);
  CHECK_EQ(both.at("meshes")[1].at("name"), "b.off");
  // A mesh that fails is not in the page.
  const ChildOutcome outcome = runQuick({cube, folder / "missing.off", "-o", folder / "one.html"});
  CHECK_EQ(outcome.exitCode, 7);
  CHECK_EQ(dataOf(folder.read("one.html")).at("meshes").size(), 1);
  CHECK_EQ(runQuick({folder / "missing.off", "-o", folder / "none.html"}).exitCode, 2);
  CHECK_EQ(runQuick({folder / "missing.off", folder / "too.off", "-o", folder / "none.html"}).exitCode, 2);
  CHECK_FALSE(std::filesystem::exists(folder / "none.html"));
  std::filesystem::create_directory(folder / "pages");
  REQUIRE_EQ(runQuick({sphere, cube, "-o", folder / "pages", "--format", "html"}).exitCode, 0);
  CHECK_EQ(dataOf(folder.read("pages/a.asdf.html")).at("meshes").size(), 1);
  CHECK(std::filesystem::exists(folder / "pages/b.asdf.html"));
}

TEST_CASE("a page goes to standard output, and a page that cannot be written is an error") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("a.off", cubeOff());
  const ChildOutcome outcome = runQuick({mesh, "-o", "-", "--format", "html"});
  CHECK_EQ(outcome.exitCode, 0);
  CHECK(outcome.output.starts_with("<!DOCTYPE html>"));
  CHECK_EQ(dataOf(outcome.output).at("meshes")[0].at("name"), "a.off");
  checkFailure(runQuick({mesh, "-o", folder / "no/a.html"}), 4, "no");
  if (std::filesystem::exists("/dev/full"))
    checkFailure(runQuick({mesh, "-o", "/dev/full", "--format", "html"}), 4, "/dev/full");
}

TEST_CASE("meshes of the same file name are told apart") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "x");
  const std::string first = folder.write("a.off", cubeOff()), second = folder.write("x/a.off", cubeOff());
  REQUIRE_EQ(runQuick({first, second, "-o", folder / "a.html"}).exitCode, 0);
  const auto meshes = dataOf(folder.read("a.html")).at("meshes");
  CHECK_EQ(meshes[0].at("name"), first);
  CHECK_EQ(meshes[1].at("name"), second);
}

TEST_CASE("--open starts xdg-open with the page and does not wait for it") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("a.off", cubeOff());
  std::filesystem::create_directory(folder / "bin");
  const std::string opener =
      folder.write("bin/xdg-open", "#!/bin/sh\necho \"$1\" > " + (folder / "part") + "\nmv " + (folder / "part") + " " +
                                       (folder / "opened") + "\nsleep 600\n");
  REQUIRE_EQ(chmod(opener.c_str(), 0755), 0);
  const std::string path = (folder / "bin") + ":/usr/bin:/bin";
  const ChildOutcome outcome = runQuick({mesh, "--open"}, {.environment = {{"PATH", path}}});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  for (int i = 0; i < 500 && !std::filesystem::exists(folder / "opened"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK_EQ(folder.read("opened"), (folder / "a.asdf.html") + "\n");
  checkFailure(runQuick({mesh, "-o", folder / "b.html", "--open"}, {.environment = {{"PATH", folder / "none"}}}), 4,
               "b.html is written, but xdg-open (package xdg-utils) cannot be started");
  CHECK(std::filesystem::exists(folder / "b.html"));
}

std::vector<std::string> plannedPages(const CommandLine& line) {
  std::vector<InputFile> inputs;
  for (const std::string& mesh : line.meshes) inputs.push_back({.path = mesh});
  return planOutputs(line.outputs, line.batch, inputs);
}

TEST_CASE("options of a page") {
  const CommandLine line = parseCommandLine({"a.ply", "-o", "A.HTML"});
  CHECK(writesPages(line.outputs));
  CHECK(writesOnePage(line.outputs));
  CHECK(line.computation.options.keepsScene);
  CHECK_EQ(plannedPages(line), std::vector<std::string>{"A.HTML"});
  CHECK_EQ(plannedPages(parseCommandLine({"a.ply", "b.ply", "-o", "c.html"})),
           std::vector<std::string>{"c.html", "c.html"});
  CHECK_EQ(plannedPages(parseCommandLine({"a.ply", "--open"})), std::vector<std::string>{"a.asdf.html"});
  CHECK_EQ(plannedPages(parseCommandLine({"a.ply", "b.ply", "--format", "html"})),
           std::vector<std::string>{"a.asdf.html", "b.asdf.html"});
  CHECK_FALSE(writesPages(parseCommandLine({"a.ply", "-o", "a.vtu"}).outputs));
  CHECK_FALSE(parseCommandLine({"a.ply", "-o", "a.vtu"}).computation.options.keepsScene);
  const auto isRefused = [](const std::vector<std::string>& arguments) {
    try {
      (void)plannedPages(parseCommandLine(arguments));
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::Usage);
      return true;
    }
    return false;
  };
  CHECK(isRefused({"a.ply", "-o", "a.html", "--format", "ply"}));
  CHECK(isRefused({"a.ply", "-o", "a.ply", "--format", "html"}));
  CHECK(isRefused({"a.html", "-o", "a.html"}));
  CHECK(isRefused({"a.ply", "-o", "a.html", "--ascii"}));
  CHECK(isRefused({"a.ply", "-o", "a.html", "--picture", "b.png", "--points", "b.png"}));
  CHECK(refusal({"a.ply", "-o", "a.vtu", "--open"}).find("-o FILE.html") != std::string::npos);
  CHECK(refusal({"a.ply", "-o", "-", "--format", "html", "--open"}).find("-o FILE.html") != std::string::npos);
  CHECK(refusal({"a.ply", "b.ply", "--open"}).find("-o FILE.html") != std::string::npos);
  CHECK(refusal({"a.ply", "-o", "a.html", "--fields", "centre"}).find("centre") != std::string::npos);
}

}  // namespace
}  // namespace asdfvk::test
