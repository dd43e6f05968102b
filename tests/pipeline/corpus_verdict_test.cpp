// Verdicts on the parts of known truth (asdf-vk-generate --corpus).
#include <doctest/doctest.h>

#include <optional>
#include <utility>

#include "describe/report_text.h"
#include "generate/corpus.h"
#include "support/shared_session.h"

using namespace asdfvk;

namespace {

struct FoundAnswer {
  ThicknessVerdict verdict;
  std::optional<double> least;  ///< The least wall or gap; unset for other checks.
};

FoundAnswer answerOf(const Mesh& mesh, const KnownAnswer& asked) {
  Options options;
  ThicknessOptions& limits = options.thickness;
  const bool isOfSpace = asked.check == PartCheck::Closer || asked.check == PartCheck::Voids;
  options.measure = isOfSpace ? Measure::Gap : Measure::Thickness;
  if (asked.check == PartCheck::Closer) limits.closerThan = asked.limit;
  if (asked.check == PartCheck::Thinner) limits.thinnerThan = asked.limit;
  if (asked.check == PartCheck::Thicker) limits.thickerThan = asked.limit;
  const Report report = test::referenceSession().compute(mesh, options).report;
  if (asked.check == PartCheck::Voids) return {voidsVerdict(report).first, {}};
  if (asked.check == PartCheck::Thicker) return {report.thickness->thick->verdict, {}};
  const ThicknessReport& measured = isOfSpace ? *report.gap : *report.thickness;
  return {*measured.verdict, measured.min};
}

ThicknessVerdict verdictOf(PartVerdict verdict) {
  return verdict == PartVerdict::Pass   ? ThicknessVerdict::Passed
         : verdict == PartVerdict::Fail ? ThicknessVerdict::Failed
                                        : ThicknessVerdict::NotJudged;
}

}  // namespace

TEST_CASE("each part of known truth has its verdict, and a failure its least wall or gap") {
  for (const KnownPart& part : corpusParts())
    for (const KnownAnswer& known : part.answers) {
      CAPTURE(part.name);
      CAPTURE(known.limit);
      const FoundAnswer found = answerOf(part.mesh, known);
      CHECK(found.verdict == verdictOf(known.verdict));
      if (known.verdict == PartVerdict::Fail && known.value && found.least)
        CHECK(*found.least == doctest::Approx(*known.value).epsilon(2e-3));
    }
}
