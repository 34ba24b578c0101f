// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <utility>

namespace ph {

/// Tells the system that this range of a mapped file is not needed for now: the range is dropped
/// from the process's memory, and is read from the file again when it is touched. The same happens
/// to bytes that share a page with the ends of the range. The call is only a hint. Precondition:
/// the range belongs to a mapped file, and the mapping is shared or never written to.
void forget_file_pages(const void* begin, std::size_t bytes);

/// Memory in a nameless file in the folder for temporary files (TMPDIR): parts that are not in use
/// can be dropped from the process's memory (see `forget_file_pages`). The bytes are zero at first.
/// Move only.
class ScratchFile {
 public:
  /// Both constructors throw Error (io) if there is no such folder or no room in it.
  ScratchFile();
  explicit ScratchFile(std::size_t bytes) : ScratchFile() { resize(bytes); }
  ScratchFile(ScratchFile&& other) noexcept
      : file_(std::exchange(other.file_, -1)),
        data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)) {}
  ScratchFile& operator=(ScratchFile&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~ScratchFile();

  char* data() { return data_; }
  const char* data() const { return data_; }
  std::size_t size() const { return size_; }
  /// Changes the size and keeps the content; addresses change. @throws as the constructors.
  void resize(std::size_t bytes);

 private:
  int file_ = -1;
  char* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Measures how many bytes of mapped files are in the memory of the process.
class ResidentFiles {
 public:
  ResidentFiles();
  ResidentFiles(const ResidentFiles&) = delete;
  ResidentFiles& operator=(const ResidentFiles&) = delete;
  ~ResidentFiles();
  /// The number of these bytes, or 0 if the system does not report it. The call is quick, and
  /// several threads may make it at once.
  std::size_t bytes() const;

 private:
  int file_;
};

}  // namespace ph
