#include "generate/corpus_files.h"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "core/atomic_file.h"
#include "generate/corpus.h"

namespace asdfvk {
namespace {

constexpr std::string_view kCorpusReadme = R"(# Parts of known truth

Each row of `cases` in truth.json is a question about a file, and the right answer. The answers follow from the
construction of the parts, not from a program. The rule for walls, details, edges and gaps is in docs/thickness.md of
asdf-vk.

| key | meaning |
|---|---|
| `file` | a mesh in this folder; its lengths are in mm |
| `category` | `walls`, `edges` (shapes near the thresholds of the rule), `gaps`, `voids`, `thick`, `sound` (solids that only look broken), `dangerous` (walls without thickness, surfaces of no solid) |
| `check` | `thinner`: is a wall thinner than the limit? `closer`: is a gap closer? `voids`: is there a sealed void? `thicker`: is a ball inside greater than the limit? |
| `limit` | the limit in the unit of the file; null for `voids` |
| `verdict` | `pass`, `fail`, or `notJudged`: the surface bounds no solid, so the question has no answer |
| `value` | `thinner`: thickness of the least wall. `closer`: width of the least gap. `voids`: volume of all voids. `thicker`: diameter of the greatest ball. null: there is none, or it varies along the wall |
| `place` | `point` and `opposite`: a place of the least wall or gap, on both of its sides; null: not stated |
| `reason` | a sentence |

To score a tool, answer each row and compare the verdicts. A `fail` that a tool calls `pass` is a missed failure; a
`pass` that it calls `fail` is a false failure. bench/known_parts.py of asdf-vk does this for asdf-vk and for two simple
checks. A length is right if it is within 0.1 % of the value.
)";

void writeStl(AtomicFile& file, const Mesh& mesh) {
  file.write(fmt::format("{:80}", "asdf-vk-generate"));
  file.put(mesh.faceCount());
  for (const Face& face : mesh.faces) {
    for (int axis = 0; axis < 3; ++axis) file.put(0.0F);
    for (const uint32_t vertex : face)
      for (size_t axis = 0; axis < 3; ++axis) file.put(static_cast<float>(mesh.vertices[vertex][axis]));
    file.put(uint16_t{0});
  }
}

void writeOff(AtomicFile& file, const Mesh& mesh) {
  file.write(fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.faces.size()));
  for (const Vec3d& p : mesh.vertices) file.write(fmt::format("{} {} {}\n", p.x, p.y, p.z));
  for (const auto& [a, b, c] : mesh.faces) file.write(fmt::format("3 {} {} {}\n", a, b, c));
}

template <typename Write>
void writeFile(const std::filesystem::path& path, const Write& write) {
  AtomicFile file(path);
  write(file);
  file.commit();
}

void writePart(const std::filesystem::path& path, const KnownPart& part) {
  if (part.extension == "stl")
    writeFile(path, [&](AtomicFile& file) { writeStl(file, part.mesh); });
  else if (part.extension == "off")
    writeFile(path, [&](AtomicFile& file) { writeOff(file, part.mesh); });
  else
    writeResult(path, part.mesh, {});
}

std::string numberOrNull(const std::optional<double>& number) { return number ? fmt::format("{}", *number) : "null"; }

std::string pointText(const Vec3d& p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); }

/// A row of truth.json. The texts have no characters that JSON escapes.
std::string caseText(const std::string& file, const KnownPart& part, const KnownAnswer& answer) {
  constexpr std::array kChecks{"thinner", "closer", "voids", "thicker"};
  constexpr std::array kVerdicts{"pass", "fail", "notJudged"};
  const bool hasLimit = answer.check != PartCheck::Voids;
  return fmt::format(
      R"({{"file": "{}", "category": "{}", "check": "{}", "limit": {}, "verdict": "{}", "value": {}, "place": {}, )"
      R"("reason": "{}"}})",
      file, part.category, kChecks[static_cast<size_t>(answer.check)],
      numberOrNull(hasLimit ? std::optional(answer.limit) : std::nullopt),
      kVerdicts[static_cast<size_t>(answer.verdict)], numberOrNull(answer.value),
      answer.place ? fmt::format(R"({{"point": {}, "opposite": {}}})", pointText((*answer.place)[0]),
                                 pointText((*answer.place)[1]))
                   : "null",
      answer.reason);
}

size_t writeCorpusFiles(const std::filesystem::path& folder) {
  const std::vector<KnownPart> parts = corpusParts();
  std::string rows;
  for (const KnownPart& part : parts) {
    const std::string file = fmt::format("{}.{}", part.name, part.extension);
    writePart(folder / file, part);
    for (const KnownAnswer& answer : part.answers)
      rows += fmt::format("{}\n{}", rows.empty() ? "" : ",", caseText(file, part, answer));
  }
  writeFile(folder / "truth.json", [&](AtomicFile& file) { file.write(fmt::format("{{\"cases\": [{}\n]}}\n", rows)); });
  writeFile(folder / "README.md", [](AtomicFile& file) { file.write(kCorpusReadme); });
  return parts.size();
}

}  // namespace

size_t writeCorpus(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto requireNone = [&](const char* what) {
    if (error)
      throw Error(ErrorCode::OutputNotWritable, fmt::format("{}: {}: {}", folder.string(), what, error.message()));
  };
  fs::path target = fs::absolute(folder, error).lexically_normal();
  if (!target.has_filename()) target = target.parent_path();
  target = followLinks(target);
  if (fs::exists(target, error) && (!fs::is_directory(target, error) || !fs::is_empty(target, error)))
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("{}: the path exists and is not an empty folder", folder.string()));
  const fs::path unfinished =
      target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), static_cast<int>(getpid()));
  fs::create_directory(unfinished, error);
  requireNone("cannot make a folder beside it");
  try {
    const size_t count = writeCorpusFiles(unfinished);
    fs::rename(unfinished, target, error);
    requireNone("cannot make the folder");
    return count;
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
    throw;
  }
}

}  // namespace asdfvk
