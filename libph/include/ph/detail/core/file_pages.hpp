// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <utility>

namespace ph {

/// Says that what was read or written of a mapped file in this range is not needed for now: it
/// leaves the process's memory and comes back from the file when it is touched. So does what shares
/// a page with its ends. A hint. Precondition: all of it is a file that is mapped, shared or never
/// written to.
void forget_file_pages(const void* begin, std::size_t bytes);

/// Memory that is a file without a name, in the folder for temporary files (TMPDIR): what is not in
/// use can leave the process's memory, see `forget_file_pages`. Zero at first. Move only.
class ScratchFile {
 public:
  /// Both throw Error (io) if there is no such folder, or no room in it.
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
  /// Keeps what is there; addresses change. @throws as the constructors.
  void resize(std::size_t bytes);

 private:
  int file_ = -1;
  char* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Tells how much of mapped files is in the memory of the process.
class ResidentFiles {
 public:
  ResidentFiles();
  ResidentFiles(const ResidentFiles&) = delete;
  ResidentFiles& operator=(const ResidentFiles&) = delete;
  ~ResidentFiles();
  /// 0 where the system does not say. Quick; for several threads.
  std::size_t bytes() const;

 private:
  int file_;
};

}  // namespace ph
