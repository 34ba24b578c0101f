// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

/// System calls for files, by descriptors. If a function reports failure, errno has the reason.
namespace ph::files {

/// Makes a path from a name in UTF-8. All texts of libph are in UTF-8, but some systems assume
/// another encoding.
inline std::filesystem::path path_of(const std::string& name) {
  return std::u8string(name.begin(), name.end());
}

/// The system's text for an errno.
inline std::string reason(int error) { return std::generic_category().message(error); }

constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

enum class Kind {
  regular,
  folder,
  other,  ///< a pipe, a terminal, a device
};

struct Status {
  Kind kind = Kind::other;
  std::uint64_t size = 0;               ///< bytes, for regular files
  std::uint64_t device = 0, inode = 0;  ///< identify a file
};

/// The status of the file with that name or descriptor. Empty if the call failed; errno is ENOENT
/// if there is no such file.
std::optional<Status> status_of(const std::filesystem::path& path);
std::optional<Status> status_of(int file);

/// Closes a file. @return true if all data written to it were stored.
bool close(int file);

/// @{ For reading.

/// Opens a file to read its bytes unchanged, without waiting for a writer of a FIFO. @return -1 if
/// it failed; errno is EISDIR for a folder.
int open_to_read(const std::filesystem::path& path);
/// Makes standard input or output pass bytes unchanged. @param standard its descriptor.
void pass_bytes(int standard);
/// True if nothing has been read from the file yet.
bool is_at_start(int file);
/// @return the number of bytes read, 0 at the end, -1 if it failed. -1 with EAGAIN means that no
/// bytes have arrived yet: call again. Where the system allows it, the call waits only a few
/// milliseconds for bytes.
std::ptrdiff_t read_some(int file, char* to, std::size_t most);
/// Maps the file into memory, to be read from beginning to end. @return nullptr if it failed.
char* map_to_read(int file, std::size_t bytes);
void unmap(char* data, std::size_t bytes);

/// @}
/// @{ For writing.

/// The descriptor that a name like /dev/stdout or /dev/fd/3, or a link to such a name, stands for.
/// The descriptor need not be open.
std::optional<int> descriptor_named(std::filesystem::path path);
/// True if the descriptor is open for writing.
bool may_write(int file);

/// The name of the file itself, with all links resolved: replacing this file affects all its names.
std::filesystem::path resolved(const std::filesystem::path& path);
bool may_write(const std::filesystem::path& path);
/// True if a new file can replace a file that may be written.
bool may_replace(const std::filesystem::path& path);
/// Opens a file that cannot be replaced, such as a device. @return -1 if it failed.
int open_to_write(const std::filesystem::path& path);
/// Creates a file in a folder. Where the system supports it, the file has no name and vanishes with
/// the process. @return -1 if it failed. @param name receives its name; empty if it has none.
int create_in(const std::filesystem::path& folder, std::filesystem::path& name);
/// Gives a file the mode of the existing file `of`, and also the owner and group if that is
/// allowed. @return true if the mode could be set.
bool take_mode(int file, const std::filesystem::path& of);
/// Writes some of the bytes; waits until there is room. @return the number of bytes written, or -1
/// if it failed; errno is EPIPE if nobody reads them.
std::ptrdiff_t write_some(int file, const char* from, std::size_t most);
/// Waits until the written bytes are on the disk. A file system that cannot do this does not count
/// as a failure.
bool sync(int file);
/// Gives a nameless file an unused name in a folder. @return the name; empty if it failed.
std::filesystem::path name_in(int file, const std::filesystem::path& folder);
/// Renames `from` to `to`, and replaces a file that has this name; `from` must be closed. @return
/// true on success.
bool rename(const std::filesystem::path& from, const std::filesystem::path& to);
/// Waits until a new name is on the disk, if the system supports that.
void sync_folder(const std::filesystem::path& folder);
void remove(const std::filesystem::path& path);

/// @}

}  // namespace ph::files
