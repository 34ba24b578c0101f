// SPDX-License-Identifier: MIT
#pragma once
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

namespace ph::app {

/// While this object lives, SIGINT, SIGTERM and SIGHUP become a stop request. At most one such
/// object exists at a time. The first signal requests a stop. If the process still exists 0.06 s
/// later, or on a second signal, it ends at once. In this case, registered temporary files are
/// removed, and nothing is unwound. If no thread can be created, the first signal ends the process.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  std::stop_token token() const { return stop_.get_token(); }
  /// The first signal received, or 0 if no signal was received.
  static int received();

 private:
  void watch();

  std::stop_source stop_;
  std::thread thread_;
};

/// While this object lives, signals do not end the process. It is used while a new file is not
/// registered yet, because a signal would then leave the file behind. Only one thread at a time may
/// have such an object.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
};

/// From now on, the process ends with kIo and one line if it reads mapped bytes of a file that no
/// longer exist, because the file was shortened or its disk failed. Registered temporary files are
/// then removed. @param program the name in the message, which must live as long as the process.
void end_where_mapped_files_shrink(std::string_view program);

/// Registers a file to be removed if a signal ends the process at once. @return a slot for
/// unregistering it, or -1 if the name is empty or too long, or if there are too many files.
int remember_temporary(const std::string& path);
void forget_temporary(int slot);

}  // namespace ph::app
