// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <ostream>
#include <span>
#include <streambuf>
#include <string>
#include <string_view>

#include "ph/error.hpp"

namespace ph {

/// The reader of our output went away: the one output error that a program keeps quiet about.
class BrokenPipe : public Error {
 public:
  BrokenPipe() : Error(ErrorKind::io, "broken pipe") {}
};

/// @throws Error (usage) if the name of an output promises a packed file (.gz and the like), which
/// nothing writes.
void require_unpacked(const std::string& path);

/// A file that appears under its name only when it is complete.
///
/// A regular file is written into an unnamed or temporary file in the same folder, which `commit`
/// flushes to disk and renames; it may be the program's own input. Without `commit` nothing is left
/// behind. What cannot be replaced is written directly: "-" (standard output), /dev/stdout and
/// other names of descriptors, the file that standard output goes to, devices, FIFOs. A symbolic
/// link is followed. A file that is replaced passes on its mode, but for set-ID bits, and its owner
/// and group where that is allowed.
class OutputFile {
 public:
  /// @param path "-" for standard output.
  /// @throws Error (cannot_create) if the file cannot be created where it shall be, Error (usage)
  ///         as require_unpacked.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;

  /// Appends bytes. @throws Error (io) if they cannot be written, BrokenPipe if nobody reads them.
  void write(std::string_view bytes);
  void write(std::span<const std::byte> bytes) {
    write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }
  /// Hands over what was written so far: whoever reads along sees it now.
  /// @throws Error (io), BrokenPipe.
  void flush();
  /// Waits until what was written is on the disk; where that cannot be asked for it does nothing.
  /// @throws Error (io), BrokenPipe.
  void sync();
  /// Completes the file, synchronised, and gives it its name. Nothing may be written afterwards.
  /// @throws Error (io or cannot_create), BrokenPipe.
  void commit();

  const std::string& path() const { return path_; }
  /// The name that the file has until `commit`; empty where it has none. For whoever must end the
  /// process without unwinding.
  std::string temporary_path() const { return temporary_.string(); }

 private:
  void open_regular();
  void discard() noexcept;
  [[noreturn]] void fail_writing(int error) const;

  std::string path_;  // as the user gave it
  // Paths, not texts: to remove a file must need no memory.
  std::filesystem::path target_;     // the regular file to become; empty: written directly
  std::filesystem::path temporary_;  // name until then; empty: none
  std::string buffer_;
  int descriptor_ = -1;
  bool owned_ = false;  // whether to close the descriptor
};

/// A stream into an output file, for writers that take a std::ostream. Errors of the file pass
/// through as exceptions.
class OutputStream : private std::streambuf, public std::ostream {
 public:
  explicit OutputStream(OutputFile& file);
  ~OutputStream() override;

 private:
  using Byte = std::streambuf::int_type;
  Byte overflow(Byte c) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override;

  OutputFile& file_;
};

/// Writes a whole file at once.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace ph
