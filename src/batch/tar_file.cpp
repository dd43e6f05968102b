#include "batch/tar_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <exception>
#include <system_error>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "batch/archive_library.h"
#include "batch/content_hash.h"
#include "core/text.h"

namespace asdfvk {
namespace {

constexpr size_t kTarBlock = 512;
constexpr std::array kTarKinds{std::pair{TarMember::Kind::File, AE_IFREG}, std::pair{TarMember::Kind::Folder, AE_IFDIR},
                               std::pair{TarMember::Kind::SymbolicLink, AE_IFLNK}};

TarMember::Kind kindOf(archive_entry* entry) {
  const ArchiveLibrary& library = archiveLibrary();
  if (library.hardLinkOf(entry) != nullptr) return TarMember::Kind::HardLink;
  for (const auto& [kind, type] : kTarKinds)
    if (library.fileTypeOf(entry) == type) return kind;
  return TarMember::Kind::Other;
}

std::string textOrEmpty(const char* text) { return text == nullptr ? "" : text; }

}  // namespace

/// The bytes of the file, for libarchive.
struct TarReader::Source {
  static constexpr size_t kBufferBytes = size_t{1} << 18;
  static constexpr int kPollMilliseconds = 50;

  Source(std::string name, std::stop_token stopToken) : path(std::move(name)), stop(std::move(stopToken)) {}
  ~Source() {
    if (descriptor > STDIN_FILENO) ::close(descriptor);
  }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// Returns the number of bytes in `buffer`, 0 at the end, or -1 after an error or a stop request.
  ssize_t read() {
    for (;;) {
      pollfd polled{descriptor, POLLIN, 0};
      const int ready = ::poll(&polled, 1, kPollMilliseconds);
      if (stop.stop_requested()) {
        isStopped = true;
        return -1;
      }
      if (ready <= 0) continue;
      const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
      if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      errorNumber = count < 0 ? errno : 0;
      if (count > 0) hash.add({buffer.data(), static_cast<size_t>(count)});
      return count;
    }
  }

  static la_ssize_t readForArchive(archive*, void* source, const void** bytes) {
    auto& self = *static_cast<Source*>(source);
    *bytes = self.buffer.data();
    return self.read();
  }

  std::string path;
  std::stop_token stop;
  std::vector<char> buffer = std::vector<char>(kBufferBytes);
  ContentHash hash;
  int descriptor = STDIN_FILENO, errorNumber = 0;
  bool isStopped = false;
};

TarReader::TarReader(const std::string& path, std::stop_token stop)
    : source_(std::make_unique<Source>(path, std::move(stop))), archive_(nullptr) {
  const ArchiveLibrary& library = archiveLibrary();
  if (path != "-") {
    // Without a wait for the writer of a FIFO; read() waits.
    source_->descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (source_->descriptor < 0) fail(fmt::format("cannot be opened: {}", std::generic_category().message(errno)));
  }
  archive_ = library.newReader();
  library.readTar(archive_);
  for (const auto addFilter : {library.readGzip, library.readBzip2, library.readXz, library.readZstd, library.readLz4})
    addFilter(archive_);
  library.setReadOptions(archive_, "tar:read_concatenated_archives");
  // An error repeats at the first member.
  library.openReader(archive_, source_.get(), nullptr, Source::readForArchive, nullptr);
}

TarReader::~TarReader() {
  if (archive_ != nullptr) archiveLibrary().freeReader(archive_);
}

void TarReader::fail(const std::string& reason) const {
  throw Error(ErrorCode::UnreadableInput,
              fmt::format("{}: {}", source_->path == "-" ? "standard input" : source_->path, oneLine(reason)));
}

void TarReader::failArchive() const {
  if (source_->isStopped) throw Error(ErrorCode::Cancelled, "cancelled");
  if (source_->errorNumber != 0)
    fail(fmt::format("cannot be read: {}", std::generic_category().message(source_->errorNumber)));
  const std::string reason = textOrEmpty(archiveLibrary().errorString(archive_));
  if (!hasMembers_) fail(fmt::format("is not a tar, or is damaged at its beginning ({})", reason));
  fail(fmt::format("is damaged or truncated at or after its member {} ({})", current_, reason));
}

std::optional<TarMember> TarReader::next() {
  const ArchiveLibrary& library = archiveLibrary();
  if (hasMembers_) {
    std::array<char, 1 << 14> skipped{};
    while (read(skipped.data(), skipped.size()) == skipped.size()) {
    }
    endOfMember_ = library.filterBytes(archive_, 0);
  }
  archive_entry* entry = nullptr;
  const int status = library.nextHeader(archive_, &entry);
  if (status == ARCHIVE_EOF) {
    if (library.filterBytes(archive_, 0) < endOfMember_ + static_cast<int64_t>(kTarBlock))
      fail(hasMembers_ ? fmt::format("is truncated after its member {}: it lacks the end of a tar", current_)
                       : std::string("is empty; a tar has an end mark of 1,024 bytes"));
    while (source_->read() > 0) {
    }
    if (source_->isStopped) failArchive();
    return std::nullopt;
  }
  if (status != ARCHIVE_OK && status != ARCHIVE_WARN) failArchive();
  hasMembers_ = true;
  // A name in UTF-8 of a pax header may have no form in the character set of the process.
  const char* const name = library.pathOf(entry);
  current_ = textOrEmpty(name != nullptr ? name : library.utf8PathOf(entry));
  const TarMember::Kind kind = kindOf(entry);
  return TarMember{.name = current_,
                   .kind = kind,
                   .byteCount = kind == TarMember::Kind::File ? static_cast<uint64_t>(library.sizeOf(entry)) : 0,
                   .target = textOrEmpty(kind == TarMember::Kind::HardLink ? library.hardLinkOf(entry)
                                                                           : library.symbolicLinkOf(entry)),
                   .time = library.timeOf(entry),
                   .permissions = static_cast<uint32_t>(library.permissionsOf(entry))};
}

size_t TarReader::read(char* to, size_t size) {
  size_t done = 0;
  while (done < size) {
    const la_ssize_t count = archiveLibrary().readData(archive_, to + done, size - done);
    if (count == ARCHIVE_RETRY) continue;
    if (count < 0) failArchive();
    if (count == 0) break;
    done += static_cast<size_t>(count);
  }
  return done;
}

std::string TarReader::hash() const { return source_->hash.text(); }

/// Receives the bytes of the tar from libarchive.
struct TarWriter::Sink {
  explicit Sink(const std::string& path) : file(path) {}

  static la_ssize_t writeForArchive(archive*, void* sink, const void* bytes, size_t size) {
    auto& self = *static_cast<Sink*>(sink);
    try {  // Errors must not pass through C.
      if (!self.isClosed) self.file.write(bytes, size);
      return static_cast<la_ssize_t>(size);
    } catch (...) {
      self.failure = std::current_exception();
      return -1;
    }
  }

  AtomicFile file;
  std::exception_ptr failure;
  bool isClosed = false;  ///< Further bytes are dropped.
};

TarWriter::TarWriter(const std::string& path) : path_(path), archive_(nullptr) {
  const ArchiveLibrary& library = archiveLibrary();
  sink_ = std::make_unique<Sink>(path);
  archive_ = library.newWriter();
  library.writeGnuTar(archive_);
  library.setBytesPerBlock(archive_, 0);
  const std::string extension = lowerCase(std::filesystem::path(path).extension().string());
  if (extension == ".gz" || extension == ".tgz") {
    require(library.writeGzip(archive_) == ARCHIVE_OK);
    library.setFilterOption(archive_, "gzip", "timestamp", nullptr);
  } else if (extension == ".zst") {
    require(library.writeZstd(archive_) == ARCHIVE_OK);
  }
  require(library.openWriter(archive_, sink_.get(), nullptr, Sink::writeForArchive, nullptr) == ARCHIVE_OK);
}

TarWriter::~TarWriter() {
  if (archive_ == nullptr) return;
  // freeWriter() completes a member with zeros. After failWriter() it does not, but it leaks some bytes.
  constexpr uint64_t kMaxZeros = uint64_t{1} << 28;
  sink_->isClosed = true;
  if (missingBytes_ > kMaxZeros) archiveLibrary().failWriter(archive_);
  archiveLibrary().freeWriter(archive_);
}

void TarWriter::require(bool isDone) const {
  if (isDone) return;
  if (sink_->failure) std::rethrow_exception(sink_->failure);
  throw Error(ErrorCode::OutputNotWritable,
              fmt::format("{} cannot be written: {}", path_ == "-" ? "standard output" : path_,
                          textOrEmpty(archiveLibrary().errorString(archive_))));
}

void TarWriter::begin(const TarMember& member) {
  const ArchiveLibrary& library = archiveLibrary();
  archive_entry* const entry = library.newEntry();
  library.setPath(entry, member.name.c_str());
  library.setPermissions(entry, static_cast<mode_t>(member.permissions));
  library.setTime(entry, static_cast<time_t>(member.time), 0);
  library.setSize(entry, static_cast<int64_t>(member.byteCount));
  library.setFileType(entry, AE_IFREG);
  for (const auto& [kind, type] : kTarKinds)
    if (member.kind == kind) library.setFileType(entry, type);
  if (member.kind == TarMember::Kind::HardLink) library.setHardLink(entry, member.target.c_str());
  if (member.kind == TarMember::Kind::SymbolicLink) library.setSymbolicLink(entry, member.target.c_str());
  const int status = library.writeHeader(archive_, entry);
  library.freeEntry(entry);
  require(status == ARCHIVE_OK || status == ARCHIVE_WARN);
  missingBytes_ = member.byteCount;
}

void TarWriter::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const la_ssize_t count = archiveLibrary().writeData(archive_, bytes.data(), bytes.size());
    require(count > 0);
    bytes.remove_prefix(static_cast<size_t>(count));
    missingBytes_ -= static_cast<uint64_t>(count);
  }
  if (missingBytes_ == 0) require(archiveLibrary().finishEntry(archive_) == ARCHIVE_OK);  // Also writes its padding.
}

void TarWriter::commit() {
  require(archiveLibrary().closeWriter(archive_) == ARCHIVE_OK);
  sink_->file.commit();
}

void TarWriter::abandon() {
  if (path_ == "-") sink_->file.commit();
  sink_->isClosed = true;
}

}  // namespace asdfvk
