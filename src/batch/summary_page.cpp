// The page of `asdf-vk summarize -o PAGE.html`.
#include <fmt/core.h>

#include <algorithm>

#include "batch/log_summary.h"
#include "core/html_text.h"
#include "core/text.h"

namespace asdfvk {
namespace {

constexpr size_t kListedMeshes = 200;

constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:64em;padding:0 1em;color:#222;background:#fff}"
    "table{border-collapse:collapse;margin:.5em 0 1.5em}td,th{text-align:left;padding:.15em .9em .15em 0;"
    "border-bottom:1px solid #ddd;vertical-align:top}td.n{text-align:right;font-variant-numeric:tabular-nums}"
    "pre{white-space:pre-wrap}svg{display:block;margin:.5em 0 1.5em}rect{fill:#31688e}"
    "text{font:12px system-ui,sans-serif;fill:#444}"
    "@media(prefers-color-scheme:dark){body{color:#ddd;background:#1b1b1b}td,th{border-color:#444}text{fill:#bbb}"
    "rect{fill:#6ca6cd}}";

/// Bars with the range of each as a tooltip; the axis is logarithmic.
std::string svgOf(const Histogram& histogram, double factor, const std::string& unit) {
  if (histogram.bins.empty()) return "<p>none</p>\n";
  constexpr int kBarWidth = 26, kHeight = 140, kLabels = 22;
  uint64_t most = 1;
  for (const Histogram::Bin& bin : histogram.bins) most = std::max(most, bin.count);
  const int width = kBarWidth * static_cast<int>(histogram.bins.size()) + 60;
  std::string svg = fmt::format("<svg width=\"{}\" height=\"{}\" role=\"img\">\n", width, kHeight + 2 * kLabels);
  for (size_t i = 0; i < histogram.bins.size(); ++i) {
    const Histogram::Bin& bin = histogram.bins[i];
    const int x = kBarWidth * static_cast<int>(i);
    const auto height =
        static_cast<int>(static_cast<double>(kHeight) * static_cast<double>(bin.count) / static_cast<double>(most));
    svg += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"><title>{:.3g} to {:.3g} {}: {}</title></rect>\n", x,
        kLabels + kHeight - height, kBarWidth - 2, height, factor * bin.from, factor * bin.to, unit,
        groupDigits(bin.count));
    if (bin.count > 0)
      svg +=
          fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, kLabels + kHeight - height - 4, groupDigits(bin.count));
    if (i % 3 == 0)
      svg += fmt::format("<text x=\"{}\" y=\"{}\">{:.2g} {}</text>\n", x, kHeight + 2 * kLabels - 6, factor * bin.from,
                         unit);
  }
  return svg + "</svg>\n";
}

template <typename Number>
std::string tableOf(const std::vector<std::pair<std::string, Number>>& rows) {
  std::string html = "<table>\n";
  for (const auto& [name, value] : rows)
    html += fmt::format("<tr><td>{}</td><td class=\"n\">{:.6g}</td></tr>\n", escapedForHtml(name),
                        static_cast<double>(value));
  return html + "</table>\n";
}

std::string failuresOf(const LogSummary& summary) {
  std::string html =
      "<table>\n<tr><th>status</th><th>code</th><th>error</th><th>meshes</th><th>for example</th></tr>\n";
  for (const FailureGroup& group : summary.failures)
    html +=
        fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td>{}</td><td class=\"n\">{}</td><td>{}: {}</td></tr>\n",
                    nameOf(group.status), group.code, escapedForHtml(group.error), groupDigits(group.count),
                    escapedForHtml(group.exampleInput), escapedForHtml(group.exampleMessage));
  html += "</table>\n<table>\n<tr><th>mesh</th><th>code</th><th>message</th></tr>\n";
  size_t count = 0;
  for (const MeshRecord& mesh : summary.meshes) {
    if (mesh.status == MeshStatus::Done || mesh.status == MeshStatus::Skipped || ++count > kListedMeshes) continue;
    html += fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td>{}</td></tr>\n", escapedForHtml(mesh.input),
                        mesh.code, escapedForHtml(mesh.message));
  }
  html += "</table>\n";
  if (count > kListedMeshes) html += fmt::format("<p>and {} more</p>\n", groupDigits(count - kListedMeshes));
  return html;
}

}  // namespace

std::string pageOf(const LogSummary& summary, const std::string& title) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head><body>\n<h1>{0}</h1>\n<pre>",
      escapedForHtml(title), kStyle);
  html += escapedForHtml(textOf(summary)) + "</pre>\n";
  html += "<h2>Time of each mesh</h2>\n" + svgOf(summary.secondsHistogram, 1, "s");
  html +=
      "<h2>Estimated average error of each mesh, share of its range</h2>\n" + svgOf(summary.errorHistogram, 100, "%");
  html += "<h2>Seconds by stage, all meshes</h2>\n" + tableOf(summary.stageSeconds);
  if (!summary.warnings.empty()) html += "<h2>Meshes by warning</h2>\n" + tableOf(summary.warnings);
  if (!summary.failures.empty()) html += "<h2>Failed and dropped meshes</h2>\n" + failuresOf(summary);
  return html + "</body></html>\n";
}

}  // namespace asdfvk
