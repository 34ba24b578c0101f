// SPDX-License-Identifier: MIT
#include "ph/detail/io/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "ph/detail/io/reader.hpp"

namespace ph {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

std::string words_for(int error) {
  return std::error_code(error, std::generic_category()).message();
}

[[noreturn]] void fail_creating(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::cannot_create,
              fmt::format("{}: cannot create the output: {}", printable(path), why));
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

/// A name in `folder` that nobody else has. It does not contain the final name, which may be as
/// long as names can be.
std::string fresh_name(const std::string& folder) {
  std::uint64_t random = 0;
  // Never short for 8 bytes; a failure (an ancient kernel) leaves the process id to tell us apart.
  if (getrandom(&random, sizeof random, 0) < 0) random = static_cast<std::uint64_t>(getpid());
  return fmt::format("{}/.ph-{:016x}.tmp", folder, random);
}

/// The descriptor that a name like /dev/stdout or /dev/fd/3 stands for. Opening such a name anew
/// would write over what the descriptor's owner has written already.
std::optional<int> descriptor_named(std::string_view path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    const std::string_view digits = path.substr(folder.size());
    if (digits.empty() || digits.size() > 4) return std::nullopt;
    int number = 0;
    for (const char c : digits) {
      if (c < '0' || c > '9') return std::nullopt;
      number = 10 * number + (c - '0');
    }
    return number;
  }
  return std::nullopt;
}

std::string resolved(const std::string& path) {
  const std::unique_ptr<char, decltype(&std::free)> real(realpath(path.c_str(), nullptr),
                                                         &std::free);
  if (!real && errno == ENOMEM) throw std::bad_alloc();
  return real ? std::string(real.get()) : path;
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  if (path_.empty()) fail_creating(path_, "the name is empty");
  if (const auto descriptor = descriptor_named(path_)) {
    descriptor_ = *descriptor;
    return;
  }
  struct stat status {};
  if (stat(path_.c_str(), &status) != 0) {
    if (errno != ENOENT) fail_creating(path_, words_for(errno));
    if (path_.back() == '/') fail_creating(path_, "there is no such folder");
    target_ = path_;
  } else if (S_ISDIR(status.st_mode)) {
    fail_creating(path_, "it is a folder");
  } else if (S_ISREG(status.st_mode)) {
    target_ = resolved(path_);
    if (access(target_.c_str(), W_OK) != 0) fail_creating(path_, words_for(errno));
  } else {
    do {
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    } while (descriptor_ < 0 && errno == EINTR);
    if (descriptor_ < 0) fail_creating(path_, words_for(errno));
    owned_ = true;
    return;
  }
  open_regular();
  // The file that is replaced passes its mode on.
  if (status.st_mode != 0 && fchmod(descriptor_, status.st_mode & 07777) != 0) {
    const int error = errno;
    discard();
    fail_creating(path_, words_for(error));
  }
}

void OutputFile::open_regular() {
  const std::string folder = folder_of(target_);
  owned_ = true;
  // A file without a name vanishes with the process, however that ends. Naming it later goes
  // through /proc. Not all file systems have such files.
  if (access("/proc/self/fd", X_OK) == 0) {
    descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) return;
  }
  for (int attempt = 0; attempt < 16; ++attempt) {
    std::string name = fresh_name(folder);
    descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
      temporary_ = std::move(name);
      return;
    }
    if (errno != EEXIST) break;
  }
  fail_creating(path_, words_for(errno));
}

OutputFile::~OutputFile() { discard(); }

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      owned_(std::exchange(other.owned_, false)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  path_ = std::move(other.path_);
  target_ = std::move(other.target_);
  temporary_ = std::exchange(other.temporary_, {});
  buffer_ = std::move(other.buffer_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  owned_ = std::exchange(other.owned_, false);
  return *this;
}

void OutputFile::discard() noexcept {
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
  if (owned_ && descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  owned_ = false;
}

void OutputFile::write(std::string_view bytes) {
  buffer_.append(bytes);
  if (buffer_.size() >= kBufferBytes) flush();
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      // Somebody made our standard output non-blocking: wait until there is room.
      pollfd room{descriptor_, POLLOUT, 0};
      if (::poll(&room, 1, -1) < 0 && errno != EINTR) fail_writing(errno);
    } else if (errno != EINTR) {
      fail_writing(errno);
    }
  }
  buffer_.clear();
}

void OutputFile::sync() {
  flush();
  if (target_.empty()) return;
  // Some file systems cannot sync; that is no reason to refuse them.
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
    fail_writing(errno);
}

void OutputFile::commit() {
  sync();
  if (target_.empty()) {
    if (owned_ && close(std::exchange(descriptor_, -1)) != 0) fail_writing(errno);
    descriptor_ = -1;
    owned_ = false;
    return;
  }
  const std::string folder = folder_of(target_);
  if (temporary_.empty()) {
    // A link cannot replace a file, so it takes two steps: a temporary name, then the rename.
    std::string name = fresh_name(folder);
    const std::string unnamed = fmt::format("/proc/self/fd/{}", descriptor_);
    if (linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0)
      fail_creating(path_, words_for(errno));
    temporary_ = std::move(name);
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail_creating(path_, words_for(errno));
  temporary_.clear();
  discard();
  // The new name is safe once the folder is; a failure here leaves a complete file all the same.
  const int folder_descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_descriptor >= 0) {
    static_cast<void>(fsync(folder_descriptor));
    close(folder_descriptor);
  }
}

void OutputFile::fail_writing(int error) const {
  if (error == EPIPE) throw BrokenPipe();
  throw Error(ErrorKind::io,
              fmt::format("{}: cannot write: {}",
                          path_ == "-" ? "standard output" : printable(path_), words_for(error)));
}

OutputStream::OutputStream(OutputFile& file) : std::ostream(nullptr), file_(file) {
  rdbuf(this);
  exceptions(std::ios::badbit | std::ios::failbit);
}

OutputStream::~OutputStream() = default;

OutputStream::Byte OutputStream::overflow(Byte c) {
  using Traits = std::streambuf::traits_type;
  if (!Traits::eq_int_type(c, Traits::eof())) {
    const char byte = Traits::to_char_type(c);
    file_.write(std::string_view(&byte, 1));
  }
  return Traits::not_eof(c);
}

std::streamsize OutputStream::xsputn(const char* text, std::streamsize size) {
  file_.write(std::string_view(text, static_cast<std::size_t>(size)));
  return size;
}

int OutputStream::sync() { return 0; }

void write_file(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace ph
