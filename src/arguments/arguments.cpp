#include "arguments/arguments.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "asdf_vk/error.h"
#include "describe/option.h"

namespace asdfvk {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::OptionOutOfRange, message); }

/// Throws std::invalid_argument.
template <typename T>
void readNumber(const std::string& text, T& target) {
  const std::optional<T> number = numberIn<T>(text);
  if (!number)
    throw std::invalid_argument(fmt::format("'{}' is not a {}number", text, std::is_integral_v<T> ? "whole " : ""));
  target = *number;
}

bool isPositional(const Argument& argument) { return !argument.names.starts_with('-'); }
bool isFlag(const Argument& argument) { return argument.placeholder.empty(); }
bool hasOptionalValue(const Argument& argument) { return argument.placeholder.starts_with("[=") || argument.takesNext; }

}  // namespace

std::function<void(const Argument::Values&)> into(std::string& target) {
  return [&target](const Argument::Values& values) { target = values.front(); };
}
std::function<void(const Argument::Values&)> into(uint64_t& target) {
  return [&target](const Argument::Values& values) { readNumber(values.front(), target); };
}
std::function<void(const Argument::Values&)> into(double& target) {
  return [&target](const Argument::Values& values) { readNumber(values.front(), target); };
}
std::function<void(const Argument::Values&)> into(std::array<double, 3>& target) {
  return [&target](const Argument::Values& values) {
    for (size_t i = 0; i < target.size(); ++i) readNumber(values[i], target[i]);
  };
}
std::function<void(const Argument::Values&)> into(bool& target) {
  return [&target](const Argument::Values&) { target = true; };
}

ArgumentParser::ArgumentParser(std::string_view name, std::string_view description, std::string_view version,
                               std::vector<Argument> arguments)
    : name_(name), description_(description), version_(version) {
  entries_.push_back({{.names = "-h,--help", .placeholder = "[=all]", .text = "Print a help"}});
  if (!version.empty()) entries_.push_back({{.names = "--version", .text = "Print the version"}});
  for (Argument& argument : arguments) entries_.push_back({std::move(argument)});
}

ArgumentParser::Entry& ArgumentParser::find(std::string_view name) {
  for (Entry& entry : entries_) {
    const std::string& names = entry.argument.names;
    if (entry.argument.name() == name || (name.size() == 2 && names.starts_with(std::string(name) + ","))) return entry;
  }
  std::vector<std::string> known;
  for (const Entry& entry : entries_)
    if (!isPositional(entry.argument)) known.push_back(entry.argument.name());
  const std::string similar = similarNames(name, known);
  refuse(fmt::format("{} is unknown; {}", name,
                     similar.empty() ? name_ + " --help lists the options" : "did you mean " + similar + "?"));
}

size_t ArgumentParser::readOption(const std::vector<std::string>& arguments, size_t at) {
  const std::string& text = arguments[at];
  const bool isLong = text.starts_with("--");
  const size_t nameSize = isLong ? std::min(text.find('='), text.size()) : 2;
  Entry& entry = find(std::string_view(text).substr(0, nameSize));
  const Argument& argument = entry.argument;
  bool isAttached = text.size() > nameSize;
  if (isFlag(argument)) {
    if (isAttached && isLong) refuse(argument.name() + " takes no value");
    entry.given.emplace_back();
    // "-r0" is -r -0.
    return isAttached ? readOption({"-" + text.substr(2)}, 0) : 1;
  }
  if (!entry.given.empty()) refuse(argument.name() + " takes exactly one value, once");
  if (isAttached) {
    entry.given.push_back({text.substr(nameSize + (isLong ? 1 : 0))});
    return 1;
  }
  const bool hasNext = at + 1 < arguments.size();
  if (hasOptionalValue(argument) && !(hasNext && argument.takesNext && argument.takesNext(arguments[at + 1]))) {
    entry.given.emplace_back();
    return 1;
  }
  const size_t count = argument.valueCount;
  if (arguments.size() - at <= count)
    refuse(fmt::format("{} takes exactly {}, once", argument.name(),
                       count == 1 ? "one value" : std::to_string(count) + " values"));
  const auto begin = arguments.begin() + static_cast<std::ptrdiff_t>(at) + 1;
  entry.given.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(count));
  return 1 + count;
}

void ArgumentParser::read(const std::vector<std::string>& arguments) {
  const auto positional =
      std::find_if(entries_.begin(), entries_.end(), [](const Entry& entry) { return isPositional(entry.argument); });
  bool hasEnded = false;
  std::optional<Error> refusal;  // The first one. What follows may be --help.
  for (size_t i = 0; i < arguments.size();) {
    const std::string& text = arguments[i];
    const bool isOption = !hasEnded && text.size() > 1 && text[0] == '-';
    try {
      if (isOption && text != "--") {
        i += readOption(arguments, i);
        continue;
      }
      if (isOption) {
        hasEnded = true;
      } else if (positional == entries_.end() || (!positional->given.empty() && !positional->argument.isList)) {
        refuse(fmt::format("'{}' is one argument too many", text));
      } else {
        positional->given.resize(1);
        positional->given.front().push_back(text);
      }
    } catch (const Error& error) {
      if (!refusal) refusal = error;
    }
    ++i;
  }
  if (refusal && !isGiven("--help") && !isGiven("--version")) throw Error(*refusal);
}

std::string ArgumentParser::parse(const std::vector<std::string>& arguments) {
  read(arguments);
  if (isGiven("--help")) {
    const Argument::Values& values = find("--help").given.front();
    if (!values.empty() && values.front() != "all") refuse(fmt::format("--help: '{}' is not all", values.front()));
    return values.empty() && !shortHelp.empty() ? shortHelp : help();
  }
  if (isGiven("--version")) return version_ + "\n";
  for (const auto& [argument, given] : entries_) {
    if (argument.isRequired && given.empty())
      refuse(fmt::format("{} is missing; {} --help lists the options", argument.name(), name_));
    try {
      for (const Argument::Values& values : given) argument.receive(values);
    } catch (const std::invalid_argument& wrong) {
      refuse(fmt::format("{}: {}", argument.name(), wrong.what()));
    }
  }
  return {};
}

bool ArgumentParser::isGiven(std::string_view name) const {
  const std::vector<std::string> names = givenNames();
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> ArgumentParser::givenNames() const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_)
    if (!entry.given.empty()) names.push_back(entry.argument.name());
  return names;
}

std::string ArgumentParser::help() const {
  constexpr size_t kWidth = 80;
  std::string text = wrapped(description_, kWidth, "") + "\nUsage: " + name_ + " [OPTIONS]", ofPositionals;
  std::vector<std::pair<std::string, std::string>> groups;
  for (const Entry& entry : entries_) {
    const Argument& argument = entry.argument;
    const bool hasSpace = !isPositional(argument) && !isFlag(argument) && !argument.placeholder.starts_with("[=");
    const std::string row =
        fmt::format("  {}{}{}\n{}\n", isPositional(argument) ? "" : argument.names, hasSpace ? " " : "",
                    argument.placeholder, wrapped(argument.text, kWidth, "      "));
    if (isPositional(argument)) {
      text += " " + argument.placeholder;
      ofPositionals += "\n" + row;
      continue;
    }
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == argument.group; });
    if (group == groups.end()) group = groups.insert(group, {argument.group, ""});
    group->second += row;
  }
  text += "\n" + ofPositionals;
  for (const auto& [group, rows] : groups) text += fmt::format("\n{}:\n{}", group, rows);
  return footer.empty() ? text : text + "\n" + wrapped(footer, kWidth, "") + "\n";
}

std::string wrapped(std::string_view text, size_t width, std::string_view indent) {
  std::string lines;
  size_t column = width;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, std::min(text.find_first_of(" \n"), text.size()));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const bool isNewLine = column + 1 + word.size() > width;
    if (isNewLine) lines += lines.empty() ? "" : "\n";
    lines += isNewLine ? indent : " ";
    lines += word;
    column = isNewLine ? indent.size() + word.size() : column + 1 + word.size();
  }
  return lines;
}

}  // namespace asdfvk
