#include "io/file_bytes.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr size_t kMaxRead = size_t{1} << 30;  // Linux reads at most 2 GiB at once.

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {
    if (value_ < 0) failInput(fmt::format("cannot be opened: {}", std::generic_category().message(errno)));
  }
  ~Descriptor() {
    if (value_ != STDIN_FILENO) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] struct stat status() const {
    struct stat status {};
    if (::fstat(value_, &status) != 0) failRead();
    return status;
  }

  [[nodiscard]] bool isTerminal() const { return ::isatty(value_) != 0; }

  /// Returns less than `size` only at the end of the file.
  size_t read(char* to, size_t size) const {
    size_t done = 0;
    while (done < size) {
      const ssize_t count = ::read(value_, to + done, std::min(size - done, kMaxRead));
      if (count < 0 && errno != EINTR) failRead();
      if (count == 0) break;
      if (count > 0) done += static_cast<size_t>(count);
    }
    return done;
  }

  /// Reads from `offset` on, in blocks by all threads. Returns less than `size` only at the end of the file.
  size_t readBlocks(char* to, size_t offset, size_t size) const {
    constexpr size_t kBlockSize = size_t{1} << 20;
    const auto missingAfter = [&](size_t begin, size_t end) {
      while (begin < end) {
        const ssize_t count = ::pread(value_, to + begin, end - begin, static_cast<off_t>(offset + begin));
        if (count < 0 && errno != EINTR) failRead();
        if (count == 0) return size - begin;
        if (count > 0) begin += static_cast<size_t>(count);
      }
      return size_t{0};
    };
    return size -
           foldInParallel<size_t, kBlockSize>(size, missingAfter, [](size_t a, size_t b) { return std::max(a, b); });
  }

 private:
  [[noreturn]] static void failRead() {
    failInput(fmt::format("cannot be read: {}", std::generic_category().message(errno)));
  }

  int value_;
};

}  // namespace

UnsetVector<char> fileBytes(const std::filesystem::path& path) {
  const Descriptor file(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const struct stat status = file.status();
  if (S_ISDIR(status.st_mode)) failInput("is a directory, not a file");
  // Rejected, because a device such as /dev/zero has no end.
  if (S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && !file.isTerminal())) failInput("is a device, not a file");
  constexpr size_t kFirstOfPipe = size_t{1} << 16;
  const bool isNamedFile = S_ISREG(status.st_mode) && path != "-";  // Standard input may begin inside of a file.
  // One byte more than the file, so that the read that detects the end needs no larger buffer.
  UnsetVector<char> bytes(S_ISREG(status.st_mode) ? static_cast<size_t>(status.st_size) + 1 : kFirstOfPipe);
  for (size_t size = 0;;) {
    const size_t room = bytes.size() - size;
    size += isNamedFile ? file.readBlocks(bytes.data() + size, size, room) : file.read(bytes.data() + size, room);
    const bool isAtEnd = size < bytes.size();
    bytes.resize(isAtEnd ? size : 2 * size);
    if (isAtEnd) return bytes;
  }
}

UnsetVector<char> regularFileBytes(const std::filesystem::path& path, std::string_view where) try {
  // Neither waits for the writer of a FIFO nor follows a link that replaced the file after its path was resolved.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW));
  const struct stat status = file.status();
  if (!S_ISREG(status.st_mode)) failInput("is not a regular file");
  UnsetVector<char> bytes(static_cast<size_t>(status.st_size));
  bytes.resize(file.read(bytes.data(), bytes.size()));
  return bytes;
} catch (const Error& error) {
  throw Error(error.code(),
              fmt::format("{}: the file {} {}", where, asdfvk::quoted(path.filename().string()), error.what()));
}

}  // namespace asdfvk
