// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

namespace ph {

/// What went wrong, in the classes a caller can act on. The programs turn each into an exit code.
enum class ErrorKind {
  usage,          ///< an argument or option makes no sense
  bad_data,       ///< the input is malformed or breaks a precondition
  no_input,       ///< the input is missing or unreadable
  not_built_in,   ///< this build was made without the feature, or this machine lacks what it needs
  cannot_create,  ///< the output cannot be created
  io,             ///< reading or writing broke off
  resource,       ///< memory or another limit would be exceeded
  cancelled,      ///< the caller asked to stop
  internal,       ///< a bug in libph
};

/// What can be set of a computation, whatever the programs and languages call it.
enum class Setting : std::uint8_t {
  none,
  engine,
  representatives,
  max_dim,
  threshold,
  subsample,
  collapse,
};

/// A change that helps: a setting with a value, as the programs write it ("engine", "auto").
struct Remedy {
  Setting setting = Setting::none;
  std::string value;
  friend bool operator==(const Remedy&, const Remedy&) = default;
};

/// The one exception type of libph. `what()` is one line: what, found, expected, hint.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace ph
