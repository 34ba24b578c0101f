// SPDX-License-Identifier: MIT
#include "ph/ph.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <exception>
#include <future>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "ph/error.hpp"
#include "ph/persistence.hpp"

struct ph_barcode {
  explicit ph_barcode(ph::Barcode&& all) : bars(std::move(all)) {}
  ph::Barcode bars;
};

namespace {

using namespace ph;

// ph_barcode_bars returns the array of the barcode itself, without a copy.
static_assert(sizeof(ph_bar) == sizeof(Bar) && offsetof(ph_bar, dim) == offsetof(Bar, dim) &&
              offsetof(ph_bar, birth) == offsetof(Bar, birth) &&
              offsetof(ph_bar, death) == offsetof(Bar, death));

std::string& last_error() {
  thread_local std::string message = "no error";
  return message;
}

/// Stores a message for ph_last_error and returns `status`. This function never throws. It leaves
/// out the message if there is too little memory for it.
ph_status fail(ph_status status, const char* message) noexcept {
  try {
    last_error() = message;
  } catch (...) {
    last_error().clear();
  }
  return status;
}

ph_status status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
    case ErrorKind::not_built_in:
      return PH_USAGE;
    case ErrorKind::bad_data:
    case ErrorKind::no_input:
    case ErrorKind::cannot_create:
    case ErrorKind::io:
      return PH_BAD_DATA;
    case ErrorKind::resource:
      return PH_RESOURCE;
    case ErrorKind::cancelled:
      return PH_CANCELLED;
    case ErrorKind::internal:
      break;
  }
  return PH_INTERNAL;
}

template <class Use>
ph_status guarded(Use&& use) noexcept {
  try {
    use();
    return PH_OK;
  } catch (const Error& error) {
    return fail(status_of(error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    return fail(PH_RESOURCE, "out of memory");
  } catch (const std::length_error&) {  // the size is beyond the limit of a container
    return fail(PH_RESOURCE, "out of memory");
  } catch (const std::system_error& error) {  // thrown by std::async
    return fail(PH_RESOURCE, error.what());
  } catch (const std::exception& error) {
    return fail(PH_INTERNAL, error.what());
  } catch (...) {
    return fail(PH_INTERNAL, "an unknown exception");
  }
}

void require(bool holds, const char* message) {
  if (!holds) throw Error(ErrorKind::usage, message);
}

/// Returns the options of the caller. Members that the caller's version of the struct does not have
/// get their default values.
ph_options complete(const ph_options* given) {
  ph_options options;
  ph_options_init(&options);
  if (given == nullptr) return options;
  if (given->size < sizeof(given->size) || given->size > sizeof(options))
    throw Error(
        ErrorKind::usage,
        fmt::format("ph_options: found size {}, expected {} to {}; call ph_options_init first",
                    given->size, sizeof(given->size), sizeof(options)));
  std::memcpy(&options, given, given->size);
  return options;
}

static_assert(static_cast<ph_distance>(PointDistance::euclidean) == PH_EUCLIDEAN &&
              static_cast<ph_distance>(PointDistance::manhattan) == PH_MANHATTAN &&
              static_cast<ph_distance>(PointDistance::chebyshev) == PH_CHEBYSHEV &&
              static_cast<ph_distance>(PointDistance::minkowski) == PH_MINKOWSKI &&
              static_cast<ph_distance>(PointDistance::cosine) == PH_COSINE &&
              static_cast<ph_distance>(PointDistance::hamming) == PH_HAMMING);
static_assert(static_cast<ph_construction>(CubicalOptions::Construction::vertices) == PH_VERTICES &&
              static_cast<ph_construction>(CubicalOptions::Construction::cells) == PH_CELLS);

/// Converts a number from C to the value of an enum.
template <class Enum>
Enum choice(std::int32_t value, Enum last, const char* name) {
  if (value < 0 || value > static_cast<std::int32_t>(last))
    throw Error(ErrorKind::usage, fmt::format("ph_options::{}: found {}, expected 0 to {}", name,
                                              value, static_cast<std::int32_t>(last)));
  return static_cast<Enum>(value);
}

Options task_of(const ph_options& given) {
  if (given.max_dim < -1)
    throw Error(ErrorKind::usage,
                fmt::format("ph_options::max_dim: found {}, expected -1 or more", given.max_dim));
  if (given.max_dim >= 0 && given.min_dim > given.max_dim)
    throw Error(ErrorKind::usage,
                fmt::format("ph_options::min_dim: found {}, expected at most max_dim ({})",
                            given.min_dim, given.max_dim));
  Options options;
  if (given.max_dim >= 0) options.max_dim = given.max_dim;
  options.min_dim = given.min_dim;
  options.field = given.field;
  options.min_persistence = given.min_persistence;
  options.cells = given.cells != 0;
  return options;
}

std::optional<double> threshold_of(const ph_options& given) {
  return std::isnan(given.threshold) ? std::nullopt : std::optional(given.threshold);
}

/// Runs `compute` on a separate thread while the caller's thread asks whether to stop. Without a
/// function `cancel`, runs it on the caller's thread.
template <class Compute>
void watched(const ph_options& options, std::stop_source& stop, const Compute& compute) {
  if (options.cancel == nullptr) return compute();
  constexpr std::chrono::milliseconds interval(20);
  std::future<void> computed = std::async(std::launch::async, compute);
  while (computed.wait_for(interval) != std::future_status::ready)
    if (options.cancel(options.cancel_user) != 0) stop.request_stop();
  computed.get();
}

/// Runs `compute` and turns exceptions into a status. @param compute called with (options,
/// context): computes the result and stores it. @param out where `compute` stores the result; must
/// not be NULL.
template <class Out, class Compute>
ph_status run(const ph_options* given, const Out* out, const Compute& compute) {
  return guarded([&] {
    require(out != nullptr, "out: found NULL");
    const ph_options options = complete(given);
    std::stop_source stop;
    RunContext context;
    context.stop = stop.get_token();
    if (options.threads < 0)
      throw Error(ErrorKind::usage, fmt::format("ph_options::threads: found {}, expected 0 or more",
                                                options.threads));
    context.threads = options.threads;
    if (options.memory_limit != 0) context.memory.set_limit(options.memory_limit);
    watched(options, stop, [&] { compute(options, context); });
  });
}

/// Computes one barcode. @param make called with (options, context): makes the complex.
template <class Make>
ph_status barcode_of(const ph_options* given, ph_barcode** out, const Make& make) {
  return run(given, out, [&](const ph_options& options, const RunContext& context) {
    const Options task = task_of(options);  // checked before the input is read
    *out = new ph_barcode(persistence(make(options, context), task, context));
  });
}

/// Computes the barcodes of a batch. @param make called with (i, options, context): makes the
/// complex of input i.
template <class Make>
ph_status barcodes_of(const ph_options* given, std::size_t count, ph_barcode** out,
                      const Make& make) {
  return run(given, out, [&](const ph_options& options, const RunContext& context) {
    const Options task = task_of(options);
    std::vector<std::unique_ptr<ph_barcode>> bars(count);
    std::vector<std::optional<MemoryClaim>> held(count);  // the barcodes that are done
    for_each_input(count, context, [&](std::size_t i, const RunContext& of_input) {
      bars[i] =
          std::make_unique<ph_barcode>(persistence(make(i, options, of_input), task, of_input));
      held[i].emplace(context.memory, bars[i]->bars.bytes());
    });
    for (std::size_t i = 0; i < count; ++i) out[i] = bars[i].release();
  });
}

RipsOptions rips_options(const ph_options& given) {
  RipsOptions options;
  options.threshold = threshold_of(given);
  options.distance = choice(given.distance, PointDistance::hamming, "distance");
  options.minkowski_p = given.minkowski_p;
  return options;
}

PointsView points_of(const double* data, std::int64_t rows, std::int64_t columns,
                     std::int64_t row_stride, std::int64_t column_stride) {
  if (rows < 0 || columns < 0)
    throw Error(ErrorKind::usage,
                fmt::format("points: found {} rows of {} columns, expected 0 or more of each", rows,
                            columns));
  require(data != nullptr || rows == 0 || columns == 0, "data: found NULL");
  return {data, rows, columns, row_stride, column_stride};
}

Image image_of(const void* data, ph_number type, std::int32_t axes, const std::int64_t* extents,
               const std::int64_t* strides, const RunContext& context) {
  if (axes < 1 || axes > Cubical::kMaxDim)
    throw Error(ErrorKind::usage,
                fmt::format("axes: found {}, expected 1 to {}", axes, Cubical::kMaxDim));
  require(extents != nullptr, "extents: found NULL");
  std::size_t count = 1;
  for (std::int32_t k = 0; k < axes; ++k) {
    constexpr std::size_t most = UINT32_MAX;
    if (extents[k] < 1 || static_cast<std::uint64_t>(extents[k]) > most / count)
      throw Error(ErrorKind::usage,
                  fmt::format("extent {}: found {}, expected at least 1 and fewer than 2^32 voxels",
                              k, extents[k]));
    count *= static_cast<std::size_t>(extents[k]);
  }
  require(data != nullptr, "data: found NULL");
  if (type > PH_FLOAT64)
    throw Error(ErrorKind::usage,
                fmt::format("type: found {}, expected a ph_number, 0 to {}",
                            static_cast<unsigned>(type), static_cast<unsigned>(PH_FLOAT64)));
  const auto voxel = static_cast<VoxelType>(type);
  // The image may have to copy the voxels.
  if (strides != nullptr) context.memory.require(count * bytes_of(voxel));
  std::vector<std::ptrdiff_t> steps;
  if (strides != nullptr) steps.assign(strides, strides + axes);
  return image_of_array(voxel, data, std::vector<Index>(extents, extents + axes), steps);
}

Cubical cubical_of(const void* data, ph_number type, std::int32_t axes, const std::int64_t* extents,
                   const std::int64_t* strides, const ph_options& options,
                   const RunContext& context) {
  Image image = image_of(data, type, axes, extents, strides, context);
  image.masked = options.masked != 0;
  CubicalOptions cubes;
  cubes.construction =
      choice(options.construction, CubicalOptions::Construction::cells, "construction");
  cubes.superlevel = options.superlevel != 0;
  cubes.threshold = threshold_of(options);
  if (options.periodic != nullptr)
    for (std::int32_t k = 0; k < axes; ++k) cubes.periodic.push_back(options.periodic[k] != 0);
  return Cubical(image, cubes, context);
}

std::size_t numbers_of(std::optional<InputCell> cell, const std::int64_t** numbers) {
  if (numbers != nullptr) *numbers = cell ? cell->numbers.data() : nullptr;
  return cell ? cell->numbers.size() : 0;
}

}  // namespace

int ph_abi_version(void) { return PH_ABI_VERSION; }
const char* ph_version(void) { return PH_VERSION; }
const char* ph_last_error(void) { return last_error().c_str(); }

void ph_options_init_sized(ph_options* options, size_t size) {
  ph_options defaults{};
  defaults.size = size;
  defaults.max_dim = -1;
  defaults.field = 2;
  defaults.threshold = std::nan("");
  defaults.cells = 1;
  defaults.distance = PH_EUCLIDEAN;
  defaults.minkowski_p = 2;
  if (options != nullptr) std::memcpy(options, &defaults, std::min(size, sizeof(defaults)));
}

ph_status ph_rips_points(const double* data, int64_t rows, int64_t columns, int64_t row_stride,
                         int64_t column_stride, const ph_options* options, ph_barcode** out) {
  return barcode_of(options, out, [&](const ph_options& o, const RunContext& context) {
    return Rips::borrowed(points_of(data, rows, columns, row_stride, column_stride),
                          rips_options(o), context);
  });
}

ph_status ph_rips_points_batch(const double* const* clouds, const int64_t* rows, int64_t columns,
                               size_t count, const ph_options* options, ph_barcode** out) {
  return barcodes_of(options, count, out,
                     [&](std::size_t i, const ph_options& o, const RunContext& context) {
                       require(clouds != nullptr && rows != nullptr, "clouds or rows: found NULL");
                       return Rips::borrowed(points_of(clouds[i], rows[i], columns, columns, 1),
                                             rips_options(o), context);
                     });
}

ph_status ph_rips_distances(const double* lower, int64_t size, const ph_options* options,
                            ph_barcode** out) {
  return barcode_of(options, out, [&](const ph_options& o, const RunContext& context) {
    constexpr std::int64_t most = std::int64_t{1} << 31;
    if (size < 0 || size > most)
      throw Error(ErrorKind::usage,
                  fmt::format("distances: found {} points, expected 0 to 2^31", size));
    require(lower != nullptr || size < 2, "lower: found NULL");
    const std::size_t count =
        size < 2 ? 0 : static_cast<std::size_t>(size) * static_cast<std::size_t>(size - 1) / 2;
    context.memory.require(count * sizeof(double));
    // Converts the options first, because compilers may evaluate arguments in any order.
    const RipsOptions rips = rips_options(o);
    return Rips(DistanceMatrix(size, std::vector<double>(lower, lower + count)), rips, context);
  });
}

ph_status ph_cubical_image(const void* data, ph_number type, int32_t axes, const int64_t* extents,
                           const int64_t* strides, const ph_options* options, ph_barcode** out) {
  return barcode_of(options, out, [&](const ph_options& o, const RunContext& context) {
    return cubical_of(data, type, axes, extents, strides, o, context);
  });
}

ph_status ph_cubical_image_batch(const void* const* images, ph_number type, int32_t axes,
                                 const int64_t* extents, size_t count, const ph_options* options,
                                 ph_barcode** out) {
  return barcodes_of(options, count, out,
                     [&](std::size_t i, const ph_options& o, const RunContext& context) {
                       require(images != nullptr, "images: found NULL");
                       return cubical_of(images[i], type, axes, extents, nullptr, o, context);
                     });
}

size_t ph_barcode_size(const ph_barcode* bars) { return bars == nullptr ? 0 : bars->bars.size(); }
const ph_bar* ph_barcode_bars(const ph_barcode* bars) {
  if (ph_barcode_size(bars) == 0) return nullptr;
  return reinterpret_cast<const ph_bar*>(&bars->bars[0]);
}
size_t ph_barcode_birth_cell(const ph_barcode* bars, size_t i, const int64_t** numbers) {
  if (i >= ph_barcode_size(bars)) return numbers_of(std::nullopt, numbers);
  return numbers_of(bars->bars.birth_cell(i), numbers);
}
size_t ph_barcode_death_cell(const ph_barcode* bars, size_t i, const int64_t** numbers) {
  if (i >= ph_barcode_size(bars)) return numbers_of(std::nullopt, numbers);
  return numbers_of(bars->bars.death_cell(i), numbers);
}
void ph_barcode_free(ph_barcode* bars) { delete bars; }
