#include "paper/plots/line_plot.h"

#include <doctest/doctest.h>

#include <cmath>
#include <regex>

#include "paper/plots/markup.h"

namespace asdfvk::bench {
namespace {

LinePlot sample(size_t seriesCount) {
  LinePlot plot{.title = "a & b", .x = {"share", 1, 100, true, {}}, .y = {"error", 0, 1, false, {}}, .series = {}};
  for (size_t i = 0; i < seriesCount; ++i)
    plot.series.push_back({"<line " + std::to_string(i) + ">", {{1, 0.9}, {10, 0.5}, {100, 0.1}}, seriesColour(i), i});
  return plot;
}

size_t countOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

struct Text {
  double x, y, width;
  std::string text, anchor;
  bool isTurned;
};

/// The texts of a document with where they stand.
std::vector<Text> textsOf(const std::string& svg) {
  const std::regex pattern(
      "<text x=\"([^\"]*)\" y=\"([^\"]*)\" text-anchor=\"([^\"]*)\" font-size=\"([^\"]*)\"[^>]*?( transform=[^>]*)?>"
      "([^<]*)</text>");
  std::vector<Text> texts;
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it) {
    const std::smatch& match = *it;
    const double width =
        roughTextWidth(std::regex_replace(match[6].str(), std::regex("&[a-z]+;"), "x"), std::stod(match[4]));
    const double shift = match[3] == "middle" ? width / 2 : match[3] == "end" ? width : 0;
    texts.push_back({std::stod(match[1]) - shift, std::stod(match[2]), width, match[6], match[3], match[5].matched});
  }
  return texts;
}

TEST_CASE("a plot is one document that names every series and escapes what it is told") {
  const std::string svg = toSvg(sample(4));
  CHECK_EQ(countOf(svg, "<svg "), 1);
  CHECK_EQ(countOf(svg, "</svg>"), 1);
  CHECK_NE(svg.find("<title>a &amp; b</title>"), std::string::npos);
  for (int i = 0; i < 4; ++i) CHECK_EQ(countOf(svg, "&lt;line " + std::to_string(i) + "&gt;</text>"), 1);
  CHECK_EQ(svg.find("<line 0>"), std::string::npos);
  CHECK_EQ(svg.find("nan"), std::string::npos);
  CHECK_EQ(countOf(svg, "<polyline "), 4);
  CHECK_EQ(countOf(svg, "<circle "), 3 + 1);  // The points of series 0 and its name's sample.
}

TEST_CASE("points off the axes and without a value are left out") {
  LinePlot plot = sample(1);
  plot.series[0].points = {{0, 0.5}, {1, std::nan("")}, {2, 2}, {10, 0.5}, {1000, 0.5}};
  const std::string svg = toSvg(plot);
  CHECK_EQ(countOf(svg, "<circle "), 1 + 1);
  CHECK_EQ(svg.find("nan"), std::string::npos);
  CHECK_EQ(svg.find("inf"), std::string::npos);
}

TEST_CASE("a point stands where the axes say") {
  LinePlot plot = sample(1);
  plot.series[0].points = {{1, 0}, {10, 0.5}, {100, 1}};
  const std::string svg = toSvg(plot);
  std::smatch match;
  REQUIRE(std::regex_search(svg, match, std::regex("polyline points=\"(\\S+),(\\S+) (\\S+),(\\S+) (\\S+),(\\S+)\"")));
  const auto at = [&](size_t i) { return std::stod(match[i]); };
  CHECK_LT(at(1), at(5));
  CHECK_GT(at(2), at(6));  // Upwards.
  CHECK_EQ(at(3), doctest::Approx((at(1) + at(5)) / 2).epsilon(1e-3));
  CHECK_EQ(at(4), doctest::Approx((at(2) + at(6)) / 2).epsilon(1e-3));
}

TEST_CASE("upright texts keep off each other and within the picture, however many series there are") {
  for (const size_t count : {1, 5, 30}) {
    const std::string svg = toSvg(sample(count));
    std::smatch size;
    REQUIRE(std::regex_search(svg, size, std::regex("width=\"(\\d+)\" height=\"(\\d+)\"")));
    const std::vector<Text> texts = textsOf(svg);
    CHECK_GE(texts.size(), count + 7 + 6 + 3);  // Names, ticks, labels of the axes and the title.
    for (size_t i = 0; i < texts.size(); ++i) {
      if (texts[i].isTurned) continue;
      CAPTURE(texts[i].text);
      CHECK_GE(texts[i].x, 0);
      CHECK_LE(texts[i].x + texts[i].width, std::stod(size[1]));
      CHECK_LE(texts[i].y, std::stod(size[2]));
      for (size_t j = 0; j < i; ++j) {
        if (texts[j].isTurned) continue;
        CAPTURE(texts[j].text);
        const bool isApart = texts[i].x >= texts[j].x + texts[j].width || texts[j].x >= texts[i].x + texts[i].width ||
                             std::abs(texts[i].y - texts[j].y) >= 11;
        CHECK(isApart);
      }
    }
  }
}

TEST_CASE("labels of the x axis are turned where they do not fit") {
  LinePlot plot = sample(1);
  plot.x = {"", -0.5, 7.5, false, {}};
  for (int i = 0; i < 8; ++i) plot.x.ticks.push_back({double(i), "a-rather-long-name"});
  CHECK_EQ(countOf(toSvg(plot), "rotate(-30"), 8);
  for (Tick& tick : plot.x.ticks) tick.label = "ab";
  CHECK_EQ(countOf(toSvg(plot), "rotate(-30"), 0);
}

}  // namespace
}  // namespace asdfvk::bench
