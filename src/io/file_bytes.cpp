#include "io/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "io/input_failure.h"

namespace asdfvk {
namespace {

class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path)
      : value_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (value_ < 0) failInput(fmt::format("cannot be opened: {}", std::strerror(errno)));
  }
  ~Descriptor() {
    if (value_ != STDIN_FILENO) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int value() const { return value_; }

 private:
  int value_;
};

}  // namespace

void FileBytes::grow(size_t capacity) {
  auto* data = static_cast<char*>(std::realloc(data_.get(), capacity));
  if (data == nullptr) throw std::bad_alloc();
  static_cast<void>(data_.release());
  data_.reset(data);
  capacity_ = capacity;
}

void FileBytes::readAll(int descriptor) {
  constexpr size_t kMaxRead = size_t{1} << 30;  // Linux reads at most 2 GiB at once.
  for (;;) {
    if (size_ == capacity_) grow(2 * capacity_);
    const ssize_t count = ::read(descriptor, data_.get() + size_, std::min(capacity_ - size_, kMaxRead));
    if (count == 0) return;
    if (count < 0 && errno != EINTR) failInput(fmt::format("cannot be read: {}", std::strerror(errno)));
    if (count > 0) size_ += static_cast<size_t>(count);
  }
}

FileBytes FileBytes::read(const std::filesystem::path& path) {
  const Descriptor descriptor(path);
  struct stat status {};
  if (::fstat(descriptor.value(), &status) != 0) failInput(fmt::format("cannot be read: {}", std::strerror(errno)));
  if (S_ISDIR(status.st_mode)) failInput("is a directory, not a file");
  // A device such as /dev/zero has no end.
  if (S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && ::isatty(descriptor.value()) == 0))
    failInput("is a device, not a file");
  FileBytes file;
  // One byte more than the size of the file: the read that finds its end needs no larger buffer.
  file.grow(S_ISREG(status.st_mode) ? static_cast<size_t>(status.st_size) + 1 : size_t{1} << 16);
  file.readAll(descriptor.value());
  return file;
}

}  // namespace asdfvk
