// SPDX-License-Identifier: MIT
#include "ph/detail/core/file_pages.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "ph/error.hpp"

namespace ph {
namespace {

[[noreturn]] void refuse(const std::string& folder, std::size_t bytes, int error) {
  throw Error(ErrorKind::io,
              fmt::format("{}: cannot hold a temporary file of {} MiB: {}; set TMPDIR to another "
                          "folder",
                          folder, bytes >> 20, std::generic_category().message(error)));
}

std::string temporary_folder() {
  std::error_code error;
  const auto folder = std::filesystem::temp_directory_path(error);
  if (error)
    throw Error(ErrorKind::io,
                "no folder for temporary files: " + error.message() + "; set TMPDIR to a folder");
  return folder.string();
}

int open_nameless(const std::string& folder) {
#if defined(O_TMPFILE)
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
#endif
  std::string name = folder + "/ph-XXXXXX";
  const int named = ::mkstemp(name.data());
  if (named < 0) refuse(folder, 0, errno);
  ::unlink(name.c_str());
  return named;
}

}  // namespace

void forget_file_pages(const void* begin, std::size_t bytes) {
  if (bytes == 0) return;
  // The range includes the pages at both ends, even if it covers them only in part. Otherwise a
  // file that is released block by block would leave one page of each block in memory. These pages
  // belong to the mapping, because some of their bytes belong to it.
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = address / page * page;
  ::madvise(reinterpret_cast<void*>(first), address + bytes - first, MADV_DONTNEED);
}

ScratchFile::ScratchFile() : file_(open_nameless(temporary_folder())) {}

ScratchFile::~ScratchFile() {
  if (data_ != nullptr) ::munmap(data_, size_);
  if (file_ >= 0) ::close(file_);
}

void ScratchFile::resize(std::size_t bytes) {
  if (bytes == size_) return;
  // Disk space is reserved now. Otherwise a later write to a mapped page would end the program if
  // the disk is full.
  const auto length = static_cast<off_t>(bytes);
  const int error = bytes > size_ ? ::posix_fallocate(file_, 0, length)
                                  : (::ftruncate(file_, length) == 0 ? 0 : errno);
  if (error != 0) refuse(temporary_folder(), bytes, error);
  if (data_ != nullptr) ::munmap(data_, size_);
  data_ = nullptr;
  size_ = bytes;
  if (bytes == 0) return;
  void* const address = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (address == MAP_FAILED) {
    size_ = 0;
    refuse(temporary_folder(), bytes, errno);
  }
  data_ = static_cast<char*>(address);
}

ResidentFiles::ResidentFiles() : file_(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC)) {}

ResidentFiles::~ResidentFiles() {
  if (file_ >= 0) ::close(file_);
}

std::size_t ResidentFiles::bytes() const {
  // The fields count pages. They are all pages, resident pages, resident pages of files and shared
  // memory, …
  std::array<char, 128> text{};
  const ssize_t got = ::pread(file_, text.data(), text.size() - 1, 0);
  std::size_t pages = 0;
  const char* at = text.data();
  const char* const end = at + std::max(got, ssize_t{0});
  for (int column = 0; column < 3; ++column) {
    const auto [next, error] = std::from_chars(at, end, pages);
    if (error != std::errc{}) return 0;
    at = std::find_if(next, end, [](char c) { return c != ' '; });
  }
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace ph
