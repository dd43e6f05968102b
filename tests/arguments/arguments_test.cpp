#include "arguments/arguments.h"

#include <doctest/doctest.h>

#include "asdf_vk/error.h"

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

ArgumentParser parserOf(Target& target) {
  const auto append = [&target](const std::string& name) {
    return [&target, name](const Argument::Values& values) {
      target.order += name + (values.empty() ? "" : "=" + values.front()) + " ";
    };
  };
  ArgumentParser parser(
      "odd", "Does odd things.", "odd 1.2",
      {{.names = "meshes",
        .placeholder = "MESH...",
        .text = "Meshes",
        .receive = [&target](const Argument::Values& values) { target.meshes = values; },
        .isList = true},
       {.names = "-f,--first", .placeholder = "off|on", .text = "First", .receive = append("first")},
       {.names = "--second", .placeholder = "NAME", .text = "Second", .receive = append("second"), .group = "Late"},
       {.names = "--count", .placeholder = "N", .text = "Count", .receive = into(target.count)},
       {.names = "--scale", .placeholder = "S", .text = "Scale", .receive = into(target.scale)},
       {.names = "--shift",
        .placeholder = "X Y Z",
        .text = "Shift",
        .receive = into(target.shift),
        .group = "Late",
        .valueCount = 3},
       {.names = "-q,--quiet", .text = "Quiet", .receive = into(target.isQuiet)},
       {.names = "-l,--loud", .text = "Loud", .receive = append("loud")},
       {.names = "--part",
        .placeholder = "a|b",
        .text = "Part",
        .receive = append("part"),
        .takesNext = [](const std::string& next) { return next == "a" || next == "b"; }},
       {.names = "--check", .placeholder = "[=N]", .text = "Check", .receive = append("check")}});
  parser.footer = "The end.";
  return parser;
}

struct Parsed {
  Target target;
  std::string answer, refusal;
};

Parsed parse(const std::vector<std::string>& arguments) {
  Parsed parsed;
  ArgumentParser parser = parserOf(parsed.target);
  try {
    parsed.answer = parser.parse(arguments);
  } catch (const Error& error) {
    parsed.refusal = error.what();
  }
  return parsed;
}

TEST_CASE("values reach their targets in the order in which the options were added") {
  const Parsed parsed = parse({"--loud", "--second=b", "a", "--shift", "1", "-2", "3.5", "--quiet", "-f", "x",
                               "--count", "12", "--scale", "0.5", "--", "--c"});
  const Target& target = parsed.target;
  CHECK_EQ(parsed.refusal, "");
  CHECK_EQ(parsed.answer, "");
  CHECK_EQ(target.order, "first=x second=b loud ");
  CHECK(target.meshes == std::vector<std::string>{"a", "--c"});
  CHECK_EQ(target.count, 12);
  CHECK_EQ(target.scale, 0.5);
  CHECK(target.shift == std::array<double, 3>{1, -2, 3.5});
  CHECK(target.isQuiet);
}

TEST_CASE("short options are joined, and their values attached") {
  CHECK_EQ(parse({"-lfx"}).target.order, "first=x loud ");
  CHECK(parse({"-lq"}).target.isQuiet);
  CHECK_EQ(parse({"-f", "-"}).target.order, "first=- ");
  CHECK_EQ(parse({"-qx"}).refusal, "-x is unknown; odd --help lists the options");
}

TEST_CASE("a value that is optional is attached, or the next argument where the option takes that") {
  CHECK_EQ(parse({"--check", "5", "--part", "a"}).target.order, "part=a check ");
  CHECK_EQ(parse({"--check=5", "--part", "c"}).target.order, "part check=5 ");
  CHECK(parse({"--part", "c"}).target.meshes == std::vector<std::string>{"c"});
  CHECK_EQ(parse({"--part"}).target.order, "part ");
}

TEST_CASE("positional arguments are taken as they are") {
  CHECK(parse({"[a]", "-", "b=c", "--", "--d=", "-e"}).target.meshes ==
        std::vector<std::string>{"[a]", "-", "b=c", "--d=", "-e"});
}

TEST_CASE("options are given or not") {
  Target target;
  ArgumentParser parser = parserOf(target);
  CHECK_EQ(parser.parse({"--count=3"}), "");
  CHECK(parser.isGiven("--count"));
  CHECK_FALSE(parser.isGiven("--first"));
  CHECK(parser.givenNames() == std::vector<std::string>{"--count"});
}

TEST_CASE("arguments that do not fit are refused with the reason") {
  CHECK_EQ(parse({"--odd"}).refusal, "--odd is unknown; odd --help lists the options");
  CHECK_EQ(parse({"--frist", "x"}).refusal, "--frist is unknown; did you mean --first?");
  CHECK_EQ(parse({"--count", "x"}).refusal, "--count: 'x' is not a whole number");
  CHECK_EQ(parse({"--scale", ""}).refusal, "--scale: '' is not a number");
  CHECK_EQ(parse({"--shift", "1", "2"}).refusal, "--shift takes exactly 3 values, once");
  CHECK_EQ(parse({"--quiet=yes"}).refusal, "--quiet takes no value");
  CHECK_EQ(parse({"-q=yes"}).refusal, "-q=yes: -q takes no value");
  CHECK_EQ(parse({"-lq=", "-f", "x"}).refusal, "-lq=: -q takes no value");
  CHECK_EQ(parse({"-=x"}).refusal, "-=x is unknown; odd --help lists the options");
  CHECK_EQ(parse({"--second=", "b"}).refusal, "--second= has no value");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--first"}, {"-f", "x", "-f", "y"}})
    CHECK_EQ(parse(arguments).refusal, "--first takes exactly one value, once");
}

TEST_CASE("a required argument that is missing is refused, and a further one") {
  std::string log;
  const auto parserOfOne = [&log] {
    return ArgumentParser(
        "odd", "", "",
        {{.names = "log", .placeholder = "LOG", .text = "Log", .receive = into(log), .isRequired = true}});
  };
  CHECK_THROWS_WITH_AS((void)parserOfOne().parse({}), "log is missing; odd --help lists the options", Error);
  CHECK_THROWS_WITH_AS((void)parserOfOne().parse({"a", "b"}), "'b' is one argument too many", Error);
}

TEST_CASE("help and version are answers, whatever else is given") {
  CHECK_EQ(parse({"--version"}).answer, "odd 1.2\n");
  const std::string help = parse({"-h", "--odd"}).answer;
  CHECK(help.starts_with("Does odd things.\nUsage: odd [OPTIONS] MESH...\n"));
  CHECK(help.find("\n  -f,--first off|on\n      First\n") != std::string::npos);
  CHECK(help.find("\nLate:\n") < help.find("--second NAME"));
  CHECK(help.ends_with("The end.\n"));
  CHECK_EQ(parse({"--help=some"}).refusal, "--help: 'some' is not 'all'; write --help or --help=all");
  Target target;
  ArgumentParser parser = parserOf(target);
  parser.shortHelp = "Short.\n";
  CHECK_EQ(parser.parse({"--help"}), "Short.\n");
}

}  // namespace
}  // namespace asdfvk
