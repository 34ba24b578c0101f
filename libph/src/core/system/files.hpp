// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

/// Files as the system has them, by descriptors. Where a function says that it failed, errno says
/// why.
namespace ph::files {

/// A name in UTF-8: all texts of ours are, and not all systems take them for it.
inline std::filesystem::path path_of(const std::string& name) {
  return std::u8string(name.begin(), name.end());
}

/// What the system says of an errno.
inline std::string reason(int error) { return std::generic_category().message(error); }

constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

enum class Kind {
  regular,
  folder,
  other,  ///< a pipe, a terminal, a device
};

struct Status {
  Kind kind = Kind::other;
  std::uint64_t size = 0;               ///< bytes, of regular files
  std::uint64_t device = 0, inode = 0;  ///< tell files apart
};

/// Of what is there under a name, or is open. Nothing: failed; ENOENT if there is none.
std::optional<Status> status_of(const std::filesystem::path& path);
std::optional<Status> status_of(int file);

/// @return whether all that was written could be kept.
bool close(int file);

/// @{ For reading.

/// Bytes as they are. Does not wait for whoever writes to a FIFO. -1: failed; EISDIR for a folder.
int open_to_read(const std::filesystem::path& path);
/// Has standard input and output pass bytes as they are, too.
void pass_bytes(int standard);
/// Whether nothing has been read of it yet.
bool is_at_start(int file);
/// @return how many bytes were read, 0 at the end, -1: failed. EAGAIN: none came, wait and ask
/// again; returns so after some milliseconds, where the system can.
std::ptrdiff_t read_some(int file, char* to, std::size_t most);
/// The file as memory, to be read from its begin to its end. nullptr: failed.
char* map_to_read(int file, std::size_t bytes);
void unmap(char* data, std::size_t bytes);

/// @}
/// @{ For writing.

/// The descriptor that a name like /dev/stdout or /dev/fd/3 stands for, or a link to one. It need
/// not be open.
std::optional<int> descriptor_named(std::filesystem::path path);
/// Whether it is open, and for that.
bool may_write(int file);

/// A name by which all others of the same file are replaced: the file itself.
std::filesystem::path resolved(const std::filesystem::path& path);
bool may_write(const std::filesystem::path& path);
/// Whether a new file can take the place of one that may be written.
bool may_replace(const std::filesystem::path& path);
/// What cannot be replaced, as a device. -1: failed.
int open_to_write(const std::filesystem::path& path);
/// A new file in a folder. It has no name, and vanishes with the process, where the system has
/// such files. -1: failed. @param name its name; empty: none.
int create_in(const std::filesystem::path& folder, std::filesystem::path& name);
/// The mode of a file that is there, and its owner and group where that is allowed. @return whether
/// the mode could be given.
bool take_mode(int file, const std::filesystem::path& of);
/// @return how many bytes were written, waiting for room; -1: failed, EPIPE if nobody reads them.
std::ptrdiff_t write_some(int file, const char* from, std::size_t most);
/// Waits until what was written is on the disk. What cannot do that is no failure.
bool sync(int file);
/// Gives a file without a name one that nobody else has. Empty: failed.
std::filesystem::path name_in(int file, const std::filesystem::path& folder);
/// Replaces a file, or creates it; it is closed. @return whether it was done.
bool rename(const std::filesystem::path& from, const std::filesystem::path& to);
/// Waits until a new name is on the disk, where the system can.
void sync_folder(const std::filesystem::path& folder);
void remove(const std::filesystem::path& path);

/// @}

}  // namespace ph::files
