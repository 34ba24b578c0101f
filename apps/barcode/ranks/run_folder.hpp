// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

namespace ph::barcode {

/// A folder in which the processes of one run find each other and see how the others are. They may
/// be on several machines. Each has a rank; users count parts from 1.
///
///   FOLDER/ph-run/     made by part 1: while it is there no other run begins here
///     TOKEN/           a name that no other run has
///       hello-I        what part I computes
///       part-I/        the messages to part I
///       alive-I        a number, a new one each second
///       failed-I       why part I has ended
///       ended-I        part I has ended after an error, its own or another's
///       done-I         part I has all it needs and waits for the end
///
/// Runs do not mix. Making a folder either succeeds or finds one, on all file systems: so there is
/// one part 1, and one of each other part. What an older run left is refused, since nobody can tell
/// a process that is slow from one that is gone. All that is written later lies below the token: a
/// process that is late cannot write into the run that comes next.
class RunFolder {
 public:
  using Say = std::function<void(const std::string&)>;

  /// @param patience how many seconds a part may be silent.
  RunFolder(std::string folder, int rank, int size, int patience);
  ~RunFolder() = default;
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Stops where another part has failed, or the run has.
  std::stop_token stop_token() const { return stop_.get_token(); }

  /// Waits until all parts are here. @param hello lines that have to be the same for all parts.
  /// @param say tells the user whom we wait for, if that takes long.
  /// @throws Error (cannot_create) if another process is this part; Error (usage) if part 1 says
  /// another hello; as `check`.
  void join(const std::string& hello, const Say& say);
  /// Where messages to a rank are put. Precondition: join.
  std::filesystem::path messages_to(int rank) const;
  /// @throws Error (io) that says which part has failed, Error (cancelled) after `stop`.
  void check() const;
  /// Looks again and again, less and less often, until `look` gives something. @throws as `check`.
  template <class Look>
  auto wait_for(Look&& look) {
    constexpr std::chrono::milliseconds one(1), most(100);
    for (std::chrono::milliseconds pause(1);; pause = std::min(pause + pause / 4 + one, most)) {
      check();
      if (auto found = look()) return found;
      sleep(pause);
    }
  }
  /// Waits until all parts have come here; part 1 then clears the folder.
  /// @return whether that is done. @throws as `check`.
  bool leave();

  /// Has this process stop, and tells the others.
  void stop() noexcept;
  /// Tells the others why this one ends, once. Not if another one has failed before.
  void fail(const std::string& why) noexcept;
  /// Ends after an error: tells the others why, as `fail`. If all of them end, too, in the seconds
  /// to come, part 1 clears the folder; else it stays, for those who may come late.
  void abandon(const std::string& why) noexcept;
  /// Why this run cannot go on, with the number of the part; empty: it can.
  std::string failure() const;

 private:
  using Names = std::set<std::string>;

  void begin();
  std::filesystem::path find(const Say& say);
  void greet(const std::string& hello, const Say& say);
  std::filesystem::path file(std::string_view what, int rank) const;
  std::optional<Names> names() const;
  void sleep(std::chrono::milliseconds time);
  void watch(const std::stop_token& end);
  void give_up(const std::string& why);
  bool have_all(std::string_view said) const;
  bool clear();

  const std::filesystem::path folder_;
  const std::string name_;  // of the folder, for messages
  const int rank_, size_, patience_;
  std::filesystem::path run_;  // with the token
  std::atomic<bool> has_joined_ = false, is_leaving_ = false, has_failed_ = false;
  std::stop_source stop_;
  mutable std::mutex mutex_;  // of failure_
  std::string failure_;
  std::mutex beat_;  // held while a sign of life is written
  std::condition_variable_any never_;
  std::mutex sleep_;
  std::jthread watch_;  // ends first
};

}  // namespace ph::barcode
