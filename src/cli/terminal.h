#pragma once

#include <string_view>

namespace asdfvk {

/// Writes all of it to standard output. Throws Error{Output} with the reason: a full disk, a closed pipe.
void writeStandardOutput(std::string_view text);

/// Writes to standard error; a failure has nowhere to be told and is passed over.
void writeStandardError(std::string_view text);

/// "asdf-vk: error: SUBJECT: MESSAGE" as one line on standard error; without the subject where that is empty.
void printError(std::string_view subject, std::string_view message);
void printWarning(std::string_view subject, std::string_view message);

/// A failed write becomes an error of the call instead of a signal, and a file that is opened can never take the place
/// of a standard stream that the caller closed.
void secureStandardStreams();

[[nodiscard]] bool isStandardErrorTerminal();

}  // namespace asdfvk
