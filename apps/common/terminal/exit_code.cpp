// SPDX-License-Identifier: MIT
#include "apps/common/terminal/exit_code.hpp"

#include <array>

namespace ph::app {
namespace {

constexpr std::array kStatuses{
    ExitStatus{kOk, "Done"},
    ExitStatus{kDifference, "A check found a difference; the result is written anyway"},
    ExitStatus{kUsage, "The command line makes no sense"},
    ExitStatus{kBadData, "The data are malformed"},
    ExitStatus{kNoInput, "An input is missing or cannot be read"},
    ExitStatus{kNotBuiltIn,
               "A feature was left out when the program was built, or the machine has no GPU"},
    ExitStatus{kInternal, "A bug of the program; please report it"},
    ExitStatus{kCannotCreate, "An output cannot be created"},
    ExitStatus{kIo, "Reading or writing failed midway"},
    ExitStatus{kResource, "The memory limit, or another one, would be exceeded"},
    ExitStatus{kHangup, "Stopped by a hang-up"},
    ExitStatus{kInterrupted, "Stopped by Ctrl-C"},
    ExitStatus{kTerminated, "Stopped by a request to terminate"},
};

}  // namespace

int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return kUsage;
    case ErrorKind::bad_data:
      return kBadData;
    case ErrorKind::no_input:
      return kNoInput;
    case ErrorKind::not_built_in:
      return kNotBuiltIn;
    case ErrorKind::cannot_create:
      return kCannotCreate;
    case ErrorKind::io:
      return kIo;
    case ErrorKind::resource:
      return kResource;
    case ErrorKind::cancelled:
      return kInterrupted;
    case ErrorKind::internal:
      return kInternal;
  }
  return kInternal;
}

std::span<const ExitStatus> exit_statuses() { return kStatuses; }

}  // namespace ph::app
