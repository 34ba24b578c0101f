// SPDX-License-Identifier: MIT
#include "apps/common/terminal/messages.hpp"

#include <mutex>
#include <string>

#include "ph/detail/core/files.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph::app {
namespace {

constexpr std::string_view kWipe = "\r\x1b[K";

// There is one mutex for each process, because there is one standard error.
std::mutex mutex;
bool status_is_shown = false;

/// Must be called by a thread that has locked the mutex.
void write_all(std::string_view rest) {
  while (!rest.empty()) {
    const std::ptrdiff_t written =
        files::write_some(files::kStandardError, rest.data(), rest.size());
    if (written <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Must be called by a thread that has locked the mutex.
void wipe() {
  if (status_is_shown) write_all(kWipe);
  status_is_shown = false;
}

}  // namespace

void print_line(std::string_view line) {
  // A name of 4096 bytes, all of which are escaped, must not hide the text after it.
  constexpr std::size_t longest = std::size_t{1} << 15;
  const std::string text = printable(line, longest) + "\n";
  const std::scoped_lock lock(mutex);
  wipe();
  write_all(text);
}

void print_without_memory(std::string_view prefix, std::string_view text) {
  const std::scoped_lock lock(mutex);
  wipe();
  for (const std::string_view part : {prefix, std::string_view(": "), text, std::string_view("\n")})
    write_all(part);
}

void show_status(std::string_view text) {
  const std::string line = std::string(kWipe).append(text);
  const std::scoped_lock lock(mutex);
  write_all(line);
  status_is_shown = true;
}

void wipe_status() {
  const std::scoped_lock lock(mutex);
  wipe();
}

}  // namespace ph::app
