// SPDX-License-Identifier: MIT
#include "ph/detail/io/output_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "ph/detail/core/files.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

[[noreturn]] void fail_creating(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::cannot_create,
              fmt::format("{}: cannot create the output: {}", printable(path), why));
}

/// Reports that an existing file cannot be replaced. The constructor finds most such problems
/// before anything is computed.
[[noreturn]] void fail_replacing(const std::string& path, int error) {
  std::string why = files::reason(error);
  if (error == EBUSY || error == EPERM)
    why +=
        ": no new file can replace it, expected another name, or '-' with standard output "
        "redirected into it";
  fail_creating(path, why);
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

/// The descriptor to write to if `path` names an open descriptor or a file to which standard output
/// or standard error is redirected. Opening this file again, or replacing it, would lose its
/// content. Returns nothing for any other path.
std::optional<int> descriptor_of(const std::string& path) {
  if (path == "-") return files::kStandardOutput;
  if (const auto named = files::descriptor_named(files::path_of(path))) return named;
  const auto file = files::status_of(files::path_of(path));
  if (!file || file->kind != files::Kind::regular) return std::nullopt;
  // mutant: output-log
  for (const int standard : {files::kStandardOutput, files::kStandardError}) {
    const auto open = files::status_of(standard);
    if (open && open->device == file->device && open->inode == file->inode &&
        files::may_write(standard))
      return standard;
  }
  return std::nullopt;
}

}  // namespace

void require_unpacked(const std::string& path) {
  constexpr std::array<std::string_view, 6> kPacked{".gz", ".bz2", ".xz", ".zst", ".zip", ".7z"};
  for (const std::string_view packed : kPacked)
    if (ends_in(path, packed))  // mutant: output-packed
      throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected a name without this "
                                                "ending, because outputs are not compressed",
                                                printable(path), packed));
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  require_unpacked(path_);
  if (path_.empty()) fail_creating(path_, "the name is empty");
  if (const auto descriptor = descriptor_of(path_)) {
    if (path_ != "-" && !files::may_write(*descriptor)) fail_creating(path_, files::reason(errno));
    descriptor_ = *descriptor;
    files::pass_bytes(descriptor_);
    return;
  }
  const auto status = files::status_of(files::path_of(path_));
  if (!status) {
    if (errno != ENOENT) fail_creating(path_, files::reason(errno));
    if (!files::path_of(path_).has_filename()) fail_creating(path_, "there is no such folder");
    target_ = files::path_of(path_);
  } else if (status->kind == files::Kind::folder) {
    fail_creating(path_, "it is a folder");
  } else if (status->kind == files::Kind::regular) {
    target_ = files::resolved(files::path_of(path_));
    if (!files::may_write(target_)) fail_creating(path_, files::reason(errno));
    if (!files::may_replace(target_)) fail_replacing(path_, errno);
  } else {
    descriptor_ = files::open_to_write(files::path_of(path_));
    if (descriptor_ < 0) fail_creating(path_, files::reason(errno));
    owned_ = true;
    return;
  }
  open_regular();
  if (status && !files::take_mode(descriptor_, target_)) {
    const int error = errno;
    discard();
    fail_creating(path_, files::reason(error));
  }
}

void OutputFile::open_regular() {
  owned_ = true;
  descriptor_ = files::create_in(folder_of(target_), temporary_);
  if (descriptor_ < 0) fail_creating(path_, files::reason(errno));
}

OutputFile::~OutputFile() {
  if (is_pending_ && std::uncaught_exceptions() <= exceptions_) end_process();
  discard();
}

void OutputFile::end_process() noexcept {
  discard();
  try {
    throw Error(ErrorKind::usage,
                fmt::format("{}: found an OutputFile at its end with bytes that are not committed, "
                            "expected commit() or discard() before",
                            path_ == "-" ? "standard output" : printable(path_)));
  } catch (...) {
    // While the handler is active, the default terminate handler prints the message.
    std::terminate();
  }
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      owned_(std::exchange(other.owned_, false)),
      is_pending_(std::exchange(other.is_pending_, false)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  if (this == &other) return *this;
  if (is_pending_) end_process();
  discard();
  path_ = std::move(other.path_);
  target_ = std::move(other.target_);
  temporary_ = std::exchange(other.temporary_, {});
  buffer_ = std::move(other.buffer_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  owned_ = std::exchange(other.owned_, false);
  is_pending_ = std::exchange(other.is_pending_, false);
  return *this;
}

void OutputFile::discard() noexcept {
  if (owned_ && descriptor_ >= 0) files::close(descriptor_);
  // The file is closed first, because some systems cannot remove open files.
  if (!temporary_.empty()) files::remove(temporary_);
  temporary_.clear();
  descriptor_ = -1;
  owned_ = false;
  is_pending_ = false;
}

void OutputFile::write(std::string_view bytes) {
  is_pending_ = true;
  buffer_.append(bytes);
  if (buffer_.size() >= kBufferBytes) flush();
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const std::ptrdiff_t written = files::write_some(descriptor_, rest.data(), rest.size());
    if (written < 0) fail_writing(errno);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void OutputFile::sync() {
  flush();
  if (target_.empty()) return;
  if (!files::sync(descriptor_)) fail_writing(errno);
}

void OutputFile::commit() {
  is_pending_ = false;  // from here on, exceptions say what is wrong
  sync();
  if (target_.empty()) {
    if (owned_ && !files::close(std::exchange(descriptor_, -1))) fail_writing(errno);
    owned_ = false;
    discard();
    return;
  }
  const auto folder = folder_of(target_);
  if (temporary_.empty()) {
    // A link cannot replace an existing file. The file therefore gets a temporary name first, and
    // is then renamed.
    temporary_ = files::name_in(descriptor_, folder);
    if (temporary_.empty()) fail_creating(path_, files::reason(errno));
  }
  // The file is closed first, because some systems cannot rename open files. Its content is already
  // on the disk.
  static_cast<void>(files::close(std::exchange(descriptor_, -1)));
  if (!files::rename(temporary_, target_)) fail_replacing(path_, errno);
  temporary_.clear();
  discard();
  // The new name is permanent only after the folder has been written to the disk. If this fails,
  // the file is still complete.
  files::sync_folder(folder);
}

void OutputFile::fail_writing(int error) {
  discard();
  if (error == EPIPE) throw BrokenPipe();
  throw Error(ErrorKind::io, fmt::format("{}: cannot write: {}",
                                         path_ == "-" ? "standard output" : printable(path_),
                                         files::reason(error)));
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
