// SPDX-License-Identifier: MIT
#include "apps/common/system/process.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "ph/detail/core/machine_memory.hpp"

namespace ph::app {
namespace {

/// Occupies the standard descriptors that the caller closed, so that no file that the program opens
/// becomes "standard output" by accident. Each descriptor is deliberately opened for the wrong
/// direction, so that using it is an error.
void occupy_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0 &&
        open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
      // This path always exists, and is neither read nor written.
      static_cast<void>(open("/", O_PATH));
}

/// Keeps freed blocks up to a certain size for the next stage, because mapping each block again and
/// the resulting page faults would cost a short run a tenth of its time. Larger blocks are returned
/// to the system, because growing vectors would otherwise leave holes that the budget does not
/// count.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

}  // namespace

void prepare_process() {
  keep_freed_memory();
  occupy_standard_descriptors();
  signal(SIGPIPE, SIG_IGN);  // a write then fails with EPIPE
  signal(SIGXFSZ, SIG_IGN);  // a write then fails with EFBIG
}

bool is_given(int descriptor) {
  const int flags = fcntl(descriptor, F_GETFD);
  return flags >= 0 && (flags & FD_CLOEXEC) == 0;  // mutant: output-descriptor
}

void give_back_freed_memory() { malloc_trim(0); }

std::uint64_t peak_memory() {
  // getrusage is not used, because its value includes the program that started this one.
  if (const auto peak = status_bytes("VmHWM:")) return *peak;
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::uint64_t>(usage.ru_maxrss) * 1024
                                             : 0;
}

}  // namespace ph::app
