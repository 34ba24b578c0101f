// SPDX-License-Identifier: MIT
#pragma once
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

/// A file that a program writes, and the option that asks for it: "--report".
struct Written {
  std::string_view option;
  std::string path;
};

/// The identity of a file, whatever its name: its place on the disk. For a file that does not exist
/// yet, it is the nearest existing folder above it, and the path from there. "-" is the destination
/// of standard output.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::string name;  ///< the path from that folder; empty: the file exists
  auto operator<=>(const FileIdentity&) const = default;
};

/// The inputs of a run, which no output may replace.
class InputFiles {
 public:
  /// @param path as in Input::open: "-" is the source of standard input, "FILE.npz:NAME" is a part
  /// of FILE.npz. A path that is not a file is ignored, because an output cannot destroy its
  /// content.
  void add(const std::string& path);
  /// @throws Error (usage) "--output: a.csv is the input ./a.csv; …".
  void require_other(const Written& output) const;
  /// The input that an output would replace; null: none.
  const std::string* replaced_by(const std::string& output) const;

 private:
  std::map<FileIdentity, std::string> paths_;
};

/// The path of an input or an output. @throws Error (usage) "--output: found /dev/fd/4, …" if the
/// path stands for a descriptor that was not open when the program started. By now, the program
/// itself may use this descriptor.
std::string require_given(std::string_view option, const std::string& path);

/// @throws Error (usage) "--report: x is also written by --plot" if two outputs are one file, or go
/// to one pipe or device other than /dev/null.
void require_distinct(std::span<const Written> outputs);

/// Checks that each output is a separate file and that none is an input.
/// @param force true if outputs may replace inputs. @return true if an output replaces an input.
bool require_separate(const InputFiles& inputs, std::span<const Written> outputs, bool force);

}  // namespace ph::app
