// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>

namespace ph::app {

/// The facts about a program that its messages need.
struct Program {
  std::string_view name;
  /// A hint for users when memory runs out. It names options that the program has.
  std::string_view memory_advice;
};

/// Runs the body of a program, and turns any outcome into an exit code and at most one line on
/// stderr, `name: what`. SIGINT, SIGTERM and SIGHUP request a stop through the token that the body
/// receives. The program ends within 0.2 s even if the body ignores the token. On a second signal,
/// it ends at once. SIGPIPE is ignored. A broken pipe ends the program without a message.
int run_program(const Program& program, const std::function<int(std::stop_token)>& body);

/// Returns the exit code of the current exception. Reports the exception on stderr as `name:
/// subject: what`, unless it is a broken pipe or a stop request. Programs that continue with the
/// next input call this function.
int report_current_exception(const Program& program, std::string_view subject = {});

}  // namespace ph::app
