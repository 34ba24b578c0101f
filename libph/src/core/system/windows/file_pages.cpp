// SPDX-License-Identifier: MIT
#include "ph/detail/core/file_pages.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#include <windows.h>

#include <filesystem>
#include <random>
#include <string>
#include <system_error>

#include "ph/error.hpp"

namespace ph {
namespace {

[[noreturn]] void refuse(const std::string& folder, std::size_t bytes, const std::string& why) {
  throw Error(
      ErrorKind::io,
      fmt::format("{}: cannot hold a temporary file of {} MiB: {}; set TMP to another folder",
                  folder, bytes >> 20, why));
}

std::string last_error() {
  return std::error_code(static_cast<int>(GetLastError()), std::system_category()).message();
}

std::filesystem::path temporary_folder() {
  std::error_code error;
  auto folder = std::filesystem::temp_directory_path(error);
  if (error)
    throw Error(ErrorKind::io,
                "no folder for temporary files: " + error.message() + "; set TMP to a folder");
  return folder;
}

/// Opens a temporary file. The system deletes it when it is closed, even if the process crashes.
int open_temporary(const std::filesystem::path& folder) {
  std::random_device random;
  int file = -1, error = 0;
  for (int attempt = 0; attempt < 16; ++attempt) {
    const auto name = folder / fmt::format("ph-{:08x}{:08x}", random(), random());
    error = _wsopen_s(&file, name.c_str(),
                      _O_CREAT | _O_EXCL | _O_RDWR | _O_BINARY | _O_TEMPORARY | _O_NOINHERIT,
                      _SH_DENYNO, _S_IREAD | _S_IWRITE);
    if (error != EEXIST) break;
  }
  if (error != 0) refuse(folder.string(), 0, std::generic_category().message(error));
  return file;
}

HANDLE handle_of(int file) { return reinterpret_cast<HANDLE>(_get_osfhandle(file)); }

}  // namespace

void forget_file_pages(const void* begin, std::size_t bytes) {
  // Unlocking pages that are not locked removes them from the process's memory.
  if (bytes > 0) VirtualUnlock(const_cast<void*>(begin), bytes);
}

ScratchFile::ScratchFile() : file_(open_temporary(temporary_folder())) {}

ScratchFile::~ScratchFile() {
  if (data_ != nullptr) UnmapViewOfFile(data_);
  if (file_ >= 0) _close(file_);
}

void ScratchFile::resize(std::size_t bytes) {
  if (bytes == size_) return;
  // The length of a mapped file cannot change.
  if (data_ != nullptr) UnmapViewOfFile(data_);
  data_ = nullptr;
  size_ = 0;
  const errno_t error = _chsize_s(file_, static_cast<__int64>(bytes));
  if (error != 0)
    refuse(temporary_folder().string(), bytes, std::generic_category().message(error));
  if (bytes == 0) return;
  const HANDLE mapping =
      CreateFileMappingW(handle_of(file_), nullptr, PAGE_READWRITE, 0, 0, nullptr);
  if (mapping == nullptr) refuse(temporary_folder().string(), bytes, last_error());
  void* const address = MapViewOfFile(mapping, FILE_MAP_ALL_ACCESS, 0, 0, bytes);
  const std::string why = address == nullptr ? last_error() : "";
  CloseHandle(mapping);  // the view keeps the mapping
  if (address == nullptr) refuse(temporary_folder().string(), bytes, why);
  data_ = static_cast<char*>(address);
  size_ = bytes;
}

// The system does not report how much of the working set belongs to files.
ResidentFiles::ResidentFiles() : file_(-1) {}
ResidentFiles::~ResidentFiles() = default;
std::size_t ResidentFiles::bytes() const { return 0; }

}  // namespace ph
