#include "describe/findings.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace asdfvk {
namespace {

ThinRegion regionOf(ThinKind kind, double min) {
  return {.kind = kind,
          .min = min,
          .minFace = 4,
          .place = {1, 2, 3},
          .opposite = {1, 2, 4},
          .oppositeFace = 7,
          .bodies = {"lid"},
          .faceCount = 5};
}

Report reportOf(ThicknessVerdict verdict, bool isOfGaps) {
  Report report;
  ThicknessReport& of = isOfGaps ? report.gap.emplace() : report.thickness.emplace();
  of.isOfGaps = isOfGaps;
  of.verdict = verdict;
  of.thinnerThan = 0.8;
  of.regions = {regionOf(isOfGaps ? ThinKind::Gap : ThinKind::Wall, 0.5), regionOf(ThinKind::Detail, 0.4),
                regionOf(ThinKind::Edge, 0)};
  return report;
}

std::vector<FindingKind> kindsOf(const std::vector<Finding>& findings) {
  std::vector<FindingKind> kinds;
  for (const Finding& finding : findings) kinds.push_back(finding.kind);
  return kinds;
}

using Kinds = std::vector<FindingKind>;

TEST_CASE("each place that counts is a finding, with measure, limit, place and remedy") {
  Report report = reportOf(ThicknessVerdict::Failed, false);
  std::vector<Finding> findings = findingsOf(report);
  REQUIRE_EQ(findings.size(), 1);
  const Finding& wall = findings[0];
  CHECK(wall.kind == FindingKind::ThinWall);
  CHECK(wall.level == FindingLevel::Failure);
  CHECK_EQ(wall.value, 0.5);
  CHECK_EQ(*wall.limit, 0.8);
  CHECK_EQ(*wall.face, 4);
  CHECK_EQ(*wall.oppositeFace, 7);
  CHECK_EQ(wall.faceCount, 5);
  CHECK_EQ(wall.message, "wall of 0.5, below the limit 0.8, at (1, 2, 3), face 4, in lid");
  CHECK_EQ(wall.remedy, "make the wall at least 0.8 thick: move one of its surfaces outwards by 0.3");
  report.thickness->countsDetails = true;
  CHECK(kindsOf(findingsOf(report)) == Kinds{FindingKind::ThinWall, FindingKind::ThinDetail});
  report.thickness->countsEdges = true;
  CHECK(kindsOf(findingsOf(report)) == Kinds{FindingKind::ThinWall, FindingKind::ThinDetail, FindingKind::ThinEdge});
  CHECK(kindsOf(findingsOf(reportOf(ThicknessVerdict::Failed, true))) == Kinds{FindingKind::NarrowGap});
  report.thickness->thinnerThan.reset();
  CHECK(findingsOf(report).empty());
  CHECK(findingsOf({}).empty());
}

TEST_CASE("without a certain verdict a place is not judged, and a cause is a finding") {
  Report report = reportOf(ThicknessVerdict::NotJudged, false);
  report.thickness->unjudged.reasons = {
      {.cause = UnjudgedCause::Border, .faceCount = 12, .edgeCount = 4, .face = 3, .place = {5, 6, 7}},
      {.cause = UnjudgedCause::CoarseCoordinates, .faceCount = 12, .amount = 0.5}};
  const std::vector<Finding> findings = findingsOf(report);
  REQUIRE_EQ(findings.size(), 3);
  for (const Finding& finding : findings) CHECK(finding.level == FindingLevel::NotJudged);
  CHECK_EQ(findings[1].remedy, "close the mesh, a wall may be missing");
  CHECK_EQ(*findings[1].face, 3);
  CHECK_FALSE(findings[2].place);
  report.thickness->verdict.reset();
  report.thickness->thinnerThan.reset();
  CHECK(findingsOf(report).at(0).level == FindingLevel::Note);
}

TEST_CASE("with a former version, only new and thinner places fail") {
  Report report = reportOf(ThicknessVerdict::Failed, false);
  report.thickness->regions = {regionOf(ThinKind::Wall, 0.5), regionOf(ThinKind::Wall, 0.6)};
  report.thickness->regions[0].change = WallChange::Kept;
  report.thickness->regions[1].change = WallChange::New;
  report.comparison.emplace().verdict = ThicknessVerdict::Failed;
  const std::vector<Finding> findings = findingsOf(report);
  CHECK(findings.at(0).level == FindingLevel::Note);
  CHECK(findings.at(1).level == FindingLevel::Failure);
  CHECK(findings.at(1).message.starts_with("new wall of 0.6"));
}

TEST_CASE("thick bodies fail; sealed voids and contacts fail only where they are checked") {
  Report report;
  report.thickness.emplace().thick = ThickReport{.thickerThan = 4, .verdict = ThicknessVerdict::Failed};
  report.thickness->thick->bodies = {{{}, 5, {1, 1, 1}}};
  report.gap.emplace();
  report.voids = {{.volume = 2, .face = 1}, {.volume = 3, .face = 2, .isCertain = false}};
  report.contacts = {{{"lid", "base"}}};
  const auto levelsOf = [&](CheckedSpaces checked) {
    std::vector<FindingLevel> levels;
    for (const Finding& finding : findingsOf(report, checked)) levels.push_back(finding.level);
    return levels;
  };
  using Level = FindingLevel;
  CHECK(kindsOf(findingsOf(report)) ==
        Kinds{FindingKind::ThickBody, FindingKind::SealedVoid, FindingKind::SealedVoid, FindingKind::BodiesInContact});
  CHECK(levelsOf({}) == std::vector{Level::Failure, Level::Note, Level::Note, Level::Note});
  CHECK(levelsOf({.voids = true}) == std::vector{Level::Failure, Level::Failure, Level::NotJudged, Level::Note});
  CHECK(levelsOf({.contacts = true}) == std::vector{Level::Failure, Level::Note, Level::Note, Level::Failure});
}

}  // namespace
}  // namespace asdfvk
