// SPDX-License-Identifier: MIT
#include "messages.hpp"

#include <unistd.h>

#include <string>

#include "ph/io/reader.hpp"

namespace ph::app {

void print_line(std::string_view line) {
  // A name of 4096 bytes, each of them escaped, must not hide what comes after it.
  constexpr std::size_t kMaxLine = std::size_t{1} << 15;
  const std::string text = printable(line, kMaxLine) + "\n";
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, rest.data(), rest.size());
    if (written <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace ph::app
