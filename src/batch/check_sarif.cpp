#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>

#include "asdf_vk/version.h"
#include "batch/check_report.h"

// https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html
namespace asdfvk {
namespace {

struct RuleText {
  const char* kind;
  const char* text;
  const char* help;
};

/// Texts of the kinds of findings, and of failures that need more than their name.
constexpr std::array kRuleTexts{
    RuleText{"thinWall", "A wall is thinner than the limit.", "Make the wall at least as thick as the limit."},
    RuleText{"thinDetail", "A detail is thinner than the limit.", "Enlarge the detail, or remove it."},
    RuleText{"thinEdge", "The shape tapers off to less than the limit.", "Round the edge, or make it blunt."},
    RuleText{"narrowGap", "A gap is narrower than the limit.", "Make the gap wider, or close it."},
    RuleText{"thickBody", "A body is thicker than the limit.", "Hollow the body out, or divide it."},
    RuleText{"sealedVoid", "A space inside has no way out.", "Add a hole to the outside, or fill the space."},
    RuleText{"bodiesInContact", "Two bodies touch or overlap.", "Move the bodies apart, or join them."},
    RuleText{"unjudged", "A part of the surface cannot be judged.", "Repair the surface as the message says."},
};

/// A rule of a kind of findings, or of the name of an error.
Json ruleOf(const std::string& kind) {
  const auto found =
      std::find_if(kRuleTexts.begin(), kRuleTexts.end(), [&](const RuleText& row) { return row.kind == kind; });
  const bool isFinding = found != kRuleTexts.end();
  const Json text{{"text", isFinding ? found->text : fmt::format("The mesh has no result ({}).", kind)}};
  // GitHub requires all three.
  return {{"id", kind},
          {"shortDescription", text},
          {"fullDescription", text},
          {"help", {{"text", isFinding ? found->help : "Correct the cause that the message names."}}}};
}

/// A path as a reference of a URI (RFC 3986): relative, or "file:///...".
std::string uriOf(const std::string& path) {
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || std::string_view("-._~/").find(c) != std::string_view::npos)
      uri += c;
    else
      uri += fmt::format("%{:02X}", byte);
  }
  return uri;
}

const char* levelOf(const CheckItem& item) {
  return item.level == "note" ? "note" : item.level == "notJudged" ? "warning" : "error";
}

/// Equal for findings of one kind whose places are in the same cell of a grid with cells as wide as the limit.
std::string fingerprintOf(const CheckItem& item) {
  std::string print = item.kind;
  if (!item.finding.is_object() || !item.finding.contains("place")) return print;
  const auto limit = item.finding.find("limit");
  const double step = limit != item.finding.end() && limit->is_number() ? limit->get<double>() : 0;
  for (const Json& coordinate : item.finding["place"]) {
    const double value = coordinate.is_number() ? coordinate.get<double>() : 0;
    print += step > 0 ? fmt::format("/{:.0f}", std::round(value / step)) : fmt::format("/{:.3g}", value);
  }
  return print;
}

class Rules {
 public:
  size_t indexOf(const std::string& kind) {
    const auto [found, isNew] = indices_.emplace(kind, rules_.size());
    if (isNew) rules_.push_back(ruleOf(kind));
    return found->second;
  }
  [[nodiscard]] const Json& all() const { return rules_; }

 private:
  std::map<std::string, size_t> indices_;
  Json rules_ = Json::array();
};

/// print: fingerprintOf(), with a number if several results of the mesh have the same.
Json resultOf(const CheckItem& item, const std::string& uri, size_t artifact, const std::string& print, Rules& rules) {
  // Services show results at lines; a mesh has none.
  const Json location{{"physicalLocation",
                       {{"artifactLocation", {{"uri", uri}, {"index", artifact}}}, {"region", {{"startLine", 1}}}}}};
  Json result{{"ruleId", item.kind},
              {"ruleIndex", rules.indexOf(item.kind)},
              {"level", levelOf(item)},
              {"message", {{"text", item.message}}},
              {"locations", Json::array({location})},
              {"partialFingerprints", {{"place/v1", print}}}};
  if (item.finding.is_null()) return result;
  result["properties"] = item.finding;
  if (item.finding.value("isKnown", Json()) == true) result["baselineState"] = "unchanged";
  return result;
}

}  // namespace

std::string sarifOf(std::span<const MeshRecord> records) {
  Json artifacts = Json::array(), results = Json::array(), notifications = Json::array();
  Rules rules;
  for (const MeshRecord& record : records) {
    const std::string uri = uriOf(record.input);
    std::map<std::string, int> counts;
    for (const CheckItem& item : checkItemsOf(record)) {
      std::string print = fingerprintOf(item);
      if (const int count = ++counts[print]; count > 1) print += fmt::format("#{}", count);
      results.push_back(resultOf(item, uri, artifacts.size(), print, rules));
      if (item.finding.is_null())
        notifications.push_back({{"level", "error"}, {"message", {{"text", record.input + ": " + item.message}}}});
    }
    artifacts.push_back({{"location", {{"uri", uri}}}});
  }
  const bool isComplete = notifications.empty() && !records.empty();
  const Json run{
      {"tool", {{"driver", {{"name", "asdf-vk"}, {"version", ASDFVK_VERSION}, {"rules", rules.all()}}}}},
      {"invocations",
       Json::array({{{"executionSuccessful", isComplete}, {"toolExecutionNotifications", std::move(notifications)}}})},
      {"artifacts", std::move(artifacts)},
      {"results", std::move(results)},
      {"columnKind", "utf16CodeUnits"}};
  return jsonText({{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                   {"version", "2.1.0"},
                   {"runs", Json::array({run})}},
                  2) +
         "\n";
}

}  // namespace asdfvk
