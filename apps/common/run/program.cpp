// SPDX-License-Identifier: MIT
#include "apps/common/run/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>

#include "apps/common/system/process.hpp"
#include "apps/common/system/signals.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/terminal/messages.hpp"
#include "apps/common/terminal/words.hpp"
#include "ph/detail/core/machine_memory.hpp"
#include "ph/detail/io/output_file.hpp"

namespace ph::app {
namespace {

constexpr std::size_t kUsualStack = std::size_t{8} << 20;  // the limit that most systems set

bool advises(const Error& error, Setting setting) {
  return std::ranges::any_of(error.remedies(),
                             [setting](const Remedy& remedy) { return remedy.setting == setting; });
}

/// Does the work of report_current_exception, if there is memory for a message.
int report_with_memory(std::string_view prefix, std::string_view memory_advice) {
  const auto report = [&](std::string_view what, int code) {
    print_line(fmt::format("{}: {}", prefix, what));
    return code;
  };
  try {
    throw;
  } catch (const BrokenPipe&) {
    return kIo;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) {
      const int signal = SignalWatch::received();
      return signal == 0 ? exit_code(error.kind()) : 128 + signal;
    }
    const std::string text = error.in_words(kWords);
    if (error.kind() == ErrorKind::internal)
      return report(fmt::format("internal error: {}; please report it", text), kInternal);
    if (error.kind() == ErrorKind::resource && !advises(error, Setting::memory_limit))
      return report(fmt::format("{}; {}", text, memory_advice), kResource);
    return report(text, exit_code(error.kind()));
  } catch (const std::bad_alloc&) {
    return report(fmt::format("out of memory; {}", memory_advice), kResource);
  } catch (const std::length_error&) {
    return report(fmt::format("out of memory: a container would be too large; {}", memory_advice),
                  kResource);
  } catch (const std::system_error& error) {
    // Threads throw this error if the system has no room for another thread.
    if (error.code() == std::errc::resource_unavailable_try_again)
      return report("cannot create a thread; use fewer threads (--threads)", kResource);
    return report(fmt::format("internal error: {}; please report it", error.what()), kInternal);
  } catch (const std::exception& error) {
    return report(fmt::format("internal error: {}; please report it", error.what()), kInternal);
  } catch (...) {
    return report("internal error: unknown exception; please report it", kInternal);
  }
}

}  // namespace

int report_current_exception(const Program& program, std::string_view subject) {
  try {
    const std::string prefix =
        fmt::format("{}{}{}", program.name, subject.empty() ? "" : ": ", subject);
    return report_with_memory(prefix, program.memory_advice);
  } catch (...) {
    // There is no memory for any message, so this message is printed without using memory.
    print_without_memory(program.name, "out of memory");
    return kResource;
  }
}

int run_program(const Program& program, const std::function<int(std::stop_token)>& body) {
  if (const std::size_t stack = stack_size(); stack != 0 && stack < kLeastStack) {
    print_line(
        fmt::format("{}: found a limit of {} KiB for the stack, expected at least {} KiB; "
                    "`ulimit -s {}` sets it",
                    program.name, stack >> 10, kLeastStack >> 10, kUsualStack >> 10));
    return kResource;
  }
  prepare_process();
  end_where_mapped_files_shrink(program.name);  // mutant: file-shrinks
  try {
    const SignalWatch signals;
    try {
      return body(signals.token());
    } catch (...) {
      return report_current_exception(program);
    }
  } catch (...) {
    return report_current_exception(program);
  }
}

}  // namespace ph::app
