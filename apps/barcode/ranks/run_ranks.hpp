// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

#include "barcode/run.hpp"
#include "facade/parts/transport.hpp"

namespace ph::barcode {

/// Computes an image, or the components of points, on all ranks; each rank calls it with the same
/// arguments, and rank 0 writes.
/// @param wait_for_all returns once all ranks have called it.
/// @return the exit code of this rank. @throws Error.
int run_ranks(const Arguments& arguments, Transport& transport,
              const std::function<void()>& wait_for_all, app::Session& session);

}  // namespace ph::barcode
