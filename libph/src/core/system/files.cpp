// SPDX-License-Identifier: MIT
#include "ph/detail/core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <system_error>

namespace ph::files {
namespace {

constexpr int kPollMilliseconds = 50;  // a waiting read notices a stop request within this time

Status from(const struct stat& status) {
  return {S_ISREG(status.st_mode)   ? Kind::regular
          : S_ISDIR(status.st_mode) ? Kind::folder
                                    : Kind::other,
          static_cast<std::uint64_t>(status.st_size), status.st_dev, status.st_ino};
}

/// A random name in `folder`, which most likely no other file has. It does not contain the final
/// name of the file, because that name may already have the maximum length.
std::filesystem::path fresh_name(const std::filesystem::path& folder) {
  std::uint64_t random = 0;
  // getrandom never returns fewer than 8 bytes. If it fails (on an old kernel), the process id
  // makes the name distinct.
  if (::getrandom(&random, sizeof random, 0) < 0) random = static_cast<std::uint64_t>(::getpid());
  return folder / fmt::format(".ph-{:016x}.tmp", random);
}

}  // namespace

std::optional<Status> status_of(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;  // mutant: file-link
  return from(status);
}

std::optional<Status> status_of(int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0) return std::nullopt;
  return from(status);
}

bool close(int file) { return ::close(file) == 0; }

int open_to_read(const std::filesystem::path& path) {
  // Without O_NONBLOCK, a stop request could not interrupt the opening of a FIFO that has no
  // writer.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
  struct stat status {};
  if (file < 0 || ::fstat(file, &status) != 0 || !S_ISDIR(status.st_mode)) return file;
  ::close(file);
  errno = EISDIR;
  return -1;
}

void pass_bytes(int) {}

bool is_at_start(int file) { return ::lseek(file, 0, SEEK_CUR) == 0; }

std::ptrdiff_t read_some(int file, char* to, std::size_t most) {
  pollfd waiting{file, POLLIN, 0};
  const int ready = ::poll(&waiting, 1, kPollMilliseconds);
  const ssize_t got = ready == 0 || (ready < 0 && errno == EINTR) ? -1 : ::read(file, to, most);
  if (ready == 0 || (got < 0 && errno == EINTR)) errno = EAGAIN;
  return got;
}

char* map_to_read(int file, std::size_t bytes) {
  void* const address = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, file, 0);
  if (address == MAP_FAILED) return nullptr;
  ::madvise(address, bytes, MADV_SEQUENTIAL);
  return static_cast<char*>(address);
}

void unmap(char* data, std::size_t bytes) { ::munmap(data, bytes); }

std::filesystem::path resolved(const std::filesystem::path& path) {
  const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr),
                                                         &std::free);
  if (!real && errno == ENOMEM) throw std::bad_alloc();
  return real ? std::filesystem::path(real.get()) : path;
}

std::optional<int> descriptor_named(std::filesystem::path path) {
  constexpr int kMostLinks = 40;  // the limit of the system
  std::error_code error;
  for (int links = 0; links <= kMostLinks; ++links) {
    const std::string name = path.filename();
    int number = 0;
    const char* const end = name.data() + name.size();
    if (const auto read = std::from_chars(name.data(), end, number);
        read.ec == std::errc() && read.ptr == end) {
      const auto folder = resolved(path.has_parent_path() ? path.parent_path() : ".");
      if (folder == resolved("/proc/self/fd") || folder == resolved("/proc/thread-self/fd"))
        return number;
    }
    const auto target = std::filesystem::read_symlink(path, error);
    if (error) return std::nullopt;
    path = path.parent_path() / target;
  }
  return std::nullopt;
}

bool may_write(int file) {
  const int flags = ::fcntl(file, F_GETFL);
  if (flags < 0) return false;
  errno = EBADF;
  return (flags & O_ACCMODE) != O_RDONLY;
}

bool may_write(const std::filesystem::path& path) { return ::access(path.c_str(), W_OK) == 0; }

bool may_replace(const std::filesystem::path& path) {
  struct statx file {};
  struct stat folder {};
  // If statx fails, renaming the file will report the error.
  if (::statx(AT_FDCWD, path.c_str(), 0, STATX_UID, &file) != 0 ||
      ::stat(path.parent_path().c_str(), &folder) != 0)
    return true;
  const uid_t user = ::geteuid();
  const bool is_kept_by_folder =
      (folder.st_mode & S_ISVTX) != 0 && user != 0 && file.stx_uid != user && folder.st_uid != user;
  errno = (file.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0 ? EBUSY : EPERM;
  return !is_kept_by_folder &&
         (file.stx_attributes & (STATX_ATTR_MOUNT_ROOT | STATX_ATTR_APPEND)) == 0;
}

int open_to_write(const std::filesystem::path& path) {
  int file = -1;
  do {
    file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  } while (file < 0 && errno == EINTR);
  return file;
}

int create_in(const std::filesystem::path& folder, std::filesystem::path& name) {
  // A file without a name gets its name later through /proc. Not all file systems support such
  // files.
  if (::access("/proc/self/fd", X_OK) == 0) {
    const int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (file >= 0) return file;
  }
  for (int attempt = 0; attempt < 16; ++attempt) {
    auto fresh = fresh_name(folder);
    const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      name = std::move(fresh);
      return file;
    }
    if (errno != EEXIST) break;
  }
  return -1;
}

bool take_mode(int file, const std::filesystem::path& of) {
  struct stat status {};
  // Leaves out the set-user-ID and set-group-ID bits, because they were granted to the old content.
  // mutant: output-mode
  if (::stat(of.c_str(), &status) != 0 || ::fchmod(file, status.st_mode & 0777) != 0) return false;
  if (::fchown(file, status.st_uid, status.st_gid) != 0)
    static_cast<void>(!::fchown(file, static_cast<uid_t>(-1), status.st_gid));
  return true;
}

std::ptrdiff_t write_some(int file, const char* from, std::size_t most) {
  for (;;) {
    const ssize_t written = ::write(file, from, most);
    if (written >= 0) return written;
    if (errno == EAGAIN || errno == EWOULDBLOCK) {
      // Another program has made standard output non-blocking, so this waits until there is room.
      pollfd room{file, POLLOUT, 0};
      if (::poll(&room, 1, -1) < 0 && errno != EINTR) return -1;
    } else if (errno != EINTR) {
      return -1;
    }
  }
}

bool sync(int file) {
  // Some file systems cannot sync. This does not count as an error.
  return ::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

std::filesystem::path name_in(int file, const std::filesystem::path& folder) {
  const std::string unnamed = fmt::format("/proc/self/fd/{}", file);
  auto name = fresh_name(folder);
  if (::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0)
    return {};
  return name;
}

bool rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  return ::rename(from.c_str(), to.c_str()) == 0;
}

void sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  static_cast<void>(::fsync(file));
  ::close(file);
}

void remove(const std::filesystem::path& path) { ::unlink(path.c_str()); }

}  // namespace ph::files
