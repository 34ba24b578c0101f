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

#include "ph/io/read.hpp"

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
  /// Adds a file and the files that are read together with it, such as the data file of a header,
  /// or the slices in a folder.
  /// @param path as in Input::open. "-" stands for the source of standard input, and
  /// "FILE.npz:NAME" is a part of FILE.npz. Anything else than a file or a folder is ignored,
  /// because an output cannot destroy its content.
  /// @param format the format in which the input is read.
  void add(const std::string& path, Format format = Format::automatic);
  /// @throws Error (usage), such as "--output: a.csv is the input ./a.csv; …".
  void require_other(const Written& output) const;
  /// The input that an output would replace, or null if it would replace no input.
  const std::string* replaced_by(const std::string& output) const;

 private:
  void add_file(const std::string& path);

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
