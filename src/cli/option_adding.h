#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <type_traits>

#include "asdf_vk/error.h"
#include "cli/choice_names.h"

/// The two kinds of options that take a value; what is wrong with one becomes Error{Usage}.
namespace asdfvk {

/// `target`: a variable, or a function that takes the value.
template <typename Target, typename T, size_t N>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Target&& target, const ChoiceNames<T, N>& choices,
                       const std::string& text) {
  const std::string names = joined(choices);
  auto set = [&] {
    if constexpr (std::is_invocable_v<Target, const T&>) {
      return target;
    } else {
      return &target;
    }
  }();
  return app
      .add_option_function<std::string>(
          name,
          [name, names, set, choices](const std::string& choice) {
            const auto found = std::find_if(choices.begin(), choices.end(),
                                            [&](const auto& candidate) { return candidate.first == choice; });
            if (found == choices.end())
              throw Error(ErrorCode::OptionOutOfRange, fmt::format("{}: '{}' is not one of {}", name, choice, names));
            if constexpr (std::is_invocable_v<Target, const T&>) {
              set(found->second);
            } else {
              *set = found->second;
            }
          },
          text)
      ->option_text(names);
}

/// `read` turns the text into a value and throws Error{Usage}; the option's name is put before its message.
template <typename Read>
CLI::Option* addValue(CLI::App& app, const std::string& name, const std::string& placeholder, const std::string& text,
                      Read read) {
  return app
      .add_option_function<std::string>(
          name,
          [name, read](const std::string& value) {
            try {
              read(value);
            } catch (const Error& error) {
              throw Error(error.code(), name.substr(name.find("--")) + ": " + error.what());
            }
          },
          text)
      ->option_text(placeholder);
}

}  // namespace asdfvk
