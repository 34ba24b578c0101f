// SPDX-License-Identifier: MIT
// ph-barcode-mpi: the barcode of one image, or of points, on all ranks of MPI.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <thread>

#include "barcode/mpi/mpi_transport.hpp"
#include "barcode/ranks/run_ranks.hpp"
#include "common/run/program.hpp"
#include "core/system/machine_memory.hpp"

namespace {

constexpr ph::app::Program kProgram{
    "ph-barcode-mpi",
    "take more ranks on more machines, ask for less (--max-dim), or raise "
    "--memory-limit"};

constexpr std::string_view kHelp =
    R"(mpirun -n RANKS ph-barcode-mpi [OPTION...] IMAGE -o BARS
mpirun -n RANKS ph-barcode-mpi --complex rips --max-dim 0 [OPTION...] POINTS

The barcode of one image of two or three axes (of up to eight: its components,
or the highest dimension but one), computed by all ranks, each of which looks
at some layers; or the components of points of up to eight coordinates, of which
each rank has some blocks. All ranks have to see the file. The bars are those of
ph-barcode, to the last byte.

Options are those of ph-barcode. For images: --raw-..., --channel,
--construction, --superlevel, --periodic, --max-dim, --min-dim, --field,
--slab-layers. For points: --columns. For both: --format, --nan, --threshold;
--output, --output-format, --min-persistence, --plot and how it looks. See
ph-barcode --help all. --threads and --memory-limit are those of a rank.

  --resume   keep the part of each rank beside the output until all is done, and
             take those that are there: a run that died goes on. Loops of volumes
             are computed anew
  --verbose  also what each rank took and sent
  --dry-run  say what the ranks will take and send, and compute nothing
  --progress json  lines of all ranks, with their numbers
)";

bool is_asked(int argc, char** argv, std::string_view option) {
  for (int i = 1; i < argc; ++i)
    if (argv[i] == option) return true;
  return false;
}

/// By default ranks of one machine share it.
void share_machine(ph::app::CommonOptions& options, int ranks) {
  const auto count = static_cast<unsigned>(ranks);
  if (!options.memory_limit) options.memory_limit = ph::machine_memory() / count;
  if (options.threads == 0)
    options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency() / count));
}

}  // namespace

int main(int argc, char** argv) {
  if (is_asked(argc, argv, "--help") || is_asked(argc, argv, "-h")) {
    std::fwrite(kHelp.data(), 1, kHelp.size(), stdout);
    return 0;
  }
  ph::barcode::MpiTransport transport(&argc, &argv);
  const int code = ph::app::run_program(kProgram, [&](const std::stop_token& stop) {
    ph::barcode::Arguments arguments;
    arguments.on_ranks = true;
    try {
      if (const auto answer = ph::barcode::parse_arguments(argc, argv, arguments))
        return transport.rank() == 0 ? ph::app::answer_command_line(*answer) : 0;
    } catch (const ph::Error&) {
      if (transport.rank() == 0) throw;
      transport.wait_for_all();  // rank 0 says why, and ends all
    }
    share_machine(arguments.common, transport.ranks_here());
    const bool is_first = transport.rank() == 0;
    // Notes come once; another rank that wants to be heard has to fail, or be asked to speak.
    arguments.common.quiet = arguments.common.quiet || (!is_first && !arguments.common.verbose);
    // A bar is that of the first rank; lines of JSON say whose they are.
    if (arguments.common.progress == ph::app::ProgressMode::json)
      arguments.common.rank = transport.rank();
    else if (!is_first)
      arguments.common.progress = ph::app::ProgressMode::none;
    const std::string name = is_first ? std::string(kProgram.name)
                                      : fmt::format("{}: rank {}", kProgram.name, transport.rank());
    ph::app::Session session(name, arguments.common, stop);
    return ph::barcode::run_ranks(
        arguments, transport, [&] { transport.wait_for_all(); }, session);
  });
  return transport.finish(code);
}
