// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>

namespace ph::app {

/// A program as its messages have it.
struct Program {
  std::string_view name;
  std::string_view memory_advice;  ///< what helps where memory runs out: options that it has
};

/// Runs the body of a program and turns whatever happens into an exit code and at most one line on
/// stderr: `name: what`. SIGINT, SIGTERM and SIGHUP request a stop through the token the body gets;
/// the program ends within 0.2 s even if the body does not listen, and at once on a second signal.
/// SIGPIPE is ignored, a broken pipe ends the program quietly.
int run_program(const Program& program, const std::function<int(std::stop_token)>& body);

/// The exit code of the exception in flight; reports it on stderr as `name: subject: what`, unless
/// it is a broken pipe or a stop request. For programs that go on with the next input.
int report_current_exception(const Program& program, std::string_view subject = {});

}  // namespace ph::app
