// SPDX-License-Identifier: MIT
#include "apps/common/system/signals.hpp"

#include <windows.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <mutex>

#include "apps/common/system/temporaries.hpp"

namespace ph::app {
namespace {

// The messages of the console belong to the process. There is therefore one signal per process.
std::atomic<int> first_signal{0};
std::mutex mutex;
std::stop_source* watched = nullptr;  // protected by the mutex
std::mutex may_end;                   // the process does not end while another thread holds it

[[noreturn]] void end_at_once(int signal) {
  const std::scoped_lock lock(may_end);
  remove_temporaries();
  TerminateProcess(GetCurrentProcess(), 128 + static_cast<unsigned>(signal));
  std::abort();
}

bool request_stop() {
  const std::scoped_lock lock(mutex);
  return watched != nullptr && watched->request_stop();
}

/// The system calls this function on a new thread each time.
BOOL WINAPI on_control(DWORD what) {
  constexpr DWORD kGraceMilliseconds = 60;
  const int signal = what == CTRL_C_EVENT ? SIGINT : SIGTERM;
  int none = 0;
  if (!first_signal.compare_exchange_strong(none, signal) || !request_stop()) end_at_once(signal);
  Sleep(kGraceMilliseconds);
  {
    const std::scoped_lock lock(mutex);
    if (watched == nullptr) return TRUE;
  }
  end_at_once(signal);
}

}  // namespace

SignalWatch::SignalWatch() {
  const std::scoped_lock lock(mutex);
  watched = &stop_;
  SetConsoleCtrlHandler(on_control, TRUE);
}

SignalWatch::~SignalWatch() {
  const std::scoped_lock lock(mutex);
  watched = nullptr;
}

int SignalWatch::received() { return first_signal.load(); }

// Does nothing, because the system does not allow mapped files to shrink.
void end_where_mapped_files_shrink(std::string_view) {}

SignalsWait::SignalsWait() { may_end.lock(); }
SignalsWait::~SignalsWait() { may_end.unlock(); }

}  // namespace ph::app
