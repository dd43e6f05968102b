#include "paper/plots/table.h"

#include <doctest/doctest.h>

#include "mesh/mesh.h"
#include "paper/plots/file_stems.h"

namespace asdfvk::bench {
namespace {

Table sample() {
  Table table;
  table.columns = {{"", "mesh"}, {"average", "printed", true}, {"average", "ours"}, {"", "faces"}};
  table.rows = {{Cell::word("a, \"b\" <c>"), Cell::number(0.0272, 4), Cell::number(1.0 / 3, 2), Cell::count(96966)},
                {Cell::word("d"), Cell::number(kNoValue, 4), Cell::number(0, 2), Cell::count(1)}};
  return table;
}

TEST_CASE("CSV has exact numbers, quotes what it must and leaves missing ones empty") {
  CHECK_EQ(toCsv(sample()),
           "mesh,average: printed,average: ours,faces\n"
           "\"a, \"\"b\"\" <c>\",0.0272,0.3333333333333333,96966\n"
           "d,,0,1\n");
}

TEST_CASE("HTML escapes, rounds, and heads groups of columns together") {
  const std::string html = toHtml(sample());
  CHECK_NE(html.find("<td>a, &quot;b&quot; &lt;c&gt;</td>"), std::string::npos);
  CHECK_NE(html.find("<th colspan=\"1\"></th><th colspan=\"2\" class=group>average</th><th colspan=\"1\"></th>"),
           std::string::npos);
  CHECK_NE(html.find("<td class=\"number quoted first\">0.0272</td><td class=\"number\">0.33</td>"), std::string::npos);
  CHECK_NE(html.find("<td class=\"number first\">96,966</td>"), std::string::npos);
  CHECK_NE(html.find("<td class=\"number quoted first\"></td>"), std::string::npos);
}

TEST_CASE("without groups there is one row of headings") {
  Table table;
  table.columns = {{"", "a"}, {"", "b"}};
  CHECK_EQ(toHtml(table).find("colspan"), std::string::npos);
  CHECK_EQ(toCsv(table), "a,b\n");
}

TEST_CASE("names made from paths are plain and each is there once") {
  const std::vector<std::string> names = uniqueStems({"x/horse.off", "y/Horse.ply", "a b<.obj", "", "horse.obj"});
  CHECK_EQ(names, std::vector<std::string>{"horse", "Horse-2", "a_b_", "mesh", "horse-3"});
}

}  // namespace
}  // namespace asdfvk::bench
