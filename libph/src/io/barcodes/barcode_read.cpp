// SPDX-License-Identifier: MIT
#include "libph/src/io/barcodes/barcode_read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"

namespace ph {
namespace {

Barcode read_dipha(const Input& input) {
  const detail::DiphaType type = detail::dipha_type(input);
  if (type != detail::DiphaType::diagram) {
    input.fail_at_byte(8, {"not a persistence diagram",
                           fmt::format("DIPHA file type {}", static_cast<std::int64_t>(type)),
                           "type 2",
                           {}});
  }
  BinaryCursor cursor(input, std::endian::little, 16);
  constexpr std::size_t kBar = 24;
  const std::size_t count = cursor.read_count("number of bars", kBar);
  input.require_memory(count * 5 * sizeof(double));
  Barcode barcode;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = cursor.offset();
    // An essential class of dimension k is stored with the dimension -k-1. Its death is used only
    // for drawing.
    const auto dim = cursor.read<std::int64_t>("bar");
    Bar bar;
    bar.birth = cursor.read<double>("bar") + 0.0;
    bar.death = cursor.read<double>("bar") + 0.0;
    const std::int64_t real = dim < 0 ? -(dim + 1) : dim;
    if (dim < 0) bar.death = kInfinity;
    if (real > kMostBarDimension) {
      input.fail_at_byte(at, {"dimension out of range",
                              fmt::format("{}", dim),
                              fmt::format("at most {}", kMostBarDimension),
                              {}});
    }
    bar.dim = static_cast<int>(real);
    if (const Fault fault = fault_of_bar(bar); !fault.what.empty()) input.fail_at_byte(at, fault);
    barcode.add(bar, {}, {});
  }
  cursor.expect_end();
  return barcode;
}

/// Reads an array whose rows consist of dim, birth and death. CubicalRipser appends the three or
/// four coordinates of the birth voxel and of the death voxel, and writes the largest double for
/// infinity.
StoredBarcode read_npy(const Input& input) {
  const Image array = detail::read_npy_array(input);
  const std::size_t width = array.dim() == 2 ? array.extents[1] : 0;
  const bool has_places = width == 9 || width == 11;
  if (width != 3 && !has_places) {
    input.fail(
        {"not a barcode",
         fmt::format("shape ({})", fmt::join(array.extents, ", ")),
         "rows of dim, birth, death, alone or with the coordinates of 2 voxels (9 or 11 numbers)",
         {}});
  }
  const auto value = [&](double stored) {
    constexpr double kLargest = std::numeric_limits<double>::max();
    // mutant: bars-infinite
    return has_places && std::abs(stored) == kLargest ? std::copysign(kInfinity, stored) : stored;
  };
  StoredBarcode stored;
  if (has_places) stored.left_out = {"birth and death voxels"};
  for (std::size_t k = 0; k < array.values.size(); k += width) {
    const double dim = array.values[k];
    Fault fault;
    if (!(dim >= 0 && dim <= static_cast<double>(kMostBarDimension) && dim == std::floor(dim))) {
      fault = {"dimension", fmt::format("{}", dim), fmt::format("0 to {}", kMostBarDimension), {}};
    }
    const Bar bar{fault.what.empty() ? static_cast<int>(dim) : 0, value(array.values[k + 1]),
                  value(array.values[k + 2])};
    if (fault.what.empty()) fault = fault_of_bar(bar);
    if (!fault.what.empty()) {
      fault.what = fmt::format("row {}: {}", k / width, fault.what);
      input.fail(fault);
    }
    stored.bars.add(bar, {}, {});
  }
  return stored;
}

// The content decides the format. If the content does not identify the format, the extension
// decides. The default is csv.
BarcodeFormat format_of(const Input& input) {
  if (detail::is_npy(input) || detail::is_npz(input)) return BarcodeFormat::npy;
  if (detail::is_dipha(input)) return BarcodeFormat::dipha;
  const std::string_view text = input.text();
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '{') return BarcodeFormat::json;
  if (text.substr(0, 4096).find(kRipserHeading) != std::string_view::npos) {
    return BarcodeFormat::ripser;
  }
  return barcode_format_of_path("x" + input.extension()).value_or(BarcodeFormat::csv);
}

/// Sorts the bars, and their loops and p-values with them.
void sort(StoredBarcode& stored) {
  Barcode& bars = stored.bars;
  if (!stored.loops.empty() || !stored.p_values.empty()) {
    std::vector<std::size_t> order(bars.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      const auto values = [&](std::size_t i) {
        return std::tie(bars[i].dim, bars[i].birth, bars[i].death);
      };
      if (values(a) != values(b)) return values(a) < values(b);
      return std::ranges::lexicographical_compare(bars.birth_cell(a).numbers,
                                                  bars.birth_cell(b).numbers);
    });
    const auto reorder = [&](auto& of_bars) {
      if (of_bars.empty()) return;
      std::remove_reference_t<decltype(of_bars)> sorted;
      for (const std::size_t i : order) sorted.push_back(std::move(of_bars[i]));
      of_bars = std::move(sorted);
    };
    reorder(stored.loops);
    reorder(stored.p_values);
  }
  bars.sort();
}

}  // namespace

bool is_barcode(const Input& input) {
  if (detail::is_dipha(input)) return detail::dipha_type(input) == detail::DiphaType::diagram;
  // An input is not a barcode if its magic number or its extension belongs to another format, or if
  // its bytes are not text.
  if (detail::format_by_content(input)) return false;
  switch (format_of(input)) {
    case BarcodeFormat::json:
    case BarcodeFormat::ripser:
    case BarcodeFormat::pers:
      return true;
    default:
      return has_barcode_header(input);
  }
}

Fault fault_of_bar(const Bar& bar) {
  if (std::isnan(bar.birth) || bar.birth == kInfinity) {
    return {"birth of a bar", shortest(bar.birth), "a number", {}};
  }
  if (!(bar.death >= bar.birth)) {
    return {"a bar that dies before its birth",
            fmt::format("birth {} and death {}", shortest(bar.birth), shortest(bar.death)),
            "birth <= death",
            {}};
  }
  return {};
}

Input::StartCheck barcode_start_check(std::optional<BarcodeFormat> format) {
  return [format](const Input& start) {
    switch (format.value_or(format_of(start))) {
      case BarcodeFormat::dipha:
        detail::dipha_type(start);
        break;
      case BarcodeFormat::npy:
        if (!detail::is_npy(start) && !detail::is_npz(start)) read_npy(start);
        break;
      default:
        TextLines{start};  // refuses bytes that are not text
    }
  };
}

StoredBarcode read_stored_barcode(const Input& input, std::optional<BarcodeFormat> format) {
  const auto read = [&]() -> StoredBarcode {
    switch (format.value_or(format_of(input))) {
      case BarcodeFormat::json:
        return read_barcode_json(input);
      case BarcodeFormat::ripser:
        return {.bars = read_barcode_ripser(input)};
      case BarcodeFormat::dipha:
        return {.bars = read_dipha(input)};
      case BarcodeFormat::npy:
        return read_npy(input);
      case BarcodeFormat::pers:
        return read_barcode_rows(input, true);  // an empty barcode is stored as an empty file
      case BarcodeFormat::csv:
      case BarcodeFormat::none:
        break;
    }
    return read_barcode_rows(input, false);
  };
  input.take_memory();
  StoredBarcode stored = read();
  sort(stored);
  return stored;
}

Barcode read_barcode(const Input& input, std::optional<BarcodeFormat> format) {
  return read_stored_barcode(input, format).bars;
}

Barcode read_barcode(const std::filesystem::path& path, std::optional<BarcodeFormat> format,
                     const RunContext* context) {
  return read_barcode(
      Input::open(path, context, Input::Excess::refused, barcode_start_check(format)), format);
}

}  // namespace ph
