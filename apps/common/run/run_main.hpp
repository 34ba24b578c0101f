// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "apps/common/arguments/command_line.hpp"
#include "apps/common/run/program.hpp"
#include "apps/common/run/session.hpp"

namespace ph::app {

/// The main function of a program that runs in one session.
/// @param parse reads the command line; returns the answer to --help and similar options, or
///     nothing.
/// @param run called with the arguments and the session; returns the exit code.
/// @return the exit code.
template <class Arguments, class Run>
int run_main(const Program& program, int argc, const char* const* argv,
             std::optional<std::string> (*parse)(int, const char* const*, Arguments&), Run&& run) {
  const auto body = [&](std::stop_token stop) {
    Arguments arguments;
    if (const auto answer = parse(argc, argv, arguments)) return answer_command_line(*answer);
    Session session(program.name, arguments.common, std::move(stop));
    return run(arguments, session);
  };
  return run_program(program, std::ref(body));  // a copy of the body would need memory
}

}  // namespace ph::app
