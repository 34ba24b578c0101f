// SPDX-License-Identifier: MIT
#include "apps/common/run/session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "apps/common/files/extensions.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/system/process.hpp"
#include "apps/common/system/signals.hpp"
#include "apps/common/terminal/messages.hpp"
#include "apps/common/terminal/words.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/detail/core/machine_memory.hpp"

namespace ph::app {
Session::Session(std::string_view program, const CommonOptions& options, std::stop_token stop)
    : program_(program),
      options_(options),
      progress_(options.progress, options.quiet, options.rank),
      memory_at_start_(peak_memory()) {
  context_.stop = std::move(stop);
  context_.threads = options.threads;
  context_.slab_layers = options.slab_layers;
  context_.memory.set_limit(options.memory_limit ? static_cast<std::size_t>(*options.memory_limit)
                                                 : machine_memory());
  heap_.bound(context_.memory.limit());
  if (progress_.active())
    context_.on_progress = [this](const Progress& progress) { progress_.report(progress); };
  constexpr std::string_view kModes[] = {"auto", "bar", "json", "none"};
  if (options.progress != ProgressMode::automatic)
    explain(fmt::format("progress {}", kModes[static_cast<int>(options.progress)]));
  if (options.threads > 0) explain(fmt::format("threads {}", options.threads));
  explain(
      fmt::format("memory limit {}", format_size(static_cast<double>(context_.memory.limit()))));
}

Session::~Session() = default;

std::uint64_t Session::memory_taken() const { return peak_memory() - memory_at_start_; }

void Session::note(const Message& text) {
  if (options_.quiet) return;
  print_line(fmt::format("{}: {}", program_, text.in_words(kWords)));
}

void Session::explain(const Message& text) {
  if (options_.verbose) note(text);
}

BarHold::BarHold(Session& session) : progress_(session.progress_) { progress_.hold(); }

BarHold::~BarHold() { progress_.release(); }

bool is_typed(std::initializer_list<std::string_view> paths) {
  return std::ranges::count(paths, "-") > 0 && isatty(STDIN_FILENO);
}

Output::Output(const std::string& path)
    : file_(require_given("output", path)), slot_(remember_temporary(file_.temporary_path())) {}

Output::Output(Output&& other) noexcept
    : file_(std::move(other.file_)), slot_(std::exchange(other.slot_, -1)) {}

Output::~Output() { forget_temporary(slot_); }

void Output::commit() {
  file_.sync();  // this may take a long time, and a signal may interrupt it
  {
    const SignalsWait until_named;
    file_.commit();
  }
  forget_temporary(std::exchange(slot_, -1));
}

}  // namespace ph::app
