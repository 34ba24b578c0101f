// SPDX-License-Identifier: MIT
// This program, ph-barcode-mpi, computes the barcode of one image, or of points, on all MPI ranks.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <thread>

#include "apps/barcode/mpi/mpi_transport.hpp"
#include "apps/barcode/ranks/rank_result.hpp"
#include "apps/common/run/program.hpp"
#include "ph/detail/core/machine_memory.hpp"

namespace {

constexpr ph::app::Program kProgram{
    "ph-barcode-mpi",
    "use more ranks on more machines, compute less (--max-dim), or raise --memory-limit"};

/// True if -h or --help is given. This option must be answered without MPI, which may be missing on
/// a machine where users only ask for help.
bool is_help_asked(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--") return false;
    if (word == "-h" || word.starts_with("--help")) return true;
  }
  return false;
}

int print_help(int argc, char** argv) {
  return ph::app::run_program(kProgram, [&](const std::stop_token&) {
    ph::barcode::Job job;
    job.sharing.on_ranks = true;
    const auto answer = ph::barcode::parse_arguments(argc, argv, job);
    return ph::app::answer_command_line(answer.value());
  });
}

/// Divides the memory and the cores of this machine among its ranks, unless options state
/// otherwise.
void share_machine(ph::app::CommonOptions& options, int ranks) {
  const auto count = static_cast<unsigned>(ranks);
  if (!options.memory_limit) options.memory_limit = ph::machine_memory() / count;
  if (options.threads == 0)
    options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency() / count));
}

}  // namespace

int main(int argc, char** argv) {
  if (is_help_asked(argc, argv)) return print_help(argc, argv);
  ph::barcode::MpiTransport transport(&argc, &argv);
  const int code = ph::app::run_program(kProgram, [&](const std::stop_token& stop) {
    ph::barcode::Job job;
    job.sharing.on_ranks = true;
    try {
      if (const auto answer = ph::barcode::parse_arguments(argc, argv, job))
        return transport.rank() == 0 ? ph::app::answer_command_line(*answer) : 0;
    } catch (const ph::Error&) {
      if (transport.rank() == 0) throw;
      transport.wait_for_all();  // rank 0 prints the reason and ends all ranks
    }
    share_machine(job.common, transport.ranks_here());
    const bool is_first = transport.rank() == 0;
    // Only rank 0 prints notes. Another rank prints something only if it fails or with --verbose.
    job.common.quiet = job.common.quiet || (!is_first && !job.common.verbose);
    // Only the first rank shows a progress bar. Lines of JSON name their rank.
    if (job.common.progress == ph::app::ProgressMode::json)
      job.common.rank = transport.rank();
    else if (!is_first)
      job.common.progress = ph::app::ProgressMode::none;
    const std::string name = is_first ? std::string(kProgram.name)
                                      : fmt::format("{}: rank {}", kProgram.name, transport.rank());
    ph::app::Session session(name, job.common, stop);
    return ph::barcode::run_ranks(
        job, transport, [&] { transport.wait_for_all(); }, session);
  });
  return transport.finish(code);
}
