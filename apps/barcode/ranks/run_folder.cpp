// SPDX-License-Identifier: MIT
#include "barcode/ranks/run_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "core/system/files.hpp"
#include "ph/error.hpp"

namespace ph::barcode {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRun = "ph-run", kUnfinished = ".new";
constexpr std::chrono::seconds kBeat(1), kLong(3);
// So many looks in a row have to fail before a folder is taken to be gone.
constexpr int kMostMisses = 5;

/// @return empty where it cannot be read.
std::string text_of(const fs::path& path) {
  std::ifstream from(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(from), {}};
}

/// The file appears when it is complete. @return whether it did.
bool put(const fs::path& path, std::string_view text) {
  fs::path unfinished = path;
  unfinished += std::string(kUnfinished);
  std::ofstream to(unfinished, std::ios::binary);
  to << text;
  to.close();
  return to && files::rename(unfinished, path);
}

std::string new_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

/// What is in a folder, which is opened each time: that has file systems of a network look again.
/// Nothing: it cannot be read.
std::optional<std::set<std::string>> names_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::u8string name = at->path().filename().u8string();
    names.emplace(name.begin(), name.end());
  }
  if (error) return std::nullopt;
  return names;
}

std::string name_of(std::string_view what, int rank) {
  return fmt::format("{}-{}", what, rank + 1);
}

/// The first line of two texts that differs, of both.
std::pair<std::string, std::string> first_difference(const std::string& a, const std::string& b) {
  std::istringstream of_a(a), of_b(b);
  std::string one, other;
  do {
    one.clear(), other.clear();
    std::getline(of_a, one), std::getline(of_b, other);
  } while (one == other && (of_a || of_b));
  return {one, other};
}

/// Says once, after a while, whom it waits for.
class Waiting {
 public:
  explicit Waiting(const RunFolder::Say& say) : say_(say) {}
  void tell(const std::string& whom) {
    if (has_said_ || std::chrono::steady_clock::now() < from_) return;
    say_(fmt::format("waiting for {}", whom));
    has_said_ = true;
  }

 private:
  const RunFolder::Say& say_;
  const std::chrono::steady_clock::time_point from_ = std::chrono::steady_clock::now() + kLong;
  bool has_said_ = false;
};

}  // namespace

RunFolder::RunFolder(std::string folder, int rank, int size, int patience)
    : folder_(files::path_of(folder)),
      name_(std::move(folder)),
      rank_(rank),
      size_(size),
      patience_(patience) {}

void RunFolder::join(const std::string& hello, const Say& say) {
  if (rank_ == 0) begin();
  const auto refuse = [&](std::string_view what) {
    throw Error(
        ErrorKind::cannot_create,
        fmt::format("--exchange: {} is there already in {}/{}: another run is at work here, "
                    "or one broke; if none is at work, delete {}/{}",
                    what, name_, kRun, name_, kRun));
  };
  do {
    if (rank_ != 0) run_ = find(say);
    std::error_code error;
    const bool is_new = fs::create_directory(messages_to(rank_), error);
    if (!is_new && !error) refuse(name_of("part", rank_));
    has_joined_ = is_new;
    if (error && (rank_ == 0 || fs::exists(run_)))
      throw Error(ErrorKind::cannot_create,
                  fmt::format("--exchange: {}: {}", name_, error.message()));
  } while (!has_joined_);  // else that run has just ended
  greet(hello, say);
}

void RunFolder::begin() {
  std::error_code error;
  fs::create_directory(folder_, error);
  const fs::path place = folder_ / std::string(kRun);
  const bool is_new = !error && fs::create_directory(place, error);
  if (!is_new && !error)
    throw Error(
        ErrorKind::cannot_create,
        fmt::format("--exchange: {}/{} is there already: another run is at work here, or one "
                    "broke; if none is at work, delete it",
                    name_, kRun));
  if (!error) fs::create_directory(run_ = place / new_token(), error);
  if (error)
    throw Error(ErrorKind::cannot_create,
                fmt::format("--exchange: {}: {}", name_, error.message()));
}

fs::path RunFolder::find(const Say& say) {
  const fs::path place = folder_ / std::string(kRun);
  Waiting waiting(say);
  const auto tokens = wait_for([&] {
    auto found = names_in(place);
    if (found && found->empty()) found.reset();
    if (!found) waiting.tell(fmt::format("part 1 in {}", name_));
    return found;
  });
  return place / *tokens->begin();
}

void RunFolder::greet(const std::string& hello, const Say& say) {
  if (!put(file("hello", rank_), hello))
    throw Error(ErrorKind::io, fmt::format("--exchange: {}: cannot be written to", name_));
  watch_ = std::jthread([this](const std::stop_token& end) { watch(end); });
  Waiting waiting(say);
  bool is_compared = rank_ == 0;
  wait_for([&] {
    const Names here = names().value_or(Names());
    if (!is_compared && here.contains(name_of("hello", 0))) {
      const auto [ours, first] = first_difference(hello, text_of(file("hello", 0)));
      if (ours != first)
        throw Error(
            ErrorKind::usage,
            fmt::format("--exchange: part {}: found {}, expected {} as part 1", rank_ + 1,
                        ours.empty() ? "nothing" : ours, first.empty() ? "nothing" : first));
      is_compared = true;
    }
    std::vector<int> missing;
    for (int other = 0; other < size_; ++other)
      if (!here.contains(name_of("hello", other))) missing.push_back(other + 1);
    if (missing.empty()) return true;
    waiting.tell(fmt::format("{} {} in {}", missing.size() == 1 ? "part" : "parts",
                             fmt::join(missing, ", "), name_));
    return false;
  });
}

fs::path RunFolder::file(std::string_view what, int rank) const {
  return run_ / name_of(what, rank);
}

fs::path RunFolder::messages_to(int rank) const { return file("part", rank); }

std::optional<RunFolder::Names> RunFolder::names() const { return names_in(run_); }

void RunFolder::check() const {
  if (!stop_.stop_requested()) return;
  if (const std::string why = failure(); !why.empty()) throw Error(ErrorKind::io, why);
  throw Error(ErrorKind::cancelled, "stopped");
}

std::string RunFolder::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void RunFolder::sleep(std::chrono::milliseconds time) {
  std::unique_lock lock(sleep_);
  never_.wait_for(lock, stop_.get_token(), time, [] { return false; });
}

bool RunFolder::leave() {
  {
    // No sign of life comes later than the last word, when part 1 may clear the folder.
    const std::lock_guard lock(beat_);
    is_leaving_ = rank_ != 0;
  }
  if (rank_ == 0) {
    wait_for([&] { return have_all("done"); });
    watch_ = {};
    put(file("done", 0), "");
    return clear();
  }
  if (!put(file("done", rank_), ""))
    throw Error(ErrorKind::io, fmt::format("--exchange: {}: cannot be written to", name_));
  int misses = 0;
  wait_for([&] {
    const std::optional<Names> here = names();
    misses = here ? 0 : misses + 1;
    return misses == kMostMisses || (here && here->contains(name_of("done", 0)));
  });
  watch_ = {};
  return true;
}

/// Whether all others have said something.
bool RunFolder::have_all(std::string_view said) const {
  const Names here = names().value_or(Names());
  for (int other = 0; other < size_; ++other)
    if (other != rank_ && !here.contains(name_of(said, other))) return false;
  return true;
}

/// Others may still look into it, which some file systems do not like.
bool RunFolder::clear() {
  constexpr int tries = 50;
  std::error_code error;
  for (int i = 0; i < tries; ++i) {
    fs::remove_all(run_, error);
    if (!error) fs::remove(run_.parent_path(), error);
    if (!error) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

void RunFolder::stop() noexcept {
  fail("it was stopped");
  stop_.request_stop();
}

void RunFolder::fail(const std::string& why) noexcept {
  try {
    if (has_joined_ && failure().empty() && !has_failed_.exchange(true))
      put(file("failed", rank_), why);
  } catch (...) {
    // Then the others find out because this part falls silent.
  }
}

void RunFolder::abandon(const std::string& why) noexcept {
  try {
    fail(why);
    if (!has_joined_) return;
    watch_ = {};  // no sign of life comes later
    put(file("ended", rank_), "");
    constexpr int tries = 30;
    for (int i = 0; rank_ == 0 && i < tries; ++i) {
      if (have_all("ended")) {
        clear();
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  } catch (...) {
    // The folder stays.
  }
}

void RunFolder::give_up(const std::string& why) {
  {
    const std::lock_guard lock(mutex_);
    failure_ = why;
  }
  stop_.request_stop();
}

/// Gives signs of life, and looks for those of the next part that is at work: so each one has
/// another that looks at it, and all together look at as many files as there are parts. Silence is
/// counted in looks of our own: a machine that slept has not looked either.
void RunFolder::watch(const std::stop_token& end) try {
  int watched = rank_, silent = 0, misses = 0;
  std::string last;
  std::mutex mutex;
  std::condition_variable_any never;
  for (std::uint64_t beat = 1; !end.stop_requested(); ++beat) {
    {
      const std::lock_guard lock(beat_);
      if (!is_leaving_) put(file("alive", rank_), fmt::format("{}\n", beat));
    }
    const std::optional<Names> here = names();
    misses = here ? 0 : misses + 1;
    if (misses == kMostMisses) return give_up(fmt::format("{}/{} is gone", name_, kRun));
    for (int other = 0; here && other < size_; ++other)
      if (other != rank_ && here->contains(name_of("failed", other)))
        return give_up(
            fmt::format("part {} has failed: {}", other + 1, text_of(file("failed", other))));
    int next = rank_;
    do {
      next = (next + 1) % size_;
    } while (here && next != rank_ &&
             (!here->contains(name_of("hello", next)) || here->contains(name_of("done", next))));
    if (here && next != rank_) {
      const std::string now = text_of(file("alive", next));
      silent = next == watched && now == last ? silent + 1 : 0;
      watched = next;
      last = now;
      if (silent >= patience_) {
        const std::string what = fmt::format(
            "part {} has said nothing for {} s: it is taken to "
            "have died",
            next + 1, patience_);
        fail(what);
        return give_up(what);
      }
    }
    std::unique_lock lock(mutex);
    never.wait_for(lock, end, kBeat, [] { return false; });
  }
} catch (...) {
  // No memory, say: the others see that this part is silent.
}

}  // namespace ph::barcode
