// SPDX-License-Identifier: MIT
#include "apps/barcode/parts/part_input.hpp"

#include <fmt/format.h>

#include <string_view>

#include "apps/barcode/complex/cubical_options.hpp"
#include "apps/barcode/complex/read_input.hpp"
#include "apps/barcode/job/own_complex.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::barcode {

PartInput read_part_input(const std::string& input, bool keeps_cells, const Job& job,
                          app::Session& session) {
  const std::string_view why = job.sharing.part ? "--part" : "several ranks";
  if (job.question.complex != ComplexKind::automatic &&
      job.question.complex != ComplexKind::cubical)
    throw Error(
        ErrorKind::usage,
        fmt::format("--complex: found {}, expected cubical, or rips with --max-dim 0, for {}",
                    job.question.own_complex
                        ? job.question.own_complex->name
                        : complex_names()[static_cast<std::size_t>(job.question.complex)],
                    why));
  const Input opened = open_input(input, job, session.context(), Input::Excess::is_expected,
                                  detail::start_check(job.reading.format));
  if (job.reading.format == Format::automatic && !job.reading.options.stack && is_barcode(opened))
    throw Error(ErrorKind::usage,
                fmt::format("{}: {} is a barcode, expected an image", why, opened.name()));
  const NamedData data = read_input(opened, job, session.context());
  const auto* const image = std::get_if<Image>(&data.read.data);
  if (image == nullptr)
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: found {}, expected an image (--complex cubical); points need --complex "
                    "rips --max-dim 0",
                    why, data.read.description));
  session.explain(fmt::format("read {}: {}", data.name, data.read.description));
  if (job.reading.options.allow_empty)
    session.explain("--allow-empty: not needed, because the input is not empty");
  for (const Message& note : data.read.notes)
    session.note(fmt::format("{}: {}", data.name, note.marked()));
  if (const int layers = job.common.slab_layers; layers > 0)
    session.explain(
        fmt::format("slabs of {}", app::count_of(static_cast<std::size_t>(layers), "layer")));
  const ImagePartOptions options{.cubical = cubical_options(job, *image, data.read.periodic),
                                 .min_dim = job.question.options.min_dim,
                                 .max_dim = job.question.options.max_dim,
                                 .cells = keeps_cells};
  return {*image, options, data.read.description};
}

}  // namespace ph::barcode
