#pragma once

#include <archive.h>
#include <archive_entry.h>

namespace asdfvk {

/// NAME(field, function): the functions of libarchive that asdf-vk calls.
#define ASDFVK_ARCHIVE_FUNCTIONS(NAME)                      \
  NAME(errorString, archive_error_string)                   \
  NAME(filterBytes, archive_filter_bytes)                   \
  NAME(newReader, archive_read_new)                         \
  NAME(freeReader, archive_read_free)                       \
  NAME(readTar, archive_read_support_format_tar)            \
  NAME(readGzip, archive_read_support_filter_gzip)          \
  NAME(readBzip2, archive_read_support_filter_bzip2)        \
  NAME(readXz, archive_read_support_filter_xz)              \
  NAME(readZstd, archive_read_support_filter_zstd)          \
  NAME(readLz4, archive_read_support_filter_lz4)            \
  NAME(setReadOptions, archive_read_set_options)            \
  NAME(openReader, archive_read_open)                       \
  NAME(nextHeader, archive_read_next_header)                \
  NAME(readData, archive_read_data)                         \
  NAME(newWriter, archive_write_new)                        \
  NAME(freeWriter, archive_write_free)                      \
  NAME(writeGnuTar, archive_write_set_format_gnutar)        \
  NAME(writeGzip, archive_write_add_filter_gzip)            \
  NAME(writeZstd, archive_write_add_filter_zstd)            \
  NAME(setFilterOption, archive_write_set_filter_option)    \
  NAME(setBytesPerBlock, archive_write_set_bytes_per_block) \
  NAME(openWriter, archive_write_open)                      \
  NAME(failWriter, archive_write_fail)                      \
  NAME(closeWriter, archive_write_close)                    \
  NAME(writeHeader, archive_write_header)                   \
  NAME(writeData, archive_write_data)                       \
  NAME(finishEntry, archive_write_finish_entry)             \
  NAME(newEntry, archive_entry_new)                         \
  NAME(freeEntry, archive_entry_free)                       \
  NAME(pathOf, archive_entry_pathname)                      \
  NAME(utf8PathOf, archive_entry_pathname_utf8)             \
  NAME(hardLinkOf, archive_entry_hardlink)                  \
  NAME(symbolicLinkOf, archive_entry_symlink)               \
  NAME(fileTypeOf, archive_entry_filetype)                  \
  NAME(sizeOf, archive_entry_size)                          \
  NAME(permissionsOf, archive_entry_perm)                   \
  NAME(timeOf, archive_entry_mtime)                         \
  NAME(setPath, archive_entry_set_pathname)                 \
  NAME(setHardLink, archive_entry_set_hardlink)             \
  NAME(setSymbolicLink, archive_entry_set_symlink)          \
  NAME(setFileType, archive_entry_set_filetype)             \
  NAME(setSize, archive_entry_set_size)                     \
  NAME(setPermissions, archive_entry_set_perm)              \
  NAME(setTime, archive_entry_set_mtime)

struct ArchiveLibrary {
#define ASDFVK_ARCHIVE_POINTER(field, function) decltype(&::function) field = nullptr;
  ASDFVK_ARCHIVE_FUNCTIONS(ASDFVK_ARCHIVE_POINTER)
#undef ASDFVK_ARCHIVE_POINTER
};

/// Loads libarchive at the first call. The programs are not linked with it, because it and the libraries that it needs
/// take 2.6 ms of each start. Throws Error{UnreadableInput} if it is not installed.
[[nodiscard]] const ArchiveLibrary& archiveLibrary();

}  // namespace asdfvk
