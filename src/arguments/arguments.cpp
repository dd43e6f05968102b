#include "arguments/arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "describe/option.h"

namespace asdfvk {
namespace {

constexpr const char* kEndOfOptions = "--";
/// Value of an option whose optional value is omitted. No argument of a program contains this character.
const std::string kMissingValue(1, '\0');

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::OptionOutOfRange, message); }

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
  entries_.push_back({{.names = "-h,--help", .placeholder = "[=all]", .text = "Print the help"}});
  if (!version.empty()) entries_.push_back({{.names = "--version", .text = "Print the version"}});
  for (Argument& argument : arguments) entries_.push_back({std::move(argument)});
}

ArgumentParser::Entry& ArgumentParser::find(std::string_view name) {
  for (Entry& entry : entries_) {
    const std::string& names = entry.argument.names;
    if (entry.argument.name() == name || (name.size() == 2 && names.starts_with(std::string(name) + ","))) return entry;
  }
  if (const std::string removed = removedText ? removedText(name) : ""; !removed.empty()) refuse(removed);
  std::vector<std::string> known;
  for (const Entry& entry : entries_)
    if (!isPositional(entry.argument)) known.push_back(entry.argument.name());
  const std::string similar = similarNames(name, known);
  refuse(fmt::format("{} is unknown; {}", name,
                     similar.empty() ? name_ + " --help lists the options" : "did you mean " + similar + "?"));
}

const ArgumentParser::Entry* ArgumentParser::withOptionalValue(const std::string& text) const {
  const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return hasOptionalValue(e.argument) && (e.argument.name() == text || e.argument.names.starts_with(text + ","));
  });
  return entry == entries_.end() ? nullptr : &*entry;
}

std::vector<std::string> ArgumentParser::withAttachedValues(const std::vector<std::string>& arguments) const {
  std::vector<std::string> attached;
  bool hasEnded = false;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const Entry* const entry = hasEnded ? nullptr : withOptionalValue(arguments[i]);
    hasEnded |= arguments[i] == kEndOfOptions;
    // After "--name=", CLI11 would take the next argument as the value.
    if (!hasEnded && arguments[i].starts_with("--") && arguments[i].find('=') == arguments[i].size() - 1)
      refuse(arguments[i] + " has no value");
    if (entry == nullptr) {
      attached.push_back(arguments[i]);
      continue;
    }
    const Argument& argument = entry->argument;
    const bool takesNext = argument.takesNext && i + 1 < arguments.size() && argument.takesNext(arguments[i + 1]);
    attached.push_back(argument.name() + "=" + (takesNext ? arguments[++i] : kMissingValue));
  }
  return attached;
}

void ArgumentParser::readPositional(const std::vector<std::string>& arguments, const std::vector<std::string>& typed) {
  const auto positional =
      std::find_if(entries_.begin(), entries_.end(), [](const Entry& entry) { return isPositional(entry.argument); });
  bool hasEnded = false;
  for (const std::string& text : arguments) {
    if (!hasEnded && text == kEndOfOptions) {
      hasEnded = true;
      continue;
    }
    // CLI11 shortens "-q=x" to "-=x" if -q takes no value.
    const auto whole = std::find_if(typed.begin(), typed.end(), [&](const std::string& t) {
      return text.starts_with("-=") && t.size() > text.size() && t[0] == '-' && t[1] != '-' &&
             t.ends_with(text.substr(1));
    });
    if (!hasEnded && whole != typed.end())
      refuse(fmt::format("{}: -{} takes no value", *whole, (*whole)[whole->find('=') - 1]));
    if (!hasEnded && text.size() > 1 && text.starts_with('-')) (void)find(text.substr(0, text.find('=', 2)));
    if (positional == entries_.end() || (!positional->given.empty() && !positional->argument.isList))
      refuse(fmt::format("'{}' is one argument too many", text));
    positional->given.resize(1);
    positional->given.front().push_back(text);
  }
}

void ArgumentParser::read(const std::vector<std::string>& arguments) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  std::vector<const CLI::Option*> options;  // Null for a positional argument.
  for (const Entry& entry : entries_) {
    const Argument& argument = entry.argument;
    options.push_back(isPositional(argument) ? nullptr
                      : isFlag(argument)
                          ? app.add_flag(argument.names)->disable_flag_override()
                          : app.add_option(argument.names)->expected(static_cast<int>(argument.valueCount)));
    if (argument.isRepeatable) app.get_option(argument.name())->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  std::vector<std::string> reversed = withAttachedValues(arguments);
  std::reverse(reversed.begin(), reversed.end());  // CLI11 reads the arguments from the back.
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::ArgumentMismatch& mismatch) {
    // The message begins with the name of the argument; the name of a flag has no dashes.
    const std::string message = mismatch.what(), name = message.substr(0, message.find_first_of(": "));
    for (const Entry& entry : entries_) {
      const Argument& argument = entry.argument;
      if (isFlag(argument) && argument.name() == "--" + name) refuse(argument.name() + " takes no value");
      if (argument.name() == name)
        refuse(fmt::format("{} takes exactly {}, once", name,
                           argument.valueCount == 1 ? "one value" : std::to_string(argument.valueCount) + " values"));
    }
    refuse(message);
  } catch (const CLI::ParseError& error) {
    refuse(error.what());
  }
  readPositional(app.remaining(), arguments);
  for (size_t i = 0; i < entries_.size(); ++i) {
    if (options[i] == nullptr) continue;
    std::vector<Argument::Values>& given = entries_[i].given;
    const std::vector<std::string>& values = options[i]->results();
    if (isFlag(entries_[i].argument))
      given.resize(values.size());
    else if (entries_[i].argument.isRepeatable)
      for (const std::string& value : values) given.push_back({value});
    else if (!values.empty())
      given = {values.front() == kMissingValue ? Argument::Values{} : values};
  }
}

std::string ArgumentParser::parse(const std::vector<std::string>& arguments) {
  // Requests for help and version are answered even if CLI11 would refuse another argument.
  for (const std::string& text : arguments) {
    if (text == kEndOfOptions) break;
    if (text == "-h" || text == "--help") return shortHelp.empty() ? help() : shortHelp;
    if (text == "--help=all") return help();
    if (text == "--version" && !version_.empty()) return version_ + "\n";
  }
  read(arguments);
  if (isGiven("--help"))
    refuse(fmt::format("--help: '{}' is not 'all'; write --help or --help=all", find("--help").given.front().front()));
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

}  // namespace asdfvk
