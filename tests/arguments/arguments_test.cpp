#include "arguments/arguments.h"

#include <doctest/doctest.h>

namespace asdfvk {
namespace {

/// What the options of a parser set.
struct Target {
  std::vector<std::string> meshes;
  std::string order;
  uint64_t count = 7;
  double scale = 1;
  std::array<double, 3> shift{};
  bool isQuiet = false;
};

void addOptions(ArgumentParser& parser, Target& target) {
  parser.setProgram("odd", "Does odd things.");
  parser.setFooter("The end.");
  parser.addVersion("odd 1.2");
  parser.addList("meshes", "MESH...", "Meshes", target.meshes);
  const Argument first = parser.addValue("-f,--first", "off|on", "First",
                                         [&target](const std::string& text) { target.order += "first=" + text + " "; });
  parser
      .addValue("--second", "NAME", "Second",
                [&target](const std::string& text) { target.order += "second=" + text + " "; })
      .group("Late")
      .needs(first)
      .completions("a|b");
  parser.addNumber("--count", "N", "Count", target.count);
  parser.addNumber("--scale", "S", "Scale", target.scale);
  parser.addNumbers("--shift", "X Y Z", "Shift", target.shift).group("Late");
  parser.addFlag("--quiet", target.isQuiet, "Quiet");
  parser.addFlag(
      "--loud", [&target] { target.order += "loud "; }, "Loud");
}

struct Parsed {
  Target target;
  ParseResult result;
};

Parsed parse(const std::vector<std::string>& arguments) {
  Parsed parsed;
  ArgumentParser parser;
  addOptions(parser, parsed.target);
  parsed.result = parser.parse(arguments);
  return parsed;
}

TEST_CASE("values reach their targets in the order in which the options were added") {
  const auto [target, result] = parse({"--loud", "--second=b", "a", "--shift", "1", "-2", "3.5", "--quiet", "-f", "x",
                                       "--count", "12", "--scale", "0.5", "--", "--c"});
  CHECK_EQ(result.refusal, "");
  CHECK_EQ(result.answer, "");
  CHECK_EQ(target.order, "first=x second=b loud ");
  CHECK(target.meshes == std::vector<std::string>{"a", "--c"});
  CHECK_EQ(target.count, 12);
  CHECK_EQ(target.scale, 0.5);
  CHECK(target.shift == std::array<double, 3>{1, -2, 3.5});
  CHECK(target.isQuiet);
}

TEST_CASE("options are given or not") {
  Target target;
  ArgumentParser parser;
  addOptions(parser, target);
  CHECK(parser.parse({"--count=3"}).refusal.empty());
  CHECK(parser.isGiven("--count"));
  CHECK_FALSE(parser.isGiven("--first"));
}

TEST_CASE("arguments that do not fit are refused with the reason") {
  CHECK_EQ(parse({"--odd"}).result.refusal, "The following argument was not expected: --odd");
  CHECK_EQ(parse({"--count", "x"}).result.refusal, "Could not convert: --count = x");
  CHECK_EQ(parse({"--second", "a"}).result.refusal, "--second requires --first");
  CHECK_EQ(parse({"--count", "x"}).result.miscounted, "");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--first"}, {"-f", "x", "-f", "y"}}) {
    const ParseResult result = parse(arguments).result;
    CHECK_EQ(result.miscounted, "--first");
    CHECK(result.refusal.starts_with("--first: "));
  }
}

TEST_CASE("a required argument that is missing is refused") {
  ArgumentParser parser;
  std::vector<std::string> logs;
  parser.addList("logs", "LOG...", "Logs", logs).require();
  CHECK_EQ(parser.parse({}).refusal, "logs is required");
}

TEST_CASE("help and version are answers") {
  CHECK_EQ(parse({"--version"}).result.answer, "odd 1.2\n");
  const std::string help = parse({"-h", "--odd"}).result.answer;
  CHECK(help.starts_with("Does odd things.\nUsage: odd [OPTIONS] [meshes...]\n"));
  CHECK(help.find("-f,--first off|on") != std::string::npos);
  CHECK(help.find("\nLate:\n") < help.find("--second NAME"));
  CHECK(help.ends_with("The end.\n"));
}

TEST_CASE("the help of one group omits the others; messages still name their options") {
  Target target;
  ArgumentParser parser;
  addOptions(parser, target);
  parser.setHelpGroup("Options");
  CHECK_EQ(parser.parse({"--second", "a"}).refusal, "--second requires --first");
  CHECK(parser.help().find("--count") != std::string::npos);
  CHECK(parser.help().find("--second") == std::string::npos);
  CHECK(parser.help().find("MESH...") != std::string::npos);
}

TEST_CASE("a parser describes its arguments in the order of the help") {
  Target target;
  ArgumentParser parser;
  addOptions(parser, target);
  const std::vector<ArgumentDescription> all = parser.describe();
  REQUIRE_EQ(all.size(), 10);
  CHECK(all[0].names.empty());
  CHECK_EQ(all[0].valueCount, 1);
  CHECK(all[1].names == std::vector<std::string>{"-h", "--help"});
  CHECK(all[3].names == std::vector<std::string>{"-f", "--first"});
  CHECK_EQ(all[3].placeholder, "off|on");
  CHECK_EQ(all[6].valueCount, 0);
  const ArgumentDescription& second = all[8];
  CHECK(second.names == std::vector<std::string>{"--second"});
  CHECK_EQ(second.completions, "a|b");
  CHECK_EQ(second.group, "Late");
  CHECK_EQ(second.text, "Second");
  CHECK(second.needs == std::vector<std::string>{"--first"});
  CHECK_FALSE(second.isRequired);
  CHECK_EQ(all[9].valueCount, 3);
}

}  // namespace
}  // namespace asdfvk
