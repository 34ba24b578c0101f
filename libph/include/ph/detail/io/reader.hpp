// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/detail/core/file_pages.hpp"
#include "ph/error.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The bytes of a name or a cell as one printable line: control characters, newlines and bytes that
/// are not UTF-8 become `\n`, `\t` or `\xNN`; a text longer than `max_bytes` is cut and ends in
/// "...".
std::string printable(std::string_view bytes, std::size_t max_bytes = 4096);

/// Splits "FILE.npz:NAME", "FILE.ply:NAME" or "FILE.vti:NAME" into the file and the requested part
/// of it. Any other path, and any path that exists under its full name, stands for the file alone.
std::pair<std::filesystem::path, std::string> split_member(const std::filesystem::path& path);

/// The problem at one place of an input. Empty parts are left out of the message.
struct Fault {
  std::string what;      ///< such as "ragged row"
  std::string found;     ///< such as "2 cells"
  std::string expected;  ///< such as "3 cells, as in line 1"
  Message hint;          ///< advice for the user
};

/// All bytes of a file, of standard input ("-") or of a FIFO, with the name used in messages.
/// Regular files above 16 MiB are mapped (no other program may shorten them meanwhile); smaller
/// files are copied. Streams are read into memory, within the memory budget of the run. Input
/// compressed with gzip is unpacked: its extension is the extension before ".gz", and lines and
/// bytes are counted in the unpacked text. Move only.
class Input {
 public:
  /// The treatment of a regular file that would take more than a third of the memory left in the
  /// budget of the run, before or after it is unpacked.
  enum class Excess {
    refused,
    stays_in_file,  ///< mapped (unpacked data in a temporary file), not counted
    is_expected,    ///< the same for all files but small ones: the caller will read only a part
  };

  /// Refuses data by their first bytes: throws Error (bad_data) if no input of the expected kind
  /// can begin with the bytes of `start`.
  using StartCheck = std::function<void(const Input& start)>;

  /// @param path a file, a FIFO, or "-" for standard input; for a part of a file see split_member.
  /// @param context its memory budget limits a stream, and its stop token is polled; it must
  ///        outlive the input. Without a limit, a stream may take half of the machine's memory.
  /// @param check is called with the first 4 KiB or more of a stream, before the rest is read: a
  ///        stream may have no end. Files and shorter or compressed streams are not checked.
  /// @throws Error (no_input) if the file is missing, unreadable or a directory; Error (io) if
  ///         reading fails partway; Error (resource) if a stream or the unpacked data exceed the
  ///         budget; Error (bad_data) if compressed data are damaged or expand beyond reason, or if
  ///         a stream begins with 1 MiB of NUL bytes, as /dev/zero does.
  static Input open(const std::filesystem::path& path, const RunContext* context = nullptr,
                    Excess excess = Excess::refused, const StartCheck& check = {});
  /// Opens a file as `open` does, but does not unpack it: bytes that look compressed may be data.
  static Input open_stored(const std::filesystem::path& path, const RunContext* context = nullptr,
                           Excess excess = Excess::refused, const StartCheck& check = {});
  /// Unpacks the bytes from `offset` to the end. They are all members of a gzip file, or one zlib
  /// stream, as their first bytes say. @param size the size that a header states for the unpacked
  /// data. @throws as `open`; Error (bad_data) also on bytes that are not compressed.
  Input unpacked(std::size_t offset, std::size_t size, Excess excess) const;
  /// An input without bytes that stands for a folder. @throws Error (no_input) if there is no such
  /// folder; Error (usage) if the path is something else.
  static Input of_folder(const std::filesystem::path& path, const RunContext* context = nullptr);
  /// An input that only views bytes, which must outlive it. @param context as for `open`.
  static Input view(std::string_view bytes, const std::string& name,
                    const RunContext* context = nullptr);
  /// An input that owns its bytes, such as bytes unpacked from another input.
  static Input hold(std::pmr::vector<char> bytes, const std::string& name,
                    const RunContext* context = nullptr);

  /// An input that owns bytes in a file.
  static Input hold(ScratchFile bytes, const std::string& name,
                    const RunContext* context = nullptr);

  Input(Input&& other) noexcept;
  Input& operator=(Input&& other) noexcept;
  ~Input();

  std::string_view text() const { return text_; }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(text_)); }
  std::size_t size() const { return text_.size(); }
  const std::string& name() const { return name_; }            ///< the printable name
  const std::string& extension() const { return extension_; }  ///< in lower case, with its dot
  /// The file or folder that was opened; empty for standard input and for bytes from elsewhere.
  const std::filesystem::path& path() const { return path_; }
  /// The part of an archive or of a mesh that was requested; empty if none was.
  const std::string& member() const { return member_; }
  const RunContext* context() const { return context_; }
  /// True if the input stays in a file and is not counted. Such an input should be read block by
  /// block (see `done_with`).
  bool stays_in_file() const;
  /// Counts the memory of the input from now on, for readers that need the input as a whole.
  /// @throws Error (resource) if it does not fit.
  void take_memory() const;
  /// Announces that these bytes are not needed for now.
  void done_with(std::size_t offset, std::size_t size) const;
  /// Keeps the bytes at their place even after the input is destroyed; from now on they are not
  /// counted. Returns null if they are not in a file.
  std::shared_ptr<const void> keep_in_file() const;

  /// @throws Error (resource) if the run's budget does not allow `bytes` more bytes. Allocates
  /// nothing.
  void require_memory(std::size_t bytes) const;
  /// Reports to the run how many bytes are done, if the run requested progress reports. The system
  /// may drop these bytes of a mapped file from memory, and reads them again if necessary. @throws
  /// Error (cancelled) once a stop was requested.
  void poll(std::size_t done = 0) const;

  /// Throws Error (bad_data): "name: what, found X, expected Y; hint".
  [[noreturn]] void fail(const Fault& fault) const;
  /// Throws Error (bad_data): "name:line:column: …"; lines and columns count from 1, columns in
  /// bytes.
  [[noreturn]] void fail_at(std::size_t line, std::size_t column, const Fault& fault) const;
  /// Throws Error (bad_data): "name: byte N: …"; bytes count from 0.
  [[noreturn]] void fail_at_byte(std::size_t offset, const Fault& fault) const;

 private:
  struct Storage;
  Input();

  std::shared_ptr<Storage> storage_;  // null for a view
  std::string_view text_;
  std::string name_;
  std::string extension_;
  std::string member_;
  std::filesystem::path path_;
  const RunContext* context_ = nullptr;
};

/// The lines of a text input that carry data. Comments and blank lines are skipped; a byte order
/// mark and CRLF are accepted. A comment runs from '#' to the end of the line, unless the '#' is
/// inside a word or quotes, or belongs to a number written by an old Windows program (1.#INF) or to
/// a spreadsheet error such as #N/A.
class TextLines {
 public:
  static constexpr std::size_t kMaxLine = std::size_t{64} << 20;  ///< longest line in bytes

  /// @throws Error (bad_data) if the input is UTF-16, or binary (NUL bytes in its first 4 KiB).
  explicit TextLines(const Input& input);
  /// Starts at byte `offset`, after `lines_before` lines; the text is not tested for NUL bytes.
  TextLines(const Input& input, std::size_t offset, std::size_t lines_before);

  /// From now on tabs do not count as blanks: lines keep tabs at their ends, and a line that
  /// consists of tabs counts as a line with data.
  void keep_tabs() { tab_ = ' '; }
  bool keeps_tabs() const { return tab_ == ' '; }
  /// Goes to the next line with data. @return false at the end.
  /// @throws Error (bad_data) on a line longer than kMaxLine.
  bool next();
  /// The current line, without its comment, line end and surrounding blanks.
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }  ///< number of the current line, from 1
  /// First byte after the current line.
  std::size_t offset() const { return static_cast<std::size_t>(position_ - input_.text().data()); }
  const Input& input() const { return input_; }
  /// Column, counted from 1, of a place inside the current line.
  std::size_t column(const char* place) const {
    return static_cast<std::size_t>(place - start_) + 1;
  }
  /// Throws Error (bad_data) at a place inside the current line.
  [[noreturn]] void fail(const char* place, const Fault& fault) const;

 private:
  const Input& input_;
  const char* position_ = nullptr;  // first byte after the current line
  const char* end_ = nullptr;
  const char* start_ = nullptr;  // first byte of the current line
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t polled_ = 0;  // offset at which the stop token was last polled
  char tab_ = '\t';         // a second blank character in addition to ' '
};

/// The names in a header line: a line without numbers that does not consist of missing values only.
/// Cells are split at commas, semicolons or tabs if there are any, otherwise at blanks; quotes are
/// removed. Empty if the line is not a header.
std::vector<std::string> header_names(std::string_view line);

/// The kinds of numbers that a cell may hold besides finite ones.
enum class Allow {
  finite,
  infinite,
  any,      ///< also NaN and marks of missing values, which are read as NaN
  missing,  ///< also an empty cell before a separator or between quotes, read as NaN
};

/// Advice for the user about a cell that is not a number, if the cell does not explain itself.
struct CellHints {
  Message word = {};     ///< for a cell that holds something else
  Message missing = {};  ///< for an empty cell or NaN
};

/// Splits the current line into cells. The first separator of the first line with two cells
/// (blanks, ',' or ';') is the separator of the file; a different separator is an error, because
/// otherwise a decimal comma could pass for two cells. Blanks around ',' and one separator at the
/// end of the line are accepted. If lines keep their tabs, each tab is a separator as well. A cell
/// may stand between double quotes; separators inside them belong to the cell.
class Cells {
 public:
  /// @param separator the separator after skipped cells, which may hold blanks unless the separator
  ///        is a blank.
  explicit Cells(const TextLines& lines, CellHints hints = {}, char separator = ' ')
      : lines_(&lines),
        hints_(std::move(hints)),
        tab_(lines.keeps_tabs() ? ' ' : '\t'),
        skipped_to_(separator) {}

  /// Starts on the current line.
  void start() { start_in(lines_->line()); }
  /// Starts on a part of the current line.
  void start_in(std::string_view part);
  bool more() const { return position_ != end_; }
  const char* place() const { return position_; }  ///< start of the next cell
  /// Reads one number: decimal, with an optional sign and exponent, regardless of the locale.
  /// @throws Error (bad_data) naming the cell if it is not a number or out of the range of double.
  double number(Allow allow = Allow::finite);
  /// Reads one number in the precision of T, which is float or double.
  template <class T>
  T floating(Allow allow);
  /// Reads one integer from `least` to `most`. @throws Error (bad_data) naming the cell.
  std::int64_t integer(std::int64_t least, std::int64_t most, const char* what);
  /// Reads one integer in 0 … 2^64 - 1.
  std::uint64_t unsigned64(const char* what);
  /// The next cell as it is written.
  std::string_view word();
  /// Skips the next cell, whatever it holds, even if it is empty. @return the cell as it is
  /// written.
  std::string_view skip();
  /// @throws Error (bad_data) naming the next cell, if there is one. @param expected the cells of a
  ///        line, for the message: "i j distance".
  void expect_end(std::string_view expected);

 private:
  template <class T>
  T whole(T least, T most, const char* what);
  bool is_blank(char c) const { return c == ' ' || c == tab_; }
  const char* end_of_cell(const char* begin) const;
  bool is_empty_cell(const char* begin, const char* stop) const;
  void after_cell(const char* end_of_cell);
  [[noreturn]] void reject(const char* begin, const char* stop, std::string what,
                           std::string expected, const Message& hint = {}) const;

  const TextLines* lines_;
  CellHints hints_;
  const char* position_ = nullptr;
  const char* end_ = nullptr;
  char tab_;            // a second blank character in addition to ' '
  char skipped_to_;     // separator of skipped cells
  char separator_ = 0;  // 0 until the first separator is seen
};

/// `a * b`, or nothing if it exceeds size_t.
constexpr std::optional<std::size_t> checked_product(std::size_t a, std::size_t b) {
  if (b != 0 && a > std::numeric_limits<std::size_t>::max() / b) return std::nullopt;
  return a * b;
}

/// Loads a number stored in the given byte order.
template <class T>
requires std::is_arithmetic_v<T> T load(const std::byte* from, std::endian order) {
  std::byte raw[sizeof(T)];
  if (order == std::endian::native) {
    std::memcpy(raw, from, sizeof(T));
  } else {
    for (std::size_t i = 0; i < sizeof(T); ++i) raw[i] = from[sizeof(T) - 1 - i];
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

/// Reads the bytes of a binary input one after another and never beyond the end.
class BinaryCursor {
 public:
  BinaryCursor(const Input& input, std::endian order, std::size_t offset = 0)
      : input_(input), order_(order), offset_(offset) {}

  const Input& input() const { return input_; }
  std::size_t offset() const { return offset_; }
  std::size_t remaining() const { return input_.size() - offset_; }
  /// The next number. @throws Error (bad_data) "truncated" if there are not enough bytes for it.
  template <class T>
  T read(const char* what) {
    return load<T>(take(sizeof(T), what).data(), order_);
  }
  /// Reads a count from a header and checks it against the remaining bytes before anything is
  /// allocated.
  /// @throws Error (bad_data) if it is negative or `bytes_each` times it exceeds the remaining
  /// bytes.
  std::size_t read_count(const char* what, std::size_t bytes_each);
  /// The next `size` bytes. @throws Error (bad_data) "truncated".
  std::span<const std::byte> take(std::size_t size, const char* what);
  /// @throws Error (bad_data) "trailing data" unless all bytes were read.
  void expect_end() const;

 private:
  const Input& input_;
  std::endian order_;
  std::size_t offset_;
};

}  // namespace ph
