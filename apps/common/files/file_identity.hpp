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

/// A file that a program writes, and the option that requests it, such as "--report".
struct Written {
  std::string_view option;
  std::string path;
};

/// The identity of a file, independent of its name. It is the place of the file on the disk. For a
/// file that does not exist yet, it is the nearest existing folder above the file, and the path
/// from that folder. "-" stands for the destination of standard output.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::string name;  ///< the path from that folder; empty if the file exists
  auto operator<=>(const FileIdentity&) const = default;
};

/// The inputs of a run, which no output may replace.
class InputFiles {
 public:
  /// @param path as in Input::open. "-" stands for the source of standard input, and
  /// "FILE.npz:NAME" is a part of FILE.npz. A path that is not a file is ignored, because an output
  /// cannot destroy its content.
  void add(const std::string& path);
  /// @throws Error (usage), such as "--output: a.csv is the input ./a.csv; …".
  void require_other(const Written& output) const;
  /// The input that an output would replace, or null if it would replace no input.
  const std::string* replaced_by(const std::string& output) const;

 private:
  std::map<FileIdentity, std::string> paths_;
};

/// Returns the path of an input or an output. @throws Error (usage), such as "--output: found
/// /dev/fd/4, …", if the path refers to a descriptor that was not open when the program started.
/// The program itself may use this descriptor by now.
std::string require_given(std::string_view option, const std::string& path);

/// @throws Error (usage), such as "--report: x is also written by --plot", if two outputs are the
/// same file, or are written to the same pipe or device other than /dev/null.
void require_distinct(std::span<const Written> outputs);

/// Checks that each output is a separate file and that no output is an input.
/// @param force true if outputs may replace inputs. @return true if an output replaces an input.
bool require_separate(const InputFiles& inputs, std::span<const Written> outputs, bool force);

}  // namespace ph::app
