// SPDX-License-Identifier: MIT
#pragma once

/// Compiles a function for several instruction sets. The loader chooses the best version when the
/// program starts, which only ELF loaders can do. The macro does nothing in builds with sanitizers,
/// because sanitizers do not support such functions.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define PH_FOR_EACH_TARGET __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PH_FOR_EACH_TARGET
#endif
