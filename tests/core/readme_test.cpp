#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

std::string readDocument(const std::string& name) {
  std::ifstream in(std::string(ASDFVK_SOURCE_DIR) + "/" + name);
  REQUIRE_MESSAGE(in, name);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The text between the first `begin` and the next `end`.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const size_t from = text.find(begin);
  REQUIRE_MESSAGE(from != std::string::npos, begin);
  const size_t to = text.find(end, from + begin.size());
  REQUIRE_MESSAGE(to != std::string::npos, end);
  return text.substr(from + begin.size(), to - from - begin.size());
}

/// Each line without its first `width` characters, which must be blank.
std::string unindented(const std::string& text, size_t width) {
  std::string result;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string line = text.substr(begin, end - begin);
    const size_t blank = std::min(width, line.find_first_not_of(' '));
    result += line.substr(blank);
    begin = end;
  }
  return result;
}

/// The files and folders of the repository that a page names between backticks: those that begin with a known folder
/// and have no placeholder in capitals.
std::vector<std::string> namedPaths(const std::string& page) {
  std::vector<std::string> paths;
  for (size_t begin = page.find('`'); begin != std::string::npos;) {
    const size_t end = page.find('`', begin + 1);
    if (end == std::string::npos) break;
    const std::string word = page.substr(begin + 1, end - begin - 1);
    const std::string top = word.substr(0, word.find('/'));
    const bool isOurs = top == "src" || top == "shaders" || top == "include" || top == "tests" || top == "docs" ||
                        top == "bench" || top == "scripts";
    const bool hasPlaceholder = std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c); });
    if (isOurs && !hasPlaceholder && word.find(' ') == std::string::npos) paths.push_back(word);
    begin = page.find('`', end + 1);
  }
  return paths;
}

}  // namespace

TEST_CASE("the C++ example of README.md is the code that the tests of consumers compile") {
  const std::string file = readDocument("tests/consumer/readme_example.cpp");
  CHECK(between(readDocument("README.md"), "```cpp\n", "```") ==
        unindented(between(file, "  // [README]\n", "  // [README]"), 2));
}

TEST_CASE("the example of docs/c.md is the code that the tests of consumers compile") {
  const std::string file = readDocument("tests/consumer/c_example.c");
  CHECK(between(readDocument("docs/c.md"), "```c\n", "```") == file.substr(file.find('\n') + 1));
}

TEST_CASE("files that the pages name exist") {
  const std::filesystem::path root(ASDFVK_SOURCE_DIR);
  std::vector<std::string> pages{"README.md", "CONTRIBUTING.md"};
  for (const auto& entry : std::filesystem::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") pages.push_back("docs/" + entry.path().filename().string());
  for (const std::string& page : pages) {
    for (const std::string& path : namedPaths(readDocument(page))) {
      INFO(page, " names ", path);
      CHECK(std::filesystem::exists(root / path));
    }
  }
}

TEST_CASE("paths are found between backticks") {
  CHECK(namedPaths("`src/a.h` and `scripts/fuzz SECONDS`, `src/NAME.cpp`, `mesh.ply`, `docs/x.md`") ==
        std::vector<std::string>{"src/a.h", "docs/x.md"});
}
