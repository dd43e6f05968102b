#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "describe/session_options.h"

namespace asdfvk::python {

/// Options from a dictionary with Python names, and the options that they imply. The value None means the default.
/// Throws Error{UnknownName} for an unknown key or choice. Throws Error{OptionOutOfRange} for a value of the wrong type
/// or out of range. Throws Error{OptionConflict} for options that contradict each other.
[[nodiscard]] CheckedOptions optionsOf(const pybind11::dict& values, bool compares = false);
[[nodiscard]] SessionSettings sessionOf(const pybind11::dict& values);

[[nodiscard]] std::vector<std::string> optionNames();
/// The message for a keyword of earlier versions, else an empty text.
[[nodiscard]] std::string removedKeywordText(std::string_view name);
/// If an option has this name on the command line, returns its keyword, such as "random_seed" for "rng_seed". Otherwise
/// returns the result of similarNames().
[[nodiscard]] std::string similarKeywords(std::string_view name, const std::vector<std::string>& keywords);

}  // namespace asdfvk::python
