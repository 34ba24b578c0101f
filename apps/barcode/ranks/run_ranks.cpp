// SPDX-License-Identifier: MIT
#include "apps/barcode/ranks/rank_result.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "apps/barcode/arguments/scopes.hpp"
#include "apps/barcode/batch.hpp"
#include "apps/barcode/output/outputs.hpp"
#include "apps/barcode/parts/part_files.hpp"
#include "apps/common/files/file_identity.hpp"
#include "ph/detail/core/files.hpp"

namespace ph::barcode {

int run_ranks(const Job& job, Transport& transport, const std::function<void()>& wait_for_all,
              app::Session& session) {
  if (!job.wants_part_of_one())
    throw Error(ErrorKind::usage,
                "INPUT: found several inputs or a folder, expected one image or cloud");
  const bool is_image = job.wants_image_part();
  const Situation situation = is_image ? kRanks : kCloudRanks;
  app::require_in_scope(job.given, situation, name_of(situation));
  const std::string& path = job.inputs.front();
  const BarcodeFormat format = output_format(job, session);
  Job own = job;
  own.places.input = path;
  own.places.format = format;
  app::InputFiles inputs;
  inputs.add(path, job.reading.format);
  std::vector<app::Written> written{{"--output", job.places.output}};
  for (const app::Plot& plot : job.places.plots) written.push_back({plot.option, plot.path});
  app::require_separate(inputs, written, job.common.force);
  // The outputs are opened first, so that a file that cannot be created is reported before the
  // computation.
  std::optional<Outputs> outputs;
  if (transport.rank() == 0 && !job.results.dry_run) outputs.emplace(own.places);

  RankResult result =
      is_image ? image_of_ranks(own, transport, session) : cloud_of_ranks(own, transport, session);
  int code = 0;
  if (result.bars) {
    const Outcome outcome =
        write_bars(std::move(result.bars->bars), result.bars->info, *outputs, job, session);
    session.note(outcome.summary);
    code = outcome.code;
  }
  // Parts are kept until the result has been written.
  wait_for_all();
  std::error_code ignored;
  if (job.sharing.resumes && !result.kept.empty())
    std::filesystem::remove(files::path_of(result.kept), ignored);
  return code;
}

}  // namespace ph::barcode
