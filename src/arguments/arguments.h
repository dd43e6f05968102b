#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk {

struct Argument {
  using Values = std::vector<std::string>;

  std::string names;  ///< "--rays" or "-o,--output"; a name without dashes is a positional argument.
  /// Stands for the value in the help; empty: a flag. "[=N]": an optional value after an equals sign.
  std::string placeholder = {};
  std::string text = {};  ///< Text of the help.
  /// Called with the values of each occurrence, or once with all values of a list. The values are empty for a flag and
  /// for an omitted optional value.
  std::function<void(const Values&)> receive;
  std::string group = "Options";  ///< Heading in the help.
  bool isRequired = false, isList = false;
  bool isRepeatable = false;  ///< The option has one value, and may be given several times.
  size_t valueCount = 1;
  /// Whether the next argument is the optional value. Null: an optional value must follow an equals sign.
  std::function<bool(const std::string& next)> takesNext = {};

  /// The long name, with dashes.
  [[nodiscard]] std::string name() const { return names.substr(names.find(',') + 1); }
};

/// Returns an Argument::receive that converts the values and stores them in `target`, which must outlive the parsing.
[[nodiscard]] std::function<void(const Argument::Values&)> into(std::string& target);
[[nodiscard]] std::function<void(const Argument::Values&)> into(uint64_t& target);
[[nodiscard]] std::function<void(const Argument::Values&)> into(double& target);
[[nodiscard]] std::function<void(const Argument::Values&)> into(std::array<double, 3>& target);
[[nodiscard]] std::function<void(const Argument::Values&)> into(bool& target);

/// Parser of the arguments of a program, including -h,--help and --version.
class ArgumentParser {
 public:
  /// version: answer to --version; empty: no --version. Argument::receive is called in the order of `arguments`.
  ArgumentParser(std::string_view name, std::string_view description, std::string_view version,
                 std::vector<Argument> arguments);

  std::string shortHelp;  ///< The answer to --help; empty: help(). The answer to --help=all is always help().
  std::string footer;     ///< Text below the options in help().
  /// Returns the message for an option of earlier versions, else an empty text. name: with dashes. May be null.
  std::function<std::string(std::string_view name)> removedText;

  /// arguments: the command line without the name of the program. Returns the answer to --help or --version, else an
  /// empty text. Throws Error{OptionOutOfRange} for invalid arguments, and the errors of Argument::receive.
  [[nodiscard]] std::string parse(const std::vector<std::string>& arguments);
  /// The long names of the arguments that were given. Precondition: parse() was called.
  [[nodiscard]] std::vector<std::string> givenNames() const;
  [[nodiscard]] bool isGiven(std::string_view name) const;

  /// The help: all arguments by group, then the footer, in lines of at most 80 columns.
  [[nodiscard]] std::string help() const;

 private:
  struct Entry {
    Argument argument;
    std::vector<Argument::Values> given = {};  ///< Values of each occurrence.
  };
  [[nodiscard]] Entry& find(std::string_view name);
  /// The option with an optional value that `text` names; null if `text` names no such option.
  [[nodiscard]] const Entry* withOptionalValue(const std::string& text) const;
  /// Joins each optional value to its option by '='. CLI11 would always take the next argument as the value.
  [[nodiscard]] std::vector<std::string> withAttachedValues(const std::vector<std::string>& arguments) const;
  /// Reads the positional arguments and refuses unknown options. CLI11 would read a file name such as "[a]" as a list.
  /// typed: the whole command line, for messages.
  void readPositional(const std::vector<std::string>& arguments, const std::vector<std::string>& typed);
  void read(const std::vector<std::string>& arguments);

  std::string name_, description_, version_;
  std::vector<Entry> entries_;
};

}  // namespace asdfvk
