// SPDX-License-Identifier: MIT
#pragma once

/// Compiles a function for several instruction sets; the best one is chosen when the program is
/// loaded. Only ELF loaders can choose. Disabled under the sanitizers, where it does not work.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define PH_FOR_EACH_TARGET __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PH_FOR_EACH_TARGET
#endif
