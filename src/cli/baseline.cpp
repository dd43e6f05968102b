#include "cli/baseline.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "asdf_vk/error.h"
#include "cli/member_files.h"
#include "core/atomic_file.h"
#include "core/shallow_json.h"
#include "core/text.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

/// A place that is thinner by more than this share is new.
constexpr double kValueTolerance = 0.05;

bool isWorse(const Finding& finding, double known) {
  const bool isGreaterWorse = finding.kind == FindingKind::ThickBody || finding.kind == FindingKind::SealedVoid;
  return isGreaterWorse ? finding.value > known * (1 + kValueTolerance) : finding.value < known * (1 - kValueTolerance);
}

bool isNear(const Finding& finding, const KnownPlace& known) {
  if (!finding.place || !known.place) return !finding.place && !known.place;
  const auto& [x, y, z] = *known.place;
  const Vec3d place{x, y, z};
  // A void has no limit; its place may be anywhere on its boundary.
  const double reach = finding.limit ? *finding.limit : std::cbrt(std::abs(finding.value));
  return length(*finding.place - place) <= reach || (finding.opposite && length(*finding.opposite - place) <= reach);
}

/// Without names such as "component 3", which depend on the order of the faces.
std::vector<std::string> namesOf(std::vector<std::string> bodies) {
  std::erase_if(bodies, [](const std::string& name) {
    constexpr std::string_view kGenerated = "component ";
    return name.starts_with(kGenerated) && numberIn<uint64_t>(std::string_view(name).substr(kGenerated.size()));
  });
  return bodies;
}

bool isSame(const Finding& finding, const KnownPlace& known) {
  return known.kind == nameOf(finding.kind) && namesOf(known.bodies) == namesOf(finding.bodies) &&
         isNear(finding, known) && !(known.value && isWorse(finding, *known.value));
}

std::vector<KnownPlace> failuresOf(const MeshRecord& record) {
  std::vector<KnownPlace> places;
  for (const Json& finding : record.findings)
    if (finding.at("level") == nameOf(FindingLevel::Failure)) places.push_back(finding.get<KnownPlace>());
  return places;
}

}  // namespace

std::string pathBelow(const std::string& folder, const std::string& mesh) {
  if (mesh == "-") return mesh;
  return absolutePathOf(mesh).lexically_relative(folder).generic_string();
}

Json readObject(const std::string& path, const std::string& use) {
  std::ifstream in(path, std::ios::binary);
  std::error_code ignored;
  if (!in || fs::is_directory(path, ignored))
    throw Error(ErrorCode::UnreadableInput, fmt::format("{} {} cannot be read", use, path));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  Json json;
  try {
    json = parsedShallowJson(text);
  } catch (const std::exception&) {  // The next condition is about this case, too.
  }
  if (!json.is_object())
    throw Error(ErrorCode::UnreadableInput,
                fmt::format("{} {} is not a JSON object; write it as in docs/integration.md", use, path));
  return json;
}

void Baseline::mark(const std::string& mesh, std::vector<Finding>& findings) const {
  if (places.empty()) return;
  const auto known = places.find(pathBelow(folder, mesh));
  if (known == places.end()) return;
  for (Finding& finding : findings) {
    if (finding.level != FindingLevel::Failure) continue;
    finding.isKnown = std::any_of(known->second.begin(), known->second.end(),
                                  [&](const KnownPlace& place) { return isSame(finding, place); });
    if (finding.isKnown) finding.level = FindingLevel::Note;
  }
}

Baseline readBaseline(const std::string& path) {
  std::error_code ofPath;
  if (!fs::exists(path, ofPath) && !ofPath)
    throw Error(ErrorCode::UnreadableInput,
                fmt::format("the baseline {} does not exist; --update-baseline writes it", path));
  const Json json = readObject(path, "the baseline");
  if (json.value("formatVersion", Json()) != kJsonFormatVersion)
    throw Error(ErrorCode::UnreadableInput,
                fmt::format("the baseline {} has another format version than {}; write it anew with --update-baseline",
                            path, kJsonFormatVersion));
  Baseline baseline{.folder = fs::absolute(path).lexically_normal().parent_path().string(), .places = {}};
  try {
    baseline.places = json.get<BaselineDocument>().known;
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::UnreadableInput, fmt::format("the baseline {} is damaged: {}", path, error.what()));
  }
  return baseline;
}

void updateBaseline(const std::string& path, std::span<const MeshRecord> records) {
  Baseline baseline{.folder = fs::absolute(path).lexically_normal().parent_path().string(), .places = {}};
  std::error_code ignored;
  if (fs::exists(path, ignored)) baseline = readBaseline(path);
  for (const MeshRecord& record : records) {
    if (record.findings.is_null()) continue;
    const std::string mesh = pathBelow(baseline.folder, record.input);
    std::vector<KnownPlace> failures = failuresOf(record);
    if (failures.empty())
      baseline.places.erase(mesh);
    else
      baseline.places[mesh] = std::move(failures);
  }
  AtomicFile file(path);
  file.write(jsonText(BaselineDocument{.known = std::move(baseline.places)}, 1) + "\n");
  file.commit();
}

}  // namespace asdfvk
