// SPDX-License-Identifier: MIT
#include "barcode/ranks/run_exchange.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "barcode/batch.hpp"
#include "barcode/ranks/folder_transport.hpp"
#include "barcode/ranks/run_folder.hpp"
#include "barcode/ranks/run_ranks.hpp"
#include "core/system/files.hpp"

namespace ph::barcode {
namespace {

/// Seconds after which a part that says nothing is taken to have died. File systems of a network
/// show some changes half a minute late. Tests set PH_TEST_PATIENCE; users have no need to.
int patience() {
  constexpr int usual = 60;
  const char* const text = std::getenv("PH_TEST_PATIENCE");
  const int seconds = text == nullptr ? 0 : std::atoi(text);
  return seconds > 0 ? seconds : usual;
}

/// What has to be the same for all parts. The name of the input is not: each machine has its own
/// paths. That the parts are of one image is checked where they are joined.
std::string hello_of(const Arguments& arguments) {
  const auto status = files::status_of(files::path_of(arguments.inputs.front()));
  return fmt::format("{}\n{} parts\nan input of {} bytes\n--output-format {}\noptions '{}'\n",
                     app::program_and_version("ph-barcode"), arguments.part->of,
                     status ? status->size : 0, barcode_format_name(*arguments.output_format),
                     fmt::join(arguments.typed_options, " "));
}

/// Of the exception in flight.
std::string reason() {
  try {
    throw;
  } catch (const Error& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an unknown exception";
  }
}

}  // namespace

int run_exchange(Arguments arguments, const std::stop_token& stop) {
  const auto [part, parts] = *arguments.part;
  // Any process can say what all will take.
  RunFolder run(arguments.exchange, arguments.dry_run ? 0 : part, parts, patience());
  const std::stop_callback on_stop(stop, [&run] { run.stop(); });
  app::Session session("ph-barcode", arguments.common, run.stop_token());
  for (const std::string& note : arguments.notes) session.note(note);
  FolderTransport transport(run);
  if (arguments.dry_run)
    return run_ranks(
        arguments, transport, [] {}, session);
  bool is_cleared = true;
  try {
    arguments.output_format = output_format(arguments, session);
    run.join(hello_of(arguments), [&](const std::string& whom) { session.note(whom); });
    const int code = run_ranks(
        arguments, transport, [&] { is_cleared = run.leave(); }, session);
    if (!is_cleared)
      session.note(fmt::format("{}/ph-run cannot be deleted; delete it before the next run",
                               arguments.exchange));
    if (part != 0) session.note(fmt::format("part {} of {}: done", part + 1, parts));
    return code;
  } catch (...) {
    run.abandon(reason());
    if (const std::string why = run.failure(); !why.empty()) throw Error(ErrorKind::io, why);
    throw;
  }
}

}  // namespace ph::barcode
