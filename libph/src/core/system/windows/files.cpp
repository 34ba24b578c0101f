// SPDX-License-Identifier: MIT
#include "ph/detail/core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#include <windows.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <random>
#include <system_error>

namespace ph::files {
namespace {

HANDLE handle_of(int file) { return reinterpret_cast<HANDLE>(_get_osfhandle(file)); }

/// Sets errno to match the last error of the system.
void keep_error() {
  const DWORD code = GetLastError();
  const auto condition = std::system_category().default_error_condition(static_cast<int>(code));
  errno = condition.category() == std::generic_category() ? condition.value() : EIO;
}

std::optional<Status> status_of(HANDLE handle) {
  Status status;
  BY_HANDLE_FILE_INFORMATION information{};
  if (GetFileType(handle) != FILE_TYPE_DISK) return status;
  if (GetFileInformationByHandle(handle, &information) == 0) {
    keep_error();
    return std::nullopt;
  }
  status.kind =
      (information.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0 ? Kind::folder : Kind::regular;
  status.size = std::uint64_t{information.nFileSizeHigh} << 32 | information.nFileSizeLow;
  status.device = information.dwVolumeSerialNumber;
  status.inode = std::uint64_t{information.nFileIndexHigh} << 32 | information.nFileIndexLow;
  return status;
}

/// With these flags, line ends are not converted, and child processes do not inherit the file.
constexpr int kBytes = _O_BINARY | _O_NOINHERIT;

int open(const std::filesystem::path& path, int how) {
  int file = -1;
  const errno_t error =
      _wsopen_s(&file, path.c_str(), how | kBytes, _SH_DENYNO, _S_IREAD | _S_IWRITE);
  errno = error;
  return file;
}

unsigned at_most(std::size_t bytes) {
  return static_cast<unsigned>(std::min<std::size_t>(bytes, INT_MAX));
}

}  // namespace

std::optional<Status> status_of(const std::filesystem::path& path) {
  const HANDLE handle =
      CreateFileW(path.c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                  // With this flag, folders can be opened as well.
                  OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
  if (handle == INVALID_HANDLE_VALUE) {
    keep_error();
    return std::nullopt;
  }
  const auto status = status_of(handle);
  CloseHandle(handle);
  return status;
}

std::optional<Status> status_of(int file) {
  const HANDLE handle = handle_of(file);
  if (handle != INVALID_HANDLE_VALUE) return status_of(handle);
  errno = EBADF;
  return std::nullopt;
}

bool close(int file) { return _close(file) == 0; }

int open_to_read(const std::filesystem::path& path) {
  const auto status = status_of(path);
  if (!status) return -1;
  if (status->kind != Kind::folder) return open(path, _O_RDONLY);
  errno = EISDIR;
  return -1;
}

void pass_bytes(int standard) { _setmode(standard, _O_BINARY); }

bool is_at_start(int file) { return _lseeki64(file, 0, SEEK_CUR) == 0; }

std::ptrdiff_t read_some(int file, char* to, std::size_t most) {
  const int got = _read(file, to, at_most(most));
  // The writer has closed the pipe.
  return got < 0 && errno == EPIPE ? 0 : got;
}

char* map_to_read(int file, std::size_t bytes) {
  const HANDLE mapping = CreateFileMappingW(handle_of(file), nullptr, PAGE_READONLY, 0, 0, nullptr);
  if (mapping == nullptr) return nullptr;
  void* const address = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, bytes);
  CloseHandle(mapping);  // the view keeps the mapping
  return static_cast<char*>(address);
}

void unmap(char* data, std::size_t) { UnmapViewOfFile(data); }

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code error;
  auto real = std::filesystem::canonical(path, error);
  return error ? path : real;
}

std::optional<int> descriptor_named(std::filesystem::path path) {
  if (path == "/dev/stdout") return kStandardOutput;
  if (path == "/dev/stderr") return kStandardError;
  return std::nullopt;
}

bool may_write(int) { return true; }

bool may_write(const std::filesystem::path& path) { return _waccess(path.c_str(), 2) == 0; }

bool may_replace(const std::filesystem::path&) { return true; }

int open_to_write(const std::filesystem::path& path) { return open(path, _O_WRONLY); }

int create_in(const std::filesystem::path& folder, std::filesystem::path& name) {
  std::random_device random;
  for (int attempt = 0; attempt < 16; ++attempt) {
    auto fresh = folder / fmt::format(".ph-{:08x}{:08x}.tmp", random(), random());
    // With FILE_SHARE_DELETE, the open file can be deleted if the process has to end.
    const HANDLE handle =
        CreateFileW(fresh.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr,
                    CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (handle != INVALID_HANDLE_VALUE) {
      name = std::move(fresh);
      return _open_osfhandle(reinterpret_cast<std::intptr_t>(handle), kBytes | _O_WRONLY);
    }
    keep_error();
    if (errno != EEXIST) break;
  }
  return -1;
}

// Windows has only one mode bit, which forbids writing. A file with this bit would not be replaced.
bool take_mode(int, const std::filesystem::path&) { return true; }

std::ptrdiff_t write_some(int file, const char* from, std::size_t most) {
  const int written = _write(file, from, at_most(most));
  if (written < 0 && _doserrno == ERROR_NO_DATA) errno = EPIPE;
  return written;
}

bool sync(int file) {
  return FlushFileBuffers(handle_of(file)) != 0 || GetLastError() != ERROR_DISK_FULL;
}

std::filesystem::path name_in(int, const std::filesystem::path&) {
  errno = ENOTSUP;  // this is not supported, because every file has a name
  return {};
}

bool rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
    return true;
  keep_error();
  return false;
}

void sync_folder(const std::filesystem::path&) {}  // `rename` waits for the disk

void remove(const std::filesystem::path& path) { _wunlink(path.c_str()); }

}  // namespace ph::files
