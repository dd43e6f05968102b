#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

// What a folder of src may include besides itself. A folder that is missing here fails the test.
const std::map<std::string, Names> kMayInclude = {
    {"core", {}},
    {"vk", {"core"}},
    {"mesh", {"core"}},
    {"generate", {"mesh", "core"}},
    {"bvh", {"mesh", "core", "shared"}},
    {"cone", {"mesh", "core", "shared"}},
    {"seeds", {"mesh", "core"}},
    {"trace", {"bvh", "cone", "mesh", "core", "shared"}},
    {"reprojection", {"trace", "cone", "bvh", "mesh", "core", "shared"}},
    {"poisson", {"mesh", "core", "shared"}},
    {"post", {"mesh", "core", "shared"}},
    {"picture", {"trace", "bvh", "mesh", "core"}},
    {"pipeline", {"post", "poisson", "reprojection", "trace", "seeds", "cone", "bvh", "mesh", "vk", "core", "shared"}},
    {"cli", {"pipeline", "picture", "mesh", "core"}},
};

struct Include {
  std::string target;
  size_t line = 0;
};

// What stands between the brackets or quotes of an include line, else nothing.
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

bool isVulkanFile(const fs::path& file) { return file.filename().string().rfind("vulkan_", 0) == 0; }

bool isEmbreeFile(const fs::path& file) { return file.filename().string().rfind("embree_", 0) == 0; }

// The reason why `file` of src/`layer` may not include `target`; empty where it may.
std::string objection(const std::string& layer, const fs::path& file, const std::string& target) {
  const std::string top = target.substr(0, target.find('/'));
  const bool isVulkan = layer == "vk" || isVulkanFile(file);
  if (top == "OpenMesh" && layer != "generate" && file.filename() != "openmesh_adapter.h")
    return "OpenMesh belongs in mesh/openmesh_adapter.h, generate and tests";
  if ((top == "Eigen" || top == "unsupported") && layer != "poisson") return "Eigen belongs in poisson";
  if ((target == "volk.h" || top == "vulkan" || top == "volk") && !isVulkan)
    return "Vulkan belongs in vk and the vulkan_* files";
  if (top == "embree3" && !isEmbreeFile(file)) return "Embree belongs in the embree_* files of trace";
  const bool isOurs = kMayInclude.count(top) || top == "shared";
  if (!isOurs || top == layer) return {};
  if (top == "vk" && isVulkanFile(file) && (layer == "trace" || layer == "poisson" || layer == "post")) return {};
  if (!kMayInclude.at(layer).count(top)) return "src/" + layer + " may not include " + top;
  return {};
}

std::vector<std::string> objectionsIn(const fs::path& root) {
  std::vector<std::string> result;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    const fs::path relative = fs::relative(entry.path(), root);
    const std::string layer = relative.begin()->string();
    if (!kMayInclude.count(layer)) {
      result.push_back(relative.string() + ": no layer of the table");
      continue;
    }
    for (const Include& include : includesOf(entry.path())) {
      const std::string reason = objection(layer, entry.path(), include.target);
      if (!reason.empty())
        result.push_back(relative.string() + ":" + std::to_string(include.line) + ": " + include.target + ": " +
                         reason);
    }
  }
  return result;
}

}  // namespace

TEST_CASE("a folder of src includes only what its layer may") {
  const fs::path root = fs::path(ASDFVK_SOURCE_DIR) / "src";
  REQUIRE(fs::exists(root / "core" / "check.h"));
  REQUIRE(includesOf(root / "core" / "box3.h").size() == 4);
  for (const std::string& reason : objectionsIn(root)) FAIL_CHECK(reason);
}

TEST_CASE("what host and device share includes nothing of src") {
  const fs::path shared = fs::path(ASDFVK_SOURCE_DIR) / "shaders" / "shared";
  if (!fs::exists(shared)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(shared))
    for (const Include& include : includesOf(entry.path())) {
      INFO(entry.path().string(), ":", include.line, ": ", include.target);
      CHECK(kMayInclude.count(include.target.substr(0, include.target.find('/'))) == 0);
    }
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
  CHECK_FALSE(objection("cli", "src/cli/a.cpp", "trace/cone_tracer.h").empty());
  CHECK_FALSE(objection("trace", "src/trace/a.cpp", "vk/buffer.h").empty());
  CHECK_FALSE(objection("pipeline", "src/pipeline/a.cpp", "cli/options.h").empty());
  CHECK_FALSE(objection("mesh", "src/mesh/off.cpp", "OpenMesh/Core/IO/MeshIO.hh").empty());
  CHECK_FALSE(objection("trace", "src/trace/a.cpp", "Eigen/Sparse").empty());
  CHECK_FALSE(objection("bvh", "src/bvh/a.cpp", "volk.h").empty());
  CHECK_FALSE(objection("pipeline", "src/pipeline/a.cpp", "vulkan/vulkan.h").empty());

  CHECK(objection("trace", "src/trace/vulkan_tracer.cpp", "vk/buffer.h").empty());
  CHECK(objection("trace", "src/trace/vulkan_tracer.cpp", "volk.h").empty());
  CHECK_FALSE(objection("trace", "src/trace/seed_order.h", "embree3/rtcore.h").empty());
  CHECK(objection("trace", "src/trace/embree_scene.h", "embree3/rtcore.h").empty());
  CHECK(objection("mesh", "src/mesh/openmesh_adapter.h", "OpenMesh/Core/Mesh/Handles.hh").empty());
  CHECK(objection("poisson", "src/poisson/eigen.cpp", "Eigen/Sparse").empty());
  CHECK(objection("mesh", "src/mesh/a.cpp", "vector").empty());
  CHECK(objection("generate", "src/generate/a.cpp", "mesh/mesh.h").empty());
}
