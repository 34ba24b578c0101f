// SPDX-License-Identifier: MIT
#include "apps/common/system/signals.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "apps/common/system/temporaries.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/terminal/messages.hpp"

namespace ph::app {
namespace {

// A handler may use only lock-free atomics and memory that does not move. The variables below are
// therefore globals. Like signals, they belong to the process.
constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

std::atomic<int> first_signal{0};
std::atomic<int> wake_descriptor{-1};
std::atomic<bool> must_wait{false};
// At most one watch exists, and at most one object that makes signals wait.
int pipe_ends[2] = {-1, -1};
sigset_t before;

std::string_view program_name;

static_assert(std::atomic<int>::is_always_lock_free);

// This function never runs on a thread that another thread waits for, because such a thread has
// signals blocked.
[[noreturn]] void end_at_once(int signal) {
  while (must_wait.load()) {
    const timespec millisecond{0, 1'000'000};
    nanosleep(&millisecond, nullptr);
  }
  remove_temporaries();
  _exit(128 + signal);
}

void on_signal(int signal) {
  const int saved = errno;
  int none = 0;
  const bool is_first = first_signal.compare_exchange_strong(none, signal);
  if (!is_first || wake_descriptor.load() < 0) end_at_once(signal);
  const char byte = 1;
  static_cast<void>(!write(wake_descriptor.load(), &byte, 1));
  errno = saved;
}

/// Handles the signal for lost pages. It arrives at the instruction that reads, never within a
/// message or a system call.
void on_lost_page(int signal, siginfo_t* what, void*) {
  // A bug in the program caused the signal, which then has the same effect as without a handler.
  if (what->si_code != BUS_ADRERR) {
    std::signal(signal, SIG_DFL);
    return;
  }
  print_without_memory(program_name,
                       "an input file became shorter while it was read, or its disk failed");
  remove_temporaries();
  _exit(kIo);
}

}  // namespace

void end_where_mapped_files_shrink(std::string_view program) {
  program_name = program;
  struct sigaction action {};
  action.sa_sigaction = on_lost_page;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  sigaction(SIGBUS, &action, nullptr);
}

SignalWatch::SignalWatch() {
  if (pipe2(pipe_ends, O_CLOEXEC) == 0) {
    try {
      thread_ = std::thread([this] { watch(); });
      wake_descriptor = pipe_ends[1];
    } catch (const std::system_error&) {
      // No thread could be created. Without a thread that could be woken, the handler ends the
      // process itself.
    }
  }
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : kSignals) {
    struct sigaction was {};
    // The program may be started with signals that are ignored, by nohup and by shells for their
    // background jobs. These signals stay ignored.
    if (sigaction(signal, nullptr, &was) == 0 && was.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
}

SignalWatch::~SignalWatch() {
  if (!thread_.joinable()) return;
  const char byte = 0;
  if (write(pipe_ends[1], &byte, 1) != 1) {  // closing the pipe also wakes the thread
    wake_descriptor = -1;
    close(pipe_ends[1]);
  }
  thread_.join();
  // The handler stays installed and may still write one byte. The pipe therefore lives as long as
  // the process.
}

int SignalWatch::received() { return first_signal.load(); }

void SignalWatch::watch() {
  constexpr int kGraceMilliseconds = 60;
  char byte = 0;
  ssize_t got = 0;
  do {
    got = read(pipe_ends[0], &byte, 1);
  } while (got < 0 && errno == EINTR);
  if (got != 1 || byte == 0) return;
  stop_.request_stop();
  // Unwinding normally takes a few milliseconds and ends with the byte 0 from the destructor.
  // Longer unwinding is interrupted. Returning gigabytes to the system also takes time, and all of
  // this together must take less than 0.2 s.
  pollfd done{pipe_ends[0], POLLIN, 0};
  int ready = 0;
  do {
    ready = poll(&done, 1, kGraceMilliseconds);
  } while (ready < 0 && errno == EINTR);
  if (ready == 0) end_at_once(first_signal.load());
}

SignalsWait::SignalsWait() {
  sigset_t ours;
  sigemptyset(&ours);
  for (const int signal : kSignals) sigaddset(&ours, signal);
  pthread_sigmask(SIG_BLOCK, &ours, &before);
  must_wait = true;
}

SignalsWait::~SignalsWait() {
  must_wait = false;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace ph::app
