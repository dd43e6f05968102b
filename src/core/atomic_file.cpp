#include "core/atomic_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "asdf_vk/error.h"
#include "core/abandoned_files.h"
#include "core/write_all.h"

namespace asdfvk {

namespace {

constexpr size_t kBufferSize = size_t{1} << 20;
static_assert(kBufferSize >= ByteOutput::kMaxReserve);

}  // namespace

std::filesystem::path followLinks(std::filesystem::path path) {
  constexpr int kMaxLinks = 40;  // The limit of Linux.
  std::error_code error;
  for (int i = 0; i < kMaxLinks && std::filesystem::is_symlink(path, error); ++i)
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  return path;
}

AtomicFile::AtomicFile(const std::filesystem::path& target)
    : ByteOutput(kBufferSize), target_(target), isStandardOutput_(target == "-") {
  if (isStandardOutput_) {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  if (target_.empty()) throw Error(ErrorCode::OutputNotWritable, "the name of the result file is empty");
  struct stat status {};
  if (::stat(target_.c_str(), &status) != 0) {
    if (errno != ENOENT) fail(errno, "");
    if (target_.filename().empty()) fail(EISDIR, "");
    target_ = followLinks(target_);
    openTemporary();
    return;
  }
  if (S_ISDIR(status.st_mode)) fail(EISDIR, "");
  if (!S_ISREG(status.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno, "");
    return;
  }
  if (::access(target_.c_str(), W_OK) != 0) fail(errno, "");
  std::error_code ignored;
  const std::filesystem::path followed = std::filesystem::canonical(target_, ignored);
  if (!followed.empty()) target_ = followed;
  openTemporary();
  if (::fchmod(descriptor_, status.st_mode & 07777) != 0) failAndRemove(errno);
}

AtomicFile::~AtomicFile() { closeAndRemove(); }

void AtomicFile::openTemporary() {
  static std::atomic<unsigned> count = 0;
  do {
    temporary_ = target_;
    temporary_.replace_filename(temporaryFileName(count++));
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ >= 0) {
    // removeAbandonedFiles() keeps locked files. A failure is ignored, because some file systems have no locks.
    static_cast<void>(::flock(descriptor_, LOCK_EX | LOCK_NB));
    // Announced only after the open: an older file of this name belongs to another process.
    unfinished_.announce(temporary_.native());
    return;
  }
  const int reason = errno;
  const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
  temporary_.clear();
  if (reason == ENOENT) fail(reason, fmt::format("the folder {} does not exist; create it first", folder.string()));
  fail(reason, fmt::format("creating a temporary file in {}", folder.string()));
}

void AtomicFile::makeRoom(size_t) { flush(); }

void AtomicFile::writeLong(std::string_view bytes) {
  flush();
  if (const int error = writeAll(descriptor_, bytes); error != 0) failAndRemove(error);
}

void AtomicFile::flush() {
  if (const int error = writeAll(descriptor_, written()); error != 0) failAndRemove(error);
  clear();
}

/// Checks the result of ::close(), because some full network disks report the error only in this call.
void AtomicFile::close() {
  if (descriptor_ < 0) return;
  flush();
  const int descriptor = std::exchange(descriptor_, -1);
  if (!isStandardOutput_ && ::close(descriptor) != 0) failAndRemove(errno);
}

void AtomicFile::commit() {
  close();
  if (!temporary_.empty() && ::rename(temporary_.c_str(), target_.c_str()) != 0) failAndRemove(errno);
  unfinished_.withdraw();
  temporary_.clear();
}

void AtomicFiles::finish(AtomicFile& file) { file.temporary_.empty() ? file.close() : file.flush(); }

void AtomicFiles::commit() {
  for (const auto& file : files_) file->close();
  std::vector<std::filesystem::path> made;
  try {
    for (const auto& file : files_) {
      std::error_code ignored;
      const bool isNew = !file->temporary_.empty() && !std::filesystem::exists(file->target_, ignored);
      file->commit();
      if (isNew) made.push_back(file->target_);
    }
  } catch (...) {
    for (const std::filesystem::path& path : made) ::unlink(path.c_str());
    throw;
  }
}

void AtomicFile::failAndRemove(int errorNumber) {
  const bool isAtomic = !temporary_.empty();
  closeAndRemove();
  fail(errorNumber, isAtomic ? "no partial file remains" : "");
}

void AtomicFile::closeAndRemove() noexcept {
  if (descriptor_ >= 0 && !isStandardOutput_) ::close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  unfinished_.withdraw();
  temporary_.clear();
}

void AtomicFile::fail(int errorNumber, const std::string& during) const {
  const std::string name = isStandardOutput_ ? "standard output" : target_.string();
  throw Error(ErrorCode::OutputNotWritable,
              fmt::format("{} cannot be written: {}{}{}", name, std::generic_category().message(errorNumber),
                          during.empty() ? "" : "; ", during));
}

}  // namespace asdfvk
