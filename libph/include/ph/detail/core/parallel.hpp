// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <functional>
#include <string_view>

#include "ph/run_context.hpp"

namespace ph {

/// Size of a cache line in bytes: two threads that write to the same line slow each other down.
inline constexpr std::size_t kCacheLine = 64;

/// The number of threads that a context allows.
std::size_t thread_count(const RunContext& context);

/// Divides 0 … count - 1 into pieces and calls `work(begin, end)` for each piece, on
/// `context.threads` threads, one of which is the caller's. It uses fewer threads if the system
/// cannot provide that many, and only one if there is only one piece. Returns when all pieces are
/// done. Any thread may take any piece: the output of `work` must depend on the piece alone.
/// @param stage the name of the work, for progress; the caller's thread counts the steps.
/// @param piece the size of a piece, > 0: large enough that its work outweighs the call.
/// @throws what `work` throws, after the other threads have stopped; Error (cancelled) on a stop
///         request.
void for_each_piece(std::string_view stage, std::size_t count, std::size_t piece,
                    const RunContext& context,
                    const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace ph
