#include "generate/corpus.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "generate/corpus_files.h"
#include "mesh/face_geometry.h"
#include "support/brute_force_thickness.h"
#include "support/require_failure.h"
#include "topology.h"

using namespace asdfvk;
namespace fs = std::filesystem;

namespace {

/// Removed at the end, with its contents.
class CorpusFolder {
 public:
  CorpusFolder() { REQUIRE(mkdtemp(path_.data()) != nullptr); }
  CorpusFolder(const CorpusFolder&) = delete;
  CorpusFolder& operator=(const CorpusFolder&) = delete;
  ~CorpusFolder() { fs::remove_all(path_); }
  [[nodiscard]] fs::path path() const { return path_; }

 private:
  std::string path_ = (fs::temp_directory_path() / "asdfvk-corpus-XXXXXX").string();
};

std::map<std::string, std::string> filesOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(in), {}};
  }
  return files;
}

/// Whether a face has the point, with a tolerance of 1e-9.
bool isOnSurface(const Mesh& mesh, const Vec3d& point) {
  return std::any_of(mesh.faces.begin(), mesh.faces.end(), [&](const Face& face) {
    const std::array corners{mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]};
    const Vec3d product = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const Vec3d normal = product / length(product);
    for (size_t i = 0; i < 3; ++i)
      if (dot(cross(corners[(i + 1) % 3] - corners[i], point - corners[i]), normal) < -1e-9) return false;
    return std::abs(dot(point - corners[0], normal)) < 1e-9;
  });
}

}  // namespace

TEST_CASE("the corpus has parts of each category, with different names, sentences, and both verdicts") {
  std::set<std::string> names;
  std::map<std::string_view, std::set<PartVerdict>> verdicts;
  for (const KnownPart& part : corpusParts()) {
    CAPTURE(part.name);
    CHECK(names.insert(part.name).second);
    CHECK_FALSE(part.answers.empty());
    CHECK_FALSE(part.mesh.faces.empty());
    for (const KnownAnswer& answer : part.answers) {
      verdicts[part.category].insert(answer.verdict);
      CHECK(answer.reason.ends_with('.'));
      CHECK(answer.reason.find_first_of("\"\\\n") == std::string::npos);
      CHECK((answer.limit > 0) == (answer.check != PartCheck::Voids));
      // A value decides the verdict.
      if (answer.verdict == PartVerdict::NotJudged || !answer.value) continue;
      if (answer.check == PartCheck::Thicker)
        CHECK((*answer.value > answer.limit) == (answer.verdict == PartVerdict::Fail));
      else if (part.category != "gaps" || part.answers.size() > 1)
        CHECK((*answer.value < answer.limit || answer.check == PartCheck::Voids) ==
              (answer.verdict == PartVerdict::Fail));
    }
  }
  CHECK(names.size() >= 100);
  REQUIRE(verdicts.size() == 7);
  for (const auto& [category, found] : verdicts) CHECK(found.size() >= 2);
}

TEST_CASE("places lie on the surface, at the distance of the value") {
  size_t count = 0;
  for (const KnownPart& part : corpusParts())
    for (const KnownAnswer& answer : part.answers) {
      if (!answer.place) continue;
      CAPTURE(part.name);
      ++count;
      for (const Vec3d& point : *answer.place) CHECK(isOnSurface(part.mesh, point));
      CHECK(length((*answer.place)[0] - (*answer.place)[1]) == doctest::Approx(answer.value.value()).epsilon(1e-9));
    }
  CHECK(count >= 40);
}

TEST_CASE("walls, edges, gaps and thick bodies have closed surfaces, wound outwards") {
  for (const KnownPart& part : corpusParts()) {
    if (part.category == "sound" || part.category == "dangerous" || part.category == "voids") continue;
    if (part.answers[0].verdict == PartVerdict::NotJudged) continue;
    CAPTURE(part.name);
    CHECK(topologyOf(part.mesh).badEdgeCount == 0);
    CHECK(volumeOf(part.mesh) > 0);
  }
}

// Without the rib whose top is a sharp edge.
TEST_CASE("walls of constant thickness have their thickness by brute force") {
  for (const KnownPart& part : corpusParts()) {
    const KnownAnswer& answer = part.answers[0];
    if (part.category != "walls" || !answer.value || part.mesh.faceCount() > 200 ||
        part.name.starts_with("thin-body") || part.name.ends_with("45-degrees"))
      continue;
    CAPTURE(part.name);
    const test::BruteForceThickness thickness(part.mesh, -0.499,
                                              0x1p-22 * boundsOfFiniteVertices(part.mesh).diagonal());
    double least = std::numeric_limits<double>::infinity();
    for (uint32_t face = 0; face < part.mesh.faceCount(); ++face) least = std::min(least, thickness.least(face));
    CHECK(least == doctest::Approx(*answer.value).epsilon(1e-6));
  }
}

TEST_CASE("a corpus is written as a whole, with the same bytes each time, and never over other files") {
  const CorpusFolder folder;
  const size_t count = writeCorpus(folder.path() / "new");
  CHECK(count == corpusParts().size());
  fs::create_directory(folder.path() / "empty");
  writeCorpus(folder.path() / "empty/");
  const std::map<std::string, std::string> files = filesOf(folder.path() / "new");
  CHECK(files.size() == count + 2);
  CHECK(files == filesOf(folder.path() / "empty"));
  for (const KnownPart& part : corpusParts()) {
    CAPTURE(part.name);
    const Mesh read = readMesh(folder.path() / "new" / (part.name + "." + std::string(part.extension)));
    CHECK(read.faces.size() == part.mesh.faces.size());
  }
  for (const char* name : {"new", "new/truth.json"})
    test::requireFailure([&] { writeCorpus(folder.path() / name); }, ErrorCode::OutputNotWritable,
                         "the path exists and is not an empty folder");
  test::requireFailure([&] { writeCorpus(folder.path() / "no/folder"); }, ErrorCode::OutputNotWritable, "cannot make");
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 2);
}
