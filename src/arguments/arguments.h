#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Command lines of the programs.
namespace asdfvk {

/// An option or a positional argument.
struct Argument {
  using Values = std::vector<std::string>;

  std::string names;  ///< "--rays" or "-o,--output"; without dashes: positional.
  std::string placeholder =
      {};                 ///< Stands for the value in the help; empty: a flag. "[=N]": an optional, attached value.
  std::string text = {};  ///< In the help.
  /// Gets the values, all those of a list at once, none of a flag and of an optional value. Called where the argument
  /// is given.
  std::function<void(const Values&)> receive;
  std::string group = "Options";  ///< Heading in the help.
  bool isRequired = false, isList = false;
  size_t valueCount = 1;
  /// Whether the next argument is the value of an option whose value is optional; null: only an attached one is.
  std::function<bool(const std::string& next)> takesNext = {};

  /// The long name.
  [[nodiscard]] std::string name() const { return names.substr(names.find(',') + 1); }
};

/// Argument::receive that converts into a variable, which outlives the parsing.
[[nodiscard]] std::function<void(const Argument::Values&)> into(std::string& target);
[[nodiscard]] std::function<void(const Argument::Values&)> into(uint64_t& target);
[[nodiscard]] std::function<void(const Argument::Values&)> into(double& target);
[[nodiscard]] std::function<void(const Argument::Values&)> into(std::array<double, 3>& target);
[[nodiscard]] std::function<void(const Argument::Values&)> into(bool& target);

/// The arguments of a program, -h,--help and --version.
class ArgumentParser {
 public:
  /// version: the answer to --version; empty: there is no such option. The arguments receive their values in their
  /// order.
  ArgumentParser(std::string_view name, std::string_view description, std::string_view version,
                 std::vector<Argument> arguments);

  std::string shortHelp;  ///< The answer to --help, where it differs from that to --help=all, which is help().
  std::string footer;     ///< Below the options in help().

  /// arguments: those after the name of the program. Returns the text of --help or --version, else an empty one. Throws
  /// Error{OptionOutOfRange} where they do not fit, and what the arguments throw that receive values.
  [[nodiscard]] std::string parse(const std::vector<std::string>& arguments);
  /// After parse(): the long names of the arguments that were given.
  [[nodiscard]] std::vector<std::string> givenNames() const;
  [[nodiscard]] bool isGiven(std::string_view name) const;

  /// All arguments by group, in lines of 80 columns, and the footer.
  [[nodiscard]] std::string help() const;

 private:
  struct Entry {
    Argument argument;
    std::vector<Argument::Values> given = {};  ///< The values of each occurrence.
  };
  [[nodiscard]] Entry& find(std::string_view name);
  /// The option that the text names, if its value is optional; otherwise null.
  [[nodiscard]] const Entry* withOptionalValue(const std::string& text) const;
  /// Joins each optional value to its option by '='. CLI11 would take the next argument as the value, whatever it is.
  [[nodiscard]] std::vector<std::string> withAttachedValues(const std::vector<std::string>& arguments) const;
  /// Reads the arguments that are no options, and refuses unknown options. CLI11 would read "[a]" as a list.
  void readPositional(const std::vector<std::string>& arguments);
  void read(const std::vector<std::string>& arguments);

  std::string name_, description_, version_;
  std::vector<Entry> entries_;
};

/// Lines of at most `width` columns, each after the indentation.
[[nodiscard]] std::string wrapped(std::string_view text, size_t width, std::string_view indent);

}  // namespace asdfvk
