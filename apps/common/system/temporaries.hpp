// SPDX-License-Identifier: MIT
#pragma once

namespace ph::app {

/// Removes the files of `remember_temporary`. A handler of signals may call it.
void remove_temporaries();

}  // namespace ph::app
