#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "cli/report_text.h"

namespace asdfvk {
namespace {

using Json = nlohmann::json;

/// A part of 60 x 10 x 5 whose least thickness is 1, in the middle of face 3.
Result soundResult(std::optional<double> limit) {
  Result result;
  result.report.size = {60, 10, 5};
  ThicknessReport& thickness = result.report.thickness.emplace();
  thickness.min = 1;
  thickness.minFace = 3;
  thickness.minPlace = {1, 2, 3};
  thickness.minOpposite = {1, 2, 4};
  thickness.percentile1 = 1.1;
  thickness.percentile5 = thickness.median = thickness.percentile95 = 2;
  thickness.max = 4;
  thickness.greatestSection = SectionBall{4, {30, 5, 2.5}};
  thickness.thinnerThan = limit;
  if (limit) thickness.verdict = *limit > 1 ? ThicknessVerdict::Failed : ThicknessVerdict::Passed;
  return result;
}

const std::string kPart = "part.stl", kPartOutput = "part.ply";
const CommandLine kDefaults;

MeshOutcome outcomeOf(const Result& result, const Outputs& outputs) {
  return {kPart, kPartOutput, kDefaults.computation, kDefaults.session, kDefaults.others, outputs, result};
}

std::string textOf(const Result& result) {
  Outputs outputs;
  outputs.verbose = true;
  return textReport(outcomeOf(result, outputs));
}

Json jsonOf(const Result& result) {
  return Json::parse(jsonReport(outcomeOf(result, kDefaults.outputs))).at("thickness");
}

void checkHolds(const std::string& text, const std::string& part) {
  CHECK_MESSAGE(text.find(part) != std::string::npos, text);
}

ThinRegion regionOf(ThinKind kind, double min) {
  return {.kind = kind,
          .min = min,
          .minFace = 3,
          .place = {1, 2, 3},
          .opposite = {1, 2, 4},
          .least = min,
          .faceCount = 2,
          .area = 12.5,
          .areaShare = 0.02};
}

TEST_CASE("the first line is the verdict with the limit, the least wall and its place") {
  CHECK(textOf(soundResult(0.8))
            .starts_with("part.stl: PASS: no wall thinner than 0.8; the next is 1 at (1, 2, 3), face 3\n"));
  CHECK(textOf(soundResult({})).starts_with("part.stl: least wall 1 at (1, 2, 3), face 3\n"));
  Result result = soundResult(1.5);
  ThicknessReport& thickness = *result.report.thickness;
  thickness.regions = {regionOf(ThinKind::Wall, 1)};
  CHECK(textOf(result).starts_with("part.stl: FAIL: 1 wall thinner than 1.5: 1 at (1, 2, 3), face 3\n"));
  thickness.regions = {regionOf(ThinKind::Wall, 1), regionOf(ThinKind::Wall, 1.25), regionOf(ThinKind::Detail, 0.5),
                       regionOf(ThinKind::Edge, 0)};
  CHECK(verdictSentence(thickness) == "FAIL: 2 walls thinner than 1.5: 1 at (1, 2, 3), face 3");
  CHECK(verdictSentence(thickness, false) == "FAIL: 2 walls thinner than 1.5: 1");
  thickness.countsDetails = true;
  CHECK(verdictSentence(thickness, false) == "FAIL: 2 walls and 1 detail thinner than 1.5: 1");
  thickness.countsEdges = true;
  CHECK(verdictSentence(thickness, false) == "FAIL: 2 walls, 1 detail and 1 edge thinner than 1.5: 1");
}

TEST_CASE("a verdict other than FAIL has the details and edges that do not count") {
  Result result = soundResult(0.8);
  ThicknessReport& thickness = *result.report.thickness;
  thickness.regions = {regionOf(ThinKind::Detail, 0.5), regionOf(ThinKind::Detail, 0.6), regionOf(ThinKind::Edge, 0)};
  const std::string others = "2 details (least 0.5) and 1 edge not counted";
  CHECK(verdictSentence(thickness) == "PASS: no wall thinner than 0.8; the next is 1 at (1, 2, 3), face 3; " + others);
  thickness.min = kNoValue;
  CHECK(verdictSentence(thickness) == "PASS: no wall thinner than 0.8; " + others);
  thickness.verdict = ThicknessVerdict::NotJudged;
  CHECK(verdictSentence(thickness) == "NOT JUDGED: no wall thinner than 0.8 was found; " + others);
  thickness = {.verdict = ThicknessVerdict::Passed, .thinnerThan = 0.8, .countsEdges = true};
  CHECK(verdictSentence(thickness) == "PASS: nowhere thinner than 0.8");
  thickness = {};
  CHECK(verdictSentence(thickness) == "no thickness");
}

TEST_CASE("what is not judged is named, also where the verdict is another one") {
  Result result = soundResult(0.8);
  ThicknessReport& thickness = *result.report.thickness;
  thickness.unjudged = {.degenerateCount = 2, .crossedCount = 3};
  thickness.unjudged.reasons = {
      {.cause = UnjudgedCause::Border, .faceCount = 1200, .edgeCount = 8, .face = 4, .place = {1, 2, 3}},
      {.cause = UnjudgedCause::Branching, .faceCount = 22, .edgeCount = 4, .face = 6, .place = {1, 2, 3}},
      {.cause = UnjudgedCause::WoundAgainst, .faceCount = 12, .edgeCount = 1, .face = 7, .isRepairable = true},
      {.cause = UnjudgedCause::WoundAgainst, .faceCount = 12, .edgeCount = 3, .face = 7},
      {.cause = UnjudgedCause::Inverted, .faceCount = 1, .isRepairable = true},
      {.cause = UnjudgedCause::DoubleSided, .faceCount = 2, .face = 5},
      {.cause = UnjudgedCause::NegativeVolumes, .faceCount = 12, .amount = 1},
      {.cause = UnjudgedCause::CoarseCoordinates, .faceCount = 12, .amount = 0.5}};
  const auto checkSentences = [&] {
    const std::string text = textOf(result);
    checkHolds(text,
               "\n  unjudged  1,200 faces of open components: 8 edges have one face, the first at (1, 2, 3), face 4; "
               "close the mesh, a wall may be missing\n");
    checkHolds(text, "\n            22 faces of ambiguous components: 4 edges have three faces or more");
    checkHolds(
        text,
        "\n            12 faces of components with faces wound against each other: 1 edge, the first at (0, 0, 0), "
        "face 7; --orient auto reverses them\n");
    checkHolds(text,
               ": 3 edges, the first at (0, 0, 0), face 7; the surface has no consistent orientation, repair it\n");
    checkHolds(text,
               "\n            1 face of components oriented inwards, the first at (0, 0, 0), face 0; --orient auto ");
    checkHolds(text, "\n            2 faces have a copy that is wound the other way, the first at (0, 0, 0), face 5");
    checkHolds(text,
               "\n            12 faces: 1 negative volume of the file was not subtracted; subtract it in the program");
    checkHolds(text, "\n            12 faces: the coordinates have steps of 0.5, more than a quarter of the limit");
    checkHolds(text, "\n            2 degenerate faces left out");
    checkHolds(text, "\n            3 faces crossed by other faces: judged in pieces");
  };
  checkSentences();
  thickness.verdict = ThicknessVerdict::Failed;
  checkSentences();
  thickness.verdict = ThicknessVerdict::NotJudged;
  checkSentences();
  CHECK(textOf(result).starts_with("part.stl: NOT JUDGED: no wall thinner than 0.8 was found\n"));
}

TEST_CASE("size, walls, details, edges, greatest section and percentiles follow, five of a list") {
  Result result = soundResult(1.5);
  ThicknessReport& thickness = *result.report.thickness;
  thickness.regions.assign(6, regionOf(ThinKind::Wall, 1));
  thickness.regions[0].least = 0.75;
  thickness.regions.push_back(regionOf(ThinKind::Detail, 0.5));
  thickness.regions.push_back({.kind = ThinKind::Edge,
                               .minFace = 7,
                               .place = {0, 0, 5},
                               .angleDegrees = 30,
                               .width = 2.5,
                               .faceCount = 1,
                               .area = 0.5,
                               .areaShare = 0.001});
  thickness.thinArea = 39;
  thickness.thinAreaShare = 0.063;
  const std::string wall = "            wall 1 from (1, 2, 3) to (1, 2, 4), face 3; 2 faces, area 12.5 (2 %)\n";
  checkHolds(textOf(result),
             "\n  size      60 x 10 x 5, bounding box in the unit of the mesh\n"
             "  thin      area 39 (6.3 %) below 1.5\n"
             "  walls     6 walls\n"
             "            wall 1 from (1, 2, 3) to (1, 2, 4), face 3, 0.75 beside it; 2 faces, area 12.5 (2 %)\n" +
                 wall + wall + wall + wall +
                 "            and 1 more; --json has all\n"
                 "  details   1 detail, not counted\n"
                 "            detail 0.5 from (1, 2, 3) to (1, 2, 4), face 3; 2 faces, area 12.5 (2 %)\n"
                 "  edges     1 edge, not counted\n"
                 "            edge of 30 degrees, thin over 2.5, 0 at (0, 0, 5), face 7; 1 face, area 0.5 (0.1 %)\n"
                 "  section   4, the diameter of the largest ball found inside, centre (30, 5, 2.5)\n"
                 "  thickness by area p1 1.1, p5 2, p50 2, p95 2, max 4\n"
                 "  mesh      ");
  thickness.countsEdges = true;
  checkHolds(textOf(result), "\n  details   1 detail\n");
  checkHolds(textOf(result), "\n  edges     1 edge\n");
}

TEST_CASE("the unit is asked for if nearly everything is thin and the file states none") {
  Result result = soundResult(1.5);
  ThicknessReport& thickness = *result.report.thickness;
  thickness.regions = {regionOf(ThinKind::Wall, 1)};
  const std::string question = "the part is 60 x 10 x 5: inches or metres?";
  thickness.thinAreaShare = 0.89;
  CHECK(unitQuestion(result.report).empty());
  thickness.thinAreaShare = 0.9;
  CHECK(unitQuestion(result.report) == question);
  const std::string text = textReport(outcomeOf(result, kDefaults.outputs));
  checkHolds(text, "\n  unit      " + question + "\n");
  CHECK(text.find("\n  mesh ") == std::string::npos);  // At most six lines.
  checkHolds(textOf(result), "face 3\n  unit      " + question + "\n");
  result.report.unit = "mm";
  CHECK(unitQuestion(result.report).empty());
}

TEST_CASE("the short report has the diameter and its error if they were computed and there is room") {
  Result result = soundResult(0.8);
  Report& report = result.report;
  const auto titles = [&] {
    const std::string text = textReport(outcomeOf(result, kDefaults.outputs));
    std::string found;
    for (size_t end = text.find('\n'); end + 1 < text.size(); end = text.find('\n', end + 1))
      found += text.substr(end + 3, text.find(' ', end + 3) - end - 3) + " ";
    return found;
  };
  CHECK_EQ(titles(), "thickness mesh output ");
  report.seedCount = 100;
  report.sdf = {.min = 0.5, .median = 1.5, .max = 2.5};
  report.estimatedError = ErrorEstimate{.average = 0.01};
  CHECK_EQ(titles(), "thickness mesh diameter error output ");
  checkHolds(textReport(outcomeOf(result, kDefaults.outputs)),
             "\n  diameter  0.5 to 2.5, median 1.5\n  error     about 1 % of the range on average\n");
  report.segmentCount = 3;
  CHECK_EQ(titles(), "thickness mesh diameter segments output ");
  report.check = CheckReport{.passed = true, .tracedCount = 2000, .agreeingCount = 2000, .comparedCount = 2000};
  CHECK_EQ(titles(), "thickness mesh segments error output ");
  report.segmentCount.reset();
  CHECK_EQ(titles(), "thickness mesh diameter error output ");
  report.check.reset();
  report.thickness->unjudged.reasons.resize(2);
  CHECK_EQ(titles(), "unjudged thickness mesh diameter output ");
  report.segmentCount = 3;
  CHECK_EQ(titles(), "unjudged thickness mesh segments output ");
}

TEST_CASE("the document has every value of the thickness") {
  Result result = soundResult(1.5);
  ThicknessReport& thickness = *result.report.thickness;
  thickness.regions = {regionOf(ThinKind::Wall, 1)};
  thickness.regions[0].least = 0.5;
  thickness.regions[0].angleDegrees = 5;
  thickness.regions[0].width = 2;
  thickness.countsDetails = true;
  thickness.sentence = "a sentence";
  thickness.unjudged = {.openCount = 1, .invertedCount = 2, .degenerateCount = 3, .crossedCount = 4, .insideCount = 5};
  thickness.unjudged.reasons = {{.cause = UnjudgedCause::WoundAgainst,
                                 .faceCount = 5,
                                 .edgeCount = 6,
                                 .face = 7,
                                 .place = {1, 2, 3},
                                 .isRepairable = true}};
  const Json json = jsonOf(result);
  CHECK_EQ(json.at("verdict"), "failed");
  CHECK_EQ(json.at("min"), 1);
  CHECK_EQ(json.at("minFace"), 3);
  CHECK_EQ(json.at("minPlace"), Json({1, 2, 3}));
  CHECK_EQ(json.at("minOpposite"), Json({1, 2, 4}));
  CHECK_EQ(json.at("greatestSection"), Json::parse(R"({"diameter": 4, "centre": [30, 5, 2.5]})"));
  CHECK_EQ(json.at("sentence"), "a sentence");
  CHECK_EQ(json.at("countsDetails"), true);
  CHECK_EQ(json.at("countsEdges"), false);
  CHECK_EQ(json.at("regions"), Json::parse(R"([{"kind": "wall", "min": 1, "minFace": 3, "place": [1, 2, 3],
      "opposite": [1, 2, 4], "oppositeFace": null, "bodies": [], "least": 0.5, "angleDegrees": 5, "width": 2, "faceCount": 2, "area": 12.5,
      "areaShare": 0.02, "change": null, "changedPlace": null}])"));
  CHECK_EQ(json.at("unjudged"), Json::parse(R"({"openCount": 1, "invertedCount": 2, "degenerateCount": 3,
      "crossedCount": 4, "insideCount": 5, "reasons": [{"cause": "woundAgainst", "faceCount": 5, "edgeCount": 6,
      "face": 7, "place": [1, 2, 3], "bodies": [], "isRepairable": true, "amount": 0}]})"));
  thickness = {};
  for (const char* key : {"verdict", "min", "minFace", "minPlace", "minOpposite", "greatestSection", "thinArea"})
    CHECK_MESSAGE(jsonOf(result).at(key).is_null(), key);
  CHECK(jsonOf(result).at("regions").empty());
}

}  // namespace
}  // namespace asdfvk
