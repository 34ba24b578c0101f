// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <functional>
#include <string_view>

#include "ph/run_context.hpp"

namespace ph {

/// Bytes that threads take from each other when one of them writes.
inline constexpr std::size_t kCacheLine = 64;

/// How many threads a context allows.
std::size_t thread_count(const RunContext& context);

/// Calls `work(begin, end)` for pieces that together are 0 … count - 1, on `context.threads`
/// threads of which the caller's is one; fewer where the system gives no more, one where there is
/// only one piece. Returns when all are done. Which thread takes which piece is left open: what
/// `work` writes must depend on the piece alone.
/// @param stage the name of what is done, for progress; steps are counted by the caller's thread.
/// @param piece how many numbers a call gets, > 0: enough that their work outweighs the call.
/// @throws what `work` throws, after the other threads have stopped; Error (cancelled) on a stop
///         request.
void for_each_piece(std::string_view stage, std::size_t count, std::size_t piece,
                    const RunContext& context,
                    const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace ph
