#include "paper/page.h"

#include <fmt/format.h>

#include "paper/plots/markup.h"

namespace asdfvk::bench {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { margin: 0 auto; padding: 2.5rem 1.5rem 5rem; max-width: 72rem; background: #fff; color: #222;
  font: 16px/1.55 Charter, "Bitstream Charter", "Sitka Text", Cambria, Georgia, serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 1.2rem; }
h2 { font-size: 1.3rem; margin: 3.2rem 0 .6rem; padding-top: .8rem; border-top: 1px solid #ccc; }
p { max-width: 46rem; margin: .6rem 0; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .15rem 1.2rem; font-size: .9rem; margin: 0; }
dt { color: #666; }
dd { margin: 0; overflow-wrap: anywhere; }
.table { overflow-x: auto; margin: 1.2rem 0 .3rem; }
table { border-collapse: collapse; font-size: .86rem; font-variant-numeric: tabular-nums lining-nums;
  border-top: 2px solid #222; border-bottom: 2px solid #222; }
th, td { padding: .22rem .6rem; text-align: left; white-space: nowrap; }
th { font-weight: 600; vertical-align: bottom; }
th.group { text-align: center; border-bottom: 1px solid #888; }
thead tr:last-child th { border-bottom: 1px solid #222; }
th.first, td.first { padding-left: 1.9rem; }
th.number, td.number { text-align: right; }
.quoted { color: #8a4b00; background: #fdf6ec; }
figure { margin: 1.6rem 0; }
.images { display: grid; gap: 1.1rem 1.4rem; }
.images.columns6 { grid-template-columns: repeat(6, 1fr); width: min(96vw, 110rem); margin-left: 50%;
  transform: translateX(-50%); gap: .8rem; }
.images.columns3 { grid-template-columns: repeat(3, 1fr); }
.images.columns2 { grid-template-columns: repeat(2, 1fr); }
.images.columns1 { grid-template-columns: minmax(0, 46rem); }
.images img { display: block; width: 100%; height: auto; }
.images div { font-size: .86rem; line-height: 1.35; text-align: center; align-self: start; }
figcaption { max-width: 56rem; margin-top: .7rem; font-size: .92rem; }
a { color: #0b5cad; }
@media (max-width: 80rem) { .images.columns6 { grid-template-columns: repeat(3, 1fr); } }
@media (max-width: 40rem) { .images.columns6, .images.columns3, .images.columns2 { grid-template-columns: 1fr; } }
@media print { h2 { break-after: avoid; } figure, .table { break-inside: avoid; } }
)";

std::string linkTo(const std::string& csvFile) {
  return csvFile.empty() ? "" : fmt::format(" <a href=\"{0}\">{0}</a>", escapeMarkup(csvFile));
}

std::string captionOf(const std::string& label, const std::string& caption, const std::string& csvFile) {
  const std::string start = label.empty() ? "" : "<b>" + escapeMarkup(label) + ".</b> ";
  return "<figcaption>" + start + escapeMarkup(caption) + linkTo(csvFile) + "</figcaption>\n";
}

}  // namespace

void Page::facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  body_ += "<dl>\n";
  for (const auto& [name, value] : facts)
    body_ += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escapeMarkup(name), escapeMarkup(value));
  body_ += "</dl>\n";
}

void Page::heading(const std::string& text) { body_ += "<h2>" + escapeMarkup(text) + "</h2>\n"; }

void Page::paragraph(const std::string& text) { body_ += "<p>" + escapeMarkup(text) + "</p>\n"; }

void Page::table(const Table& table, const std::string& caption, const std::string& csvFile) {
  body_ += "<figure>\n<div class=\"table\">\n" + toHtml(table) + "</div>\n" + captionOf("", caption, csvFile) +
           "</figure>\n";
}

void Page::figure(const std::vector<PageImage>& images, int columnCount, const std::string& label,
                  const std::string& caption, const std::string& csvFile) {
  body_ += fmt::format("<figure>\n<div class=\"images columns{}\">\n", columnCount);
  for (const PageImage& image : images)
    body_ += fmt::format("<div><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>{1}</div>\n", escapeMarkup(image.file),
                         escapeMarkup(image.caption));
  body_ += "</div>\n" + captionOf(label, caption, csvFile) + "</figure>\n";
}

std::string Page::html() const {
  const std::string title = escapeMarkup(title_);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         title + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" + title + "</h1>\n" + body_ +
         "</body>\n</html>\n";
}

}  // namespace asdfvk::bench
