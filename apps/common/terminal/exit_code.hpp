// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string_view>

#include "ph/error.hpp"

namespace ph::app {

/// The codes that the programs return to the shell. They are the codes of sysexits and the shell's
/// own numbers for signals.
enum ExitCode : int {
  kOk = 0,
  kDifference = 1,  ///< a check found a difference; the result is written anyway
  kUsage = 64,
  kBadData = 65,
  kNoInput = 66,
  kNotBuiltIn = 69,
  kInternal = 70,
  kCannotCreate = 73,
  kIo = 74,
  kResource = 75,
  kHangup = 129,
  kInterrupted = 130,
  kTerminated = 143,
};

/// The exit code of a kind of error. A cancelled run counts as interrupted.
int exit_code(ErrorKind kind);

/// The meaning of a code for users, as a sentence without its full stop.
struct ExitStatus {
  ExitCode code;
  std::string_view what;
};
/// All codes, by number.
std::span<const ExitStatus> exit_statuses();

}  // namespace ph::app
