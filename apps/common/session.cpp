// SPDX-License-Identifier: MIT
#include "session.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

#include "messages.hpp"
#include "numbers.hpp"
#include "signals.hpp"

namespace ph::app {
namespace {

/// The number in the first line of a file of the kernel's, if there is one.
std::optional<std::uint64_t> number_in(const char* path) {
  std::ifstream file(path);
  std::string word;
  if (!(file >> word)) return std::nullopt;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

/// What the machine, or the container we run in, has for us; nine tenths of it, so that a budget
/// is met before the system kills the process.
std::size_t machine_memory() {
  const auto pages = static_cast<std::uint64_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  std::uint64_t bytes = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  for (const char* limit :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
    bytes = std::min(bytes, number_in(limit).value_or(bytes));
  rlimit address_space{};
  if (getrlimit(RLIMIT_AS, &address_space) == 0)
    bytes = std::min<std::uint64_t>(bytes, address_space.rlim_cur);
  return static_cast<std::size_t>(bytes / 10 * 9);
}

}  // namespace

Session::Session(std::string_view program, const CommonOptions& options, std::stop_token stop)
    : program_(program), options_(options), progress_(options.progress, options.quiet) {
  context_.stop = std::move(stop);
  context_.threads = options.threads;
  context_.memory.set_limit(options.memory_limit ? static_cast<std::size_t>(*options.memory_limit)
                                                 : machine_memory());
  if (progress_.active())
    context_.on_progress = [this](const Progress& progress) { progress_.report(progress); };
  explain(
      fmt::format("memory limit {}", format_size(static_cast<double>(context_.memory.limit()))));
}

Session::~Session() = default;

void Session::note(std::string_view text) {
  if (options_.quiet) return;
  progress_.clear();
  print_line(fmt::format("{}: {}", program_, text));
}

void Session::explain(std::string_view text) {
  if (options_.verbose) note(text);
}

Output::Output(const std::string& path)
    : file_(path), slot_(remember_temporary(file_.temporary_path())) {}

Output::Output(Output&& other) noexcept
    : file_(std::move(other.file_)), slot_(std::exchange(other.slot_, -1)) {}

Output::~Output() { forget_temporary(slot_); }

void Output::commit() {
  file_.commit();
  forget_temporary(std::exchange(slot_, -1));
}

std::uint64_t peak_memory() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace ph::app
