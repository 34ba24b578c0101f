// SPDX-License-Identifier: MIT
#pragma once
#include "ph/error.hpp"

namespace ph::app {

/// The kind of the error that `act` throws; ErrorKind::internal if it throws none.
template <class Act>
ErrorKind kind_of(Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.kind();
  }
  return ErrorKind::internal;
}

}  // namespace ph::app
