// SPDX-License-Identifier: MIT
// Runs a command and writes the cost of its process to a file descriptor: "status user system wall
// peak". The status comes from wait4, times are in seconds, and the peak is in bytes.
//
// A process starts as a copy of its parent, and the kernel includes this copy in the peak memory.
// If an interpreter started the command, the peak would be at least the memory of the interpreter.
// This program is so small that it hardly raises the peak.
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s FILE_DESCRIPTOR COMMAND…\n", argv[0]);
    return 64;
  }
  const int out = std::atoi(argv[1]);
  // Ends this process when its parent ends, even if the parent is aborted.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(out);
    execvp(argv[2], argv + 2);
    std::fprintf(stderr, "%s: %s\n", argv[2], std::strerror(errno));
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) < 0) {
    std::perror(argv[0]);
    return 71;
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return dprintf(out, "%d %.6f %.6f %.6f %ld\n", status, seconds(usage.ru_utime),
                 seconds(usage.ru_stime), wall.count(), usage.ru_maxrss * 1024) < 0;
}
