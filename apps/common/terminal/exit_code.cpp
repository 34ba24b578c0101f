// SPDX-License-Identifier: MIT
#include "common/terminal/exit_code.hpp"

namespace ph::app {

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

}  // namespace ph::app
