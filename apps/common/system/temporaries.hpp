// SPDX-License-Identifier: MIT
#pragma once

namespace ph::app {

/// Removes the files registered by `remember_temporary`. A signal handler may call it.
void remove_temporaries();

}  // namespace ph::app
