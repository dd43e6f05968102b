// Prints the time of --segment parts, and its Rand index error against the human segmentations of the Princeton
// Segmentation Benchmark (Chen, Golovinskiy and Funkhouser 2009).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>

#include "asdf_vk/files.h"
#include "segment/rand_index.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;
namespace fs = std::filesystem;

/// Category names of the models 1 to 20, 21 to 40, and so on. The models 261 to 280 have no category.
constexpr std::array kCategories{"Human",     "Cup",   "Glasses", "Airplane", "Ant",  "Chair",  "Octopus",
                                 "Table",     "Teddy", "Hand",    "Plier",    "Fish", "Bird",   "(none)",
                                 "Armadillo", "Bust",  "Mech",    "Bearing",  "Vase", "FourLeg"};
constexpr uint32_t kModelsPerCategory = 20;

struct Arguments {
  std::string folder, backend = "cpu", device;
  std::vector<std::string> seeds{"all", "10%", "2%"};
  double detail = 1;
  bool listsModels = false;
};

/// Reads a file with one line per face; each line is a number.
std::vector<uint32_t> readLabels(const fs::path& path) {
  std::ifstream file(path);
  std::vector<uint32_t> labels;
  for (uint32_t label = 0; file >> label;) labels.push_back(label);
  return labels;
}

struct Model {
  uint32_t id = 0;
  Mesh mesh;
  std::vector<std::vector<uint32_t>> humans;
};

Model readModel(const fs::path& folder, uint32_t id) {
  Model model{id, readMesh(folder / "off" / fmt::format("{}.off", id)), {}};
  for (uint32_t person = 0;; ++person) {
    const fs::path path = folder / "seg" / std::to_string(id) / fmt::format("{}_{}.seg", id, person);
    if (!fs::exists(path)) break;
    model.humans.push_back(readLabels(path));
    if (model.humans.back().size() != model.mesh.inputFaceCount())
      throw Error(ErrorCode::UnreadableInput, fmt::format("{} does not have one number per face", path.string()));
  }
  if (model.humans.empty()) throw Error(ErrorCode::UnreadableInput, fmt::format("model {} has no segmentation", id));
  return model;
}

std::vector<uint32_t> idsIn(const fs::path& folder) {
  std::vector<uint32_t> ids;
  for (const auto& entry : fs::directory_iterator(folder / "off"))
    if (entry.path().extension() == ".off") ids.push_back(static_cast<uint32_t>(std::stoul(entry.path().stem())));
  std::sort(ids.begin(), ids.end());
  return ids;
}

struct Score {
  double error = 0, seconds = 0;
  Report report;
};

Score scoreOf(Session& session, const Model& model, const std::string& seeds, const Arguments& arguments,
              const RunControl& control) {
  Options options;
  options.seeds = parseSeedCount(seeds);
  options.estimatesError = false;
  options.segmentation = Segmentation::Parts;
  options.parts.detail = arguments.detail;
  const Result result = session.compute(model.mesh, options, control);
  const auto& labels = std::get<std::vector<uint32_t>>(result.field("segment")->values);
  Score score{0, result.report.stageSeconds[Stage::Segment], result.report};
  for (const std::vector<uint32_t>& human : model.humans) score.error += 1 - randIndex(labels, human);
  score.error /= static_cast<double>(model.humans.size());
  return score;
}

/// Mean error of a human segmentation against each other human segmentation; 0 if there is only one segmentation.
double errorOfPeople(const Model& model) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < model.humans.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      sum += 1 - randIndex(model.humans[i], model.humans[j]);
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

struct Mean {
  double sum = 0, count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  [[nodiscard]] double value() const { return count > 0 ? sum / count : 0; }
};

void printModel(uint32_t id, const std::string& seeds, const Score& score) {
  const PartsReport& parts = *score.report.parts;
  writeOutput(fmt::format("{:>4} {:>4}  error {:.4f}  parts {:>3} ({} to {})  agreement {:.3f}  thin {}  {:.3f} s\n",
                          id, seeds, score.error, *score.report.segmentCount, parts.fewestCount, parts.mostCount,
                          parts.agreement.value_or(kNoValue), parts.thinShell ? 1 : 0, score.seconds));
}

void run(const Arguments& arguments, const RunControl& control) {
  Session session(sessionOptionsOf(arguments.backend, arguments.device));
  const size_t columnCount = arguments.seeds.size();
  std::map<uint32_t, std::vector<Mean>> errors;  // Errors of each category.
  std::vector<Mean> all(columnCount + 1), counts(columnCount), seconds(columnCount);
  for (const uint32_t id : idsIn(arguments.folder)) {
    control.checkpoint(0);
    const Model model = readModel(arguments.folder, id);
    const uint32_t category = (id - 1) / kModelsPerCategory;
    errors[category].resize(columnCount + 1);
    const double ofPeople = errorOfPeople(model);
    errors[category].back().add(ofPeople);
    all.back().add(ofPeople);
    for (size_t i = 0; i < columnCount; ++i) {
      const Score score = scoreOf(session, model, arguments.seeds[i], arguments, {control.stop, {}});
      errors[category][i].add(score.error);
      all[i].add(score.error);
      counts[i].add(*score.report.segmentCount);
      seconds[i].add(score.seconds);
      if (arguments.listsModels) printModel(id, arguments.seeds[i], score);
    }
  }
  std::string text = fmt::format("{}\nRand index error against people, by faces that cast rays\n\n| category |",
                                 toText(thisMachine()));
  for (const std::string& seeds : arguments.seeds) text += fmt::format(" {} |", seeds);
  text += " people |\n|---|---|";
  for (size_t i = 0; i < columnCount; ++i) text += "---|";
  const auto addRow = [&](const std::string& name, const std::vector<Mean>& means, int decimals) {
    text += fmt::format("\n| {} |", name);
    for (const Mean& mean : means) text += fmt::format(" {:.{}f} |", mean.value(), decimals);
  };
  for (const auto& [category, means] : errors)
    addRow(category < kCategories.size() ? kCategories[category] : "(none)", means, 4);
  addRow(fmt::format("mean of {} models", all.front().count), all, 4);
  addRow("parts", counts, 1);
  addRow("seconds", seconds, 3);
  writeOutput(text + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-parts", "Rand index error of --segment parts against human segmentations.");
  Arguments arguments;
  program.addRequired("--folder", arguments.folder, "DIR",
                      "Benchmark: off/ID.off, and seg/ID/ID_0.seg, ID_1.seg, ... with a label per face");
  program.add("--seeds", arguments.seeds, "Shares, counts or all");
  program.add("--detail", arguments.detail, "As --detail of asdf-vk", {kMinDetail, kMaxDetail});
  program.add("--backend", arguments.backend, "vulkan, cpu or reference");
  program.add("--device", arguments.device, "Vulkan device: index or part of its name");
  program.add("--models", arguments.listsModels, "Also print a line per model");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
