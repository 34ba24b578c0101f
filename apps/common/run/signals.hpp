// SPDX-License-Identifier: MIT
#pragma once
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

namespace ph::app {

/// Turns SIGINT, SIGTERM and SIGHUP into a stop request while it lives; there is one at a time.
/// The first signal requests a stop; if the process is still there 0.06 s later, or on a second
/// signal, it ends at once: registered temporary files are removed, nothing is unwound. Where no
/// thread can be created the first signal does so.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  std::stop_token token() const { return stop_.get_token(); }
  /// The first signal that came; 0: none.
  static int received();

 private:
  void watch();

  std::stop_source stop_;
  std::thread thread_;
};

/// While it lives the process does not end of a signal: for files that have a name which is not
/// theirs. For one thread at a time.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
};

/// From now on the process ends with kIo and one line when it reads what is mapped of a file and is
/// there no more: the file became shorter, or its disk failed. Registered temporary files are
/// removed. @param program whose message it is; lives as long as the process.
void end_where_mapped_files_shrink(std::string_view program);

/// Has a file removed if a signal ends the process at once. @return a slot to forget it by; -1 if
/// the name is empty or too long, or if there are too many.
int remember_temporary(const std::string& path);
void forget_temporary(int slot);

}  // namespace ph::app
