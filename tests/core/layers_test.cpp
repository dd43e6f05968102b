#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

const fs::path kSource = fs::path(ASDFVK_SOURCE_DIR) / "src";

std::string readText(const fs::path& file) {
  std::ifstream in(file);
  REQUIRE_MESSAGE(in, file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A row of src/layers.txt: the layers that this one may include.
using LayerTable = std::map<std::string, Names>;

LayerTable readLayers() {
  LayerTable layers;
  std::istringstream text(readText(kSource / "layers.txt"));
  for (std::string row; std::getline(text, row);) {
    if (row.empty() || row.front() == '#') continue;
    std::istringstream columns(row);
    std::string name, bar, owner, names;
    columns >> name >> bar;
    REQUIRE_MESSAGE(bar == "|", row);
    std::getline(columns, owner, '|');
    REQUIRE_MESSAGE((owner == " library " || owner == " C library " || owner == " programs "), row);
    std::getline(columns, names, '|');
    std::istringstream words(names);
    layers[name] = Names(std::istream_iterator<std::string>(words), {});
  }
  return layers;
}

const LayerTable& layers() {
  static const LayerTable table = readLayers();
  return table;
}

struct Include {
  std::string target;
  size_t line = 0;
};

// The path between the brackets or quotes of an include line, or empty.
std::string includeTargetOf(const std::string& line) {
  const size_t hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line[hash] != '#') return {};
  const size_t keyword = line.find_first_not_of(" \t", hash + 1);
  if (keyword == std::string::npos || line.compare(keyword, 7, "include") != 0) return {};
  const size_t begin = line.find_first_of("<\"", keyword + 7);
  if (begin == std::string::npos) return {};
  const size_t end = line.find_first_of(">\"", begin + 1);
  return end == std::string::npos ? std::string() : line.substr(begin + 1, end - begin - 1);
}

std::vector<Include> includesOf(const fs::path& file) {
  std::vector<Include> result;
  std::ifstream in(file);
  std::string text;
  for (size_t line = 1; std::getline(in, text); ++line) {
    const std::string target = includeTargetOf(text);
    if (!target.empty()) result.push_back({target, line});
  }
  return result;
}

bool isIn(const std::string& folder, const fs::path& file) {
  return std::find(file.begin(), file.end(), folder) != file.end();
}

// The reason why `file` of src/`layer` may not include `target`; empty where it may.
std::string objection(const std::string& layer, const fs::path& file, const std::string& target) {
  const std::string top = target.substr(0, target.find('/'));
  const bool isVulkan = isIn("vk", file);
  if (top == "OpenMesh" && layer != "generate") return "OpenMesh belongs in asdf_vk/openmesh.h, generate and tests";
  if ((top == "Eigen" || top == "unsupported") && layer != "poisson" && layer != "segment")
    return "Eigen belongs in poisson and segment";
  if ((target == "volk.h" || top == "vulkan" || top == "volk") && !isVulkan) return "Vulkan belongs in folders vk/";
  if (top == "tbb" && !isIn("tbb", file)) return "TBB belongs in the folders tbb/";
  if (target.ends_with(".hxx") && !isIn("opencascade", file)) return "Open CASCADE belongs in the folders opencascade/";
  if (top == "draco" && !isIn("draco", file)) return "Draco belongs in folders draco/";
  if (target == "meshoptimizer.h" && !isIn("meshoptimizer", file))
    return "meshoptimizer belongs in folders meshoptimizer/";
  if ((target == "archive.h" || target == "archive_entry.h") && layer != "batch") return "libarchive belongs in batch";
  if (top == "CLI" && layer != "arguments") return "CLI11 belongs in arguments";
  if (top == "embree3" || top == "embree4") return "Embree belongs in bench";
  const bool isOurs = layers().count(top) || top == "shared";
  if (!isOurs || top == layer) return {};
  if (top == "vk" && isVulkan) return {};
  if (!layers().at(layer).count(top)) return "src/" + layer + " may not include " + top;
  return {};
}

std::vector<std::string> objectionsIn(const fs::path& root) {
  std::vector<std::string> result;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    const fs::path relative = fs::relative(entry.path(), root);
    const std::string layer = relative.begin()->string();
    if (!layers().count(layer)) {
      result.push_back(relative.string() + ": not in src/layers.txt");
      continue;
    }
    for (const Include& include : includesOf(entry.path())) {
      const std::string reason = objection(layer, relative, include.target);
      if (!reason.empty())
        result.push_back(relative.string() + ":" + std::to_string(include.line) + ": " + include.target + ": " +
                         reason);
    }
  }
  return result;
}

}  // namespace

TEST_CASE("a folder of src includes only the layers that are allowed for it") {
  REQUIRE(fs::exists(kSource / "core" / "check.h"));
  REQUIRE(includesOf(kSource / "core" / "box3.h").size() == 4);
  for (const std::string& reason : objectionsIn(kSource)) FAIL_CHECK(reason);
}

TEST_CASE("layers have no circle: each includes only layers that are free of it themselves") {
  Names free;
  for (size_t before = SIZE_MAX; before != free.size();) {
    before = free.size();
    for (const auto& [name, names] : layers())
      if (std::all_of(names.begin(), names.end(), [&](const auto& n) { return n == "shared" || free.count(n); }))
        free.insert(name);
  }
  CHECK(free.size() == layers().size());
}

TEST_CASE("headers shared by host and device include nothing of src") {
  const fs::path shared = fs::path(ASDFVK_SOURCE_DIR) / "shaders" / "shared";
  if (!fs::exists(shared)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(shared))
    for (const Include& include : includesOf(entry.path())) {
      INFO(entry.path().string(), ":", include.line, ": ", include.target);
      CHECK(layers().count(include.target.substr(0, include.target.find('/'))) == 0);
    }
}

TEST_CASE("the table of docs/architecture.md is src/layers.txt") {
  const auto trimmed = [](const std::string& text) {
    const size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
    return begin == std::string::npos ? std::string() : text.substr(begin, end - begin + 1);
  };
  std::string table = "| folder of `src` | part of | may include | libraries | contents |\n|---|---|---|---|---|\n";
  std::istringstream text(readText(kSource / "layers.txt"));
  for (std::string row; std::getline(text, row);) {
    if (row.empty() || row.front() == '#') continue;
    std::istringstream columns(row);
    std::string name, owner, layers, libraries, contents;
    std::getline(columns, name, '|');
    std::getline(columns, owner, '|');
    std::getline(columns, layers, '|');
    std::getline(columns, libraries, '|');
    std::getline(columns, contents);
    table += "| `" + trimmed(name) + "`";
    for (const std::string& cell : {owner, layers, libraries, contents}) table += " | " + trimmed(cell);
    table += " |\n";
  }
  const std::string page = readText(fs::path(ASDFVK_SOURCE_DIR) / "docs" / "architecture.md");
  INFO("the table should be\n", table);
  CHECK(page.find("\n" + table + "\n") != std::string::npos);
}

TEST_CASE("include lines are read in all their spellings") {
  CHECK(includeTargetOf("#include \"mesh/mesh.h\"") == "mesh/mesh.h");
  CHECK(includeTargetOf("  #  include <vector>  // why") == "vector");
  CHECK(includeTargetOf("// #include <vector>").empty());
  CHECK(includeTargetOf("#define X").empty());
  CHECK(includeTargetOf("").empty());
}

TEST_CASE("the table objects to includes against it") {
  CHECK(objection("mesh", "src/mesh/a.cpp", "bvh/bvh.h") == "src/mesh may not include bvh");
  CHECK(objection("core", "src/core/a.h", "mesh/mesh.h") == "src/core may not include mesh");
  CHECK_FALSE(objection("cli", "src/cli/a.cpp", "seeds/samplers.h").empty());
  CHECK_FALSE(objection("trace", "src/trace/a.cpp", "vk/buffer.h").empty());
  CHECK_FALSE(objection("pipeline", "src/pipeline/a.cpp", "cli/options.h").empty());
  CHECK_FALSE(objection("mesh", "src/mesh/off.cpp", "OpenMesh/Core/IO/MeshIO.hh").empty());
  CHECK_FALSE(objection("trace", "src/trace/a.cpp", "Eigen/Sparse").empty());
  CHECK_FALSE(objection("bvh", "src/bvh/a.cpp", "volk.h").empty());
  CHECK_FALSE(objection("cli", "src/cli/options.cpp", "CLI/CLI.hpp").empty());
  CHECK_FALSE(objection("io", "src/io/gltf_file.cpp", "draco/mesh/mesh.h").empty());
  CHECK_FALSE(objection("io", "src/io/gltf_file.cpp", "meshoptimizer.h").empty());
  CHECK_FALSE(objection("pipeline", "src/pipeline/a.cpp", "vulkan/vulkan.h").empty());
  CHECK_FALSE(objection("io", "src/io/a.cpp", "TopoDS.hxx").empty());

  CHECK(objection("trace", "src/trace/vk/tracer.cpp", "vk/buffer.h").empty());
  CHECK(objection("trace", "src/trace/vk/tracer.cpp", "volk.h").empty());
  CHECK(objection("vk", "src/vk/buffer.h", "volk.h").empty());
  CHECK(objection("io", "src/io/opencascade/a.cpp", "TopoDS.hxx").empty());
  for (const char* header : {"embree3/rtcore.h", "embree4/rtcore.h"})
    CHECK_FALSE(objection("trace", "src/trace/seed_order.h", header).empty());
  CHECK(objection("poisson", "src/poisson/eigen.cpp", "Eigen/Sparse").empty());
  CHECK(objection("arguments", "src/arguments/arguments.cpp", "CLI/CLI.hpp").empty());
  CHECK_FALSE(objection("mesh", "src/mesh/dual_graph.cpp", "tbb/parallel_for.h").empty());
  CHECK(objection("mesh", "src/mesh/a.cpp", "vector").empty());
  CHECK(objection("generate", "src/generate/a.cpp", "mesh/mesh.h").empty());
}
