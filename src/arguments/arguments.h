#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Command lines of the programs. CLI11, which compiles slowly, is in arguments.cpp only.
namespace asdfvk {

/// An option or a positional argument, as documents describe it.
struct ArgumentDescription {
  std::vector<std::string> names;  ///< "-o", "--output"; none for a positional argument.
  std::string placeholder;         ///< Stands for the value in the help.
  std::string completions;         ///< Set by Argument::completions(); otherwise the type of the value.
  uint32_t valueCount = 0;         ///< 0 for a flag; 1 for a list.
  std::string text;
  std::string group;
  std::vector<std::string> needs;  ///< Names of options.
  bool isRequired = false;
};

/// An option or a positional argument of an ArgumentParser.
class Argument {
 public:
  explicit Argument(CLI::Option* option) : option_(option) {}

  Argument group(std::string_view heading) const;  ///< Heading in the help; "Options" if not set.
  Argument needs(Argument other) const;            ///< An error if it is given without the other one.
  Argument require() const;                        ///< An error if it is not given.
  /// Lists the values for completions, where the placeholder in the help is only a name for them: "sdf|seed",
  /// "FILE.ply|FILE.off".
  Argument completions(std::string_view values) const;

 private:
  CLI::Option* option_;
};

/// Result of ArgumentParser::parse(). If all members are empty, the options are set.
struct ParseResult {
  std::string answer;      ///< The text of --help or --version, if given.
  std::string refusal;     ///< Why the arguments do not fit the options.
  std::string miscounted;  ///< Name of the option whose number of values is wrong; empty for other refusals.
};

/// The arguments of a program. An option has a name such as "--rays" or "-o,--output", a positional argument a name
/// without dashes. The targets and functions that receive values must outlive parse(), which calls them in the order in
/// which the arguments were added.
class ArgumentParser {
 public:
  ArgumentParser();
  ~ArgumentParser();

  void setProgram(std::string_view name, std::string_view description);
  void setFooter(std::string_view footer);  ///< Below the options in the help.
  void setHelp(std::string_view text);      ///< Help text of the option -h,--help, which exists by default.
  void addVersion(std::string_view version);

  Argument addValue(std::string_view name, std::string_view placeholder, std::string_view text,
                    const std::function<void(const std::string&)>& receive);
  Argument addNumber(std::string_view name, std::string_view placeholder, std::string_view text, uint64_t& target);
  Argument addNumber(std::string_view name, std::string_view placeholder, std::string_view text, double& target);
  Argument addNumbers(std::string_view name, std::string_view placeholder, std::string_view text,
                      std::array<double, 3>& target);
  Argument addList(std::string_view name, std::string_view placeholder, std::string_view text,
                   std::vector<std::string>& target);
  Argument addFlag(std::string_view name, bool& target, std::string_view text);
  Argument addFlag(std::string_view name, std::function<void()> receive, std::string_view text);

  /// arguments: those after the name of the program. Throws what the functions that receive values throw.
  [[nodiscard]] ParseResult parse(std::vector<std::string> arguments);
  [[nodiscard]] bool isGiven(const std::string& name) const;  ///< After parse().
  /// After parse(): the names of the given options and positional arguments, the long name where there are two.
  [[nodiscard]] std::vector<std::string> givenNames() const;

  void setHelpGroup(std::string_view group);  ///< help() shows the options of this group only.
  /// With a help group, also removes the group of all other options from describe().
  [[nodiscard]] std::string help();

  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::string description() const;
  [[nodiscard]] std::vector<ArgumentDescription> describe() const;  ///< In the order of the help.

 private:
  std::unique_ptr<CLI::App> app_;
  std::string helpGroup_;  ///< Empty: all.
};

}  // namespace asdfvk
