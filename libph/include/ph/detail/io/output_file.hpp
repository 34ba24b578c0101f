// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <ostream>
#include <span>
#include <streambuf>
#include <string>
#include <string_view>

#include "ph/error.hpp"

namespace ph {

/// Thrown when the reader of the output has closed it. It is the only output error that a program
/// does not report.
class BrokenPipe : public Error {
 public:
  BrokenPipe() : Error(ErrorKind::io, "broken pipe") {}
};

/// @throws Error (usage) if the name of an output promises a compressed file (.gz and the like),
/// because libph writes none.
void require_unpacked(const std::string& path);

/// A file that appears under its name only when it is complete.
///
/// A regular file is written into an unnamed or temporary file in the same folder, which `commit`
/// flushes to disk and renames; the output may therefore be one of the program's own inputs.
/// Without `commit` nothing is left behind, and a caller that forgets it is stopped: the destructor
/// ends the process, like that of std::thread, if bytes were written, no exception is on its way,
/// and neither `commit` nor `discard` was called. The default terminate handler prints an error
/// that names the file. Some targets cannot be replaced and are written directly: "-" (standard
/// output), /dev/stdout and other names of descriptors, the file to which standard output or
/// standard error is redirected, devices, FIFOs. A symbolic link is followed. The new file takes
/// the mode of the file that it replaces, except for set-ID bits, and also the owner and group if
/// that is allowed.
class OutputFile {
 public:
  /// @param path "-" for standard output.
  /// @throws Error (cannot_create) if the file cannot be created at its place, Error (usage) as
  ///         require_unpacked.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;

  /// Appends bytes. @throws Error (io) if they cannot be written, BrokenPipe if nobody reads them.
  void write(std::string_view bytes);
  void write(std::span<const std::byte> bytes) {
    write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }
  /// Passes on everything written so far; a program that follows the output can then read it.
  /// @throws Error (io), BrokenPipe.
  void flush();
  /// Waits until the bytes written are on the disk; does nothing if the system cannot do this.
  /// @throws Error (io), BrokenPipe.
  void sync();
  /// Completes the file, flushes it to disk and gives it its name. Nothing may be written after
  /// that.
  /// @throws Error (io or cannot_create), BrokenPipe.
  void commit();
  /// Gives up the file. What was written to a target that cannot be replaced stays there.
  void discard() noexcept;

  const std::string& path() const { return path_; }
  /// The name of the file before `commit`; empty if it has none. For a caller that must end the
  /// process without unwinding.
  std::string temporary_path() const { return temporary_.string(); }

 private:
  void open_regular();
  [[noreturn]] void end_process() noexcept;
  [[noreturn]] void fail_writing(int error);

  std::string path_;  // the name as the user gave it
  // Paths, not texts, because removing a file must not need memory.
  std::filesystem::path target_;     // the regular file to create; empty if written directly
  std::filesystem::path temporary_;  // its name until `commit`; empty if it has none
  std::string buffer_;
  int descriptor_ = -1;
  bool owned_ = false;                           // true if the descriptor must be closed
  bool is_pending_ = false;                      // true if bytes were written and not committed
  int exceptions_ = std::uncaught_exceptions();  // when the file was opened
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

/// Writes an entire file at once.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace ph
