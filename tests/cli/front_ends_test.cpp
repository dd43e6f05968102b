// The cases of tests/describe/option_cases.json on the command line, in C++ and in C; python/tests/test_options.py has
// them in Python. The messages are the same but for the spelling of names and values.
#include <doctest/doctest.h>

#include <fstream>
#include <set>

#include "c/c_objects.h"
#include "cli/command_line.h"
#include "cli/refusal.h"
#include "cli/report_json.h"
#include "core/json.h"
#include "describe/option_rules.h"
#include "describe/report_json.h"
#include "generate/analytic_shapes.h"
#include "support/shapes.h"

namespace asdfvk {
namespace {

/// One word per name: "--wall-angle 90", "wallAngleDegrees=90" and "wall_angle='90'" are "wallangle 90".
std::string withoutSpelling(std::string text) {
  const auto replaceAll = [&](const std::string& from, const std::string& to) {
    for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  };
  replaceAll("--no-estimate", "estimate off");
  replaceAll("estimate=false", "estimate off");
  replaceAll("Degrees", "");
  replaceAll("Seconds", "");
  replaceAll("=", " ");
  std::string words;
  for (const char c : text)
    if (c != '-' && c != '\'') words += static_cast<char>('A' <= c && c <= 'Z' ? c - 'A' + 'a' : c);
  return words;
}

std::string textOf(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

const SettingsWithRows& defaultOptions() {
  static const SettingsWithRows defaults;
  return defaults;
}

bool isOfSession(const std::string& name) { return findOption(defaultOptions().ofSession, name) != nullptr; }

const OptionRow& rowOf(const std::string& name) {
  return *findOption(isOfSession(name) ? defaultOptions().ofSession : defaultOptions().ofComputation, name);
}

std::vector<std::string> argumentsOf(const Json& options) {
  std::vector<std::string> arguments{"a.ply"};
  for (const auto& [name, value] : options.items()) {
    const std::string flag = spelled(rowOf(name), OptionSpelling::Flag);
    arguments.push_back(value.is_boolean() ? flag : flag + "=" + textOf(value));
  }
  return arguments;
}

/// Sets a member as a caller of the library does: out of its range, too. False where its type has no such value.
bool setMember(OptionRow row, const Json& value) {
  row.range = {};
  if (value.is_number() && value.get<double>() < 0) return false;
  try {
    if (value.is_boolean())
      setOption(row, value.get<bool>(), "", OptionSpelling::CamelCase);
    else
      setOptionText(row, textOf(value));
  } catch (const Error&) {
    return false;
  }
  return true;
}

std::string refusalOfLibrary(const ComputationSettings& computation, const SessionSettings& session) {
  try {
    (void)CheckedOptions(computation.options);
    requireValid(session, OptionSpelling::CamelCase);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Usage);
    CHECK_FALSE(error.details().empty());
    return error.what();
  }
  return "accepted";
}

/// "accepted", or the message of the interface in C, where the option is set, where the session is opened, or where the
/// mesh is computed.
std::string refusalInC(asdf_vk_scene* scene, const Json& options) {
  const test::Owned<asdf_vk_options> own = test::optionsOfC({});
  asdf_vk_status status = ASDF_VK_OK;
  for (const auto& item : options.items()) {
    const std::string text = textOf(item.value());
    if (status == ASDF_VK_OK) status = asdf_vk_options_set(own.get(), item.key().c_str(), text.c_str());
  }
  asdf_vk_session* session = nullptr;
  asdf_vk_result* result = nullptr;
  if (status == ASDF_VK_OK && isOfSession(options.begin().key()))
    status = asdf_vk_session_create(own.get(), &session);
  else if (status == ASDF_VK_OK)
    status = asdf_vk_compute(scene, own.get(), nullptr, nullptr, &result);
  asdf_vk_session_destroy(session);
  asdf_vk_result_destroy(result);
  CHECK((status == ASDF_VK_OK || status == ASDF_VK_USAGE));
  return status == ASDF_VK_OK ? "accepted" : asdf_vk_last_error();
}

TEST_CASE("the command line and C refuse the same options with the same sentence") {
  const test::Owned<asdf_vk_session> session = test::sessionOfC("reference");
  const test::Owned<asdf_vk_scene> scene = test::sceneOfC(session.get(), shapes::tetrahedron());
  std::ifstream in(ASDFVK_TEST_DIR "/describe/option_cases.json");
  for (const Json& example : Json::parse(in)) {
    const Json& options = example.at("options");
    const auto isForProgram = [&](const OptionRow& row) {
      return row.where == OptionPlace::Program && options.contains(row.name);
    };
    const OptionRows& rows = defaultOptions().ofComputation;
    if (std::any_of(rows.begin(), rows.end(), isForProgram)) continue;
    CAPTURE(options.dump());
    CHECK_EQ(withoutSpelling(refusalInC(scene.get(), options)),
             withoutSpelling(example.at("refusal").get<std::string>()));
  }
}

TEST_CASE("the JSON report of C is that of the program") {
  const Mesh mesh = makeSlab(2000).mesh;
  const CommandLine line = parseCommandLine(
      {"a.ply", "--measure", "both", "--thinner-than", "0.8", "--seeds", "20%", "--backend", "reference"});
  Session session(line.session);
  const Result result = session.compute(mesh, line.computation.options);
  const std::string name = "a.ply";
  Json ofProgram =
      Json::parse(jsonReport({name, name, line.computation, line.session, line.others, line.outputs, result}));
  for (const char* key : {"mesh", "output", "picture", "points", "with", "withFaceCounts", "former"})
    ofProgram.erase(key);

  const test::Owned<asdf_vk_session> own = test::sessionOfC("reference");
  const test::Owned<asdf_vk_scene> scene = test::sceneOfC(own.get(), mesh);
  const test::Owned<asdf_vk_result> ownResult =
      test::resultOfC(scene.get(), {{"measure", "both"}, {"thinner-than", "0.8"}, {"seeds", "20%"}});
  Json ofC = Json::parse(test::jsonAt(ownResult.get(), ""));
  for (Json* json : {&ofProgram, &ofC}) {
    CHECK(json->at("stageSeconds").at("thickness") > 0);
    for (const char* key : {"stageSeconds", "raysPerSecond"}) json->erase(key);
  }
  CHECK_EQ(ofC, ofProgram);
}

TEST_CASE("the command line and the library refuse the same options with the same sentence") {
  std::ifstream in(ASDFVK_TEST_DIR "/describe/option_cases.json");
  std::set<std::string> names;
  // A caller of the library can neither name a default nor a limit of the program, and the recipe is no member.
  const std::set<std::string> ofNames{"postprocess", "recipe", "fail-if-thinner"};
  size_t comparedCount = 0;
  for (const Json& example : Json::parse(in)) {
    const Json& options = example.at("options");
    CAPTURE(options.dump());
    CHECK_EQ(refusal(argumentsOf(options)), example.at("refusal").get<std::string>());
    SettingsWithRows set;
    bool isSet = options.value("measure", "") != "sdf";
    for (const OptionRows* const rows : {&set.ofComputation, &set.ofSession})
      for (const OptionRow& row : *rows) {
        if (!options.contains(row.name)) continue;
        names.insert(row.name);
        isSet = isSet && !ofNames.contains(row.name) && setMember(row, options.at(row.name));
      }
    if (!isSet) continue;
    CHECK_EQ(withoutSpelling(refusalOfLibrary(set.computation, set.session)),
             withoutSpelling(example.at("refusal").get<std::string>()));
    ++comparedCount;
  }
  CHECK(comparedCount >= 30);
  for (const OptionRow& row : defaultOptions().ofComputation)
    if (!isFlag(row) && std::string_view(row.name) != "max-relative-error")
      CHECK_MESSAGE(names.contains(row.name), row.name);
  for (const OptionRow& row : defaultOptions().ofSession)
    if (row.where != OptionPlace::Program) CHECK_MESSAGE(names.contains(row.name), row.name);
}

TEST_CASE("the library implies what the command line implies") {
  const auto lineOf = [](std::vector<std::string> arguments) {
    arguments.emplace_back("a.ply");
    return parseCommandLine(arguments).computation;
  };
  const auto isSame = [](const Options& options, const ComputationSettings& line) {
    const ComputationSettings own{.recipe = line.recipe, .options = *CheckedOptions(options), .failIfThinner = {}};
    for (const auto& ofLibrary : reportedOptions(own, {}))
      for (const auto& ofLine : reportedOptions(line, {}))
        if (ofLibrary.first == ofLine.first) CHECK_MESSAGE(ofLibrary.second == ofLine.second, ofLibrary.first);
  };
  isSame({.thickness = {.thinnerThan = 1}}, lineOf({"--thinner-than", "1"}));
  isSame({.rounds = {.maxError = 0.05}}, lineOf({"--max-error", "5%"}));
  isSame({.rounds = {.maxRelativeError = 0.05}}, lineOf({"--max-error", "5%rel"}));
  isSame({.seeds = SeedCount::ofShare(0.1), .rounds = {.maxError = 0.05}},
         lineOf({"--max-error", "5%", "--seeds", "10%"}));
  isSame({.segmentation = Segmentation::Cgal}, lineOf({"--segment", "cgal"}));
  Options ofCgal;
  applyDefinition(Definition::Cgal, ofCgal);
  isSame(ofCgal, lineOf({"--definition", "cgal"}));
  ofCgal.rounds.maxError = 0.01;
  isSame(ofCgal, lineOf({"--definition", "cgal", "--max-error", "1%"}));
  CHECK_EQ(CheckedOptions(ofCgal)->seeds.share, kFirstRoundShare);
}

TEST_CASE("the options of a report repeat the run") {
  const std::vector<std::vector<std::string>> calls{
      {"--recipe", "quality", "--seeds", "7.3%", "--rays", "31", "--angle", "100.25", "--rng-seed",
       "12345678901234567890"},
      {"--recipe", "paper", "--max-error", "3%rel", "--sampler", "adaptive", "--check=all"},
      {"--definition", "cgal", "--segment", "cgal", "--clusters", "7", "--per", "vertex"},
      {"--thinner-than", "0.1", "--count-edges", "--wall-angle", "130", "--orient", "auto"},
      {"--no-estimate", "--seeds", "50", "--smooth", "2x1", "--tolerance", "1e-5", "--fields", "centre"}};
  for (std::vector<std::string> arguments : calls) {
    CAPTURE(arguments.front());
    arguments.emplace_back("a.ply");
    const CommandLine line = parseCommandLine(arguments);
    const Json reported = optionValues(line.computation, line.session);
    ComputationSettings again;
    GivenOptions given;
    for (const OptionRow& row : computationRows(again)) {
      const Json& value = reported.at(spelled(row, OptionSpelling::CamelCase));
      if (value.is_null()) continue;
      given.names.insert(row.name);
      if (value.is_boolean())
        setOption(row, value.get<bool>(), "", OptionSpelling::CamelCase);
      else
        setOptionText(row, textOf(value));
    }
    if (!again.options.thickness.thinnerThan) given.names.erase("count-edges");
    complete(again, given);
    CHECK_EQ(optionValues(again, line.session), reported);
  }
}

}  // namespace
}  // namespace asdfvk
