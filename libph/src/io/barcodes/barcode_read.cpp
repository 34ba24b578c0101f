// SPDX-License-Identifier: MIT
#include "io/barcodes/barcode_read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/points/table.hpp"
#include "io/readers.hpp"

namespace ph {
namespace {

// Adds a bar that was found in the current line.
void add_at(const TextLines& lines, Barcode& barcode, const Bar& bar) {
  if (const Fault fault = fault_of_bar(bar); !fault.what.empty()) {
    lines.fail(lines.line().data(), fault);
  }
  barcode.add(bar, {}, {});
}

void require_cell(const TextLines& lines, const Cells& cells, const char* what,
                  const char* expected) {
  if (cells.more()) return;
  lines.fail(lines.line().data() + lines.line().size(),
             {fmt::format("{} missing", what), "the end of the line", expected, {}});
}

/// Whether they are those of a header of ours; p-values may follow the bars. R's TDA writes
/// dimension, Birth, Death.
bool is_header(std::vector<std::string> names) {
  constexpr std::array<std::string_view, 4> kNames{"dim", "birth", "death", "p"};
  for (std::string& name : names) {
    std::ranges::transform(name, name.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    if (name == "dimension") name = "dim";
  }
  return (names.size() == 3 || names.size() == 4) &&
         std::equal(names.begin(), names.end(), kNames.begin());
}

/// A dimension, which programs that have floats only write as 1.0 or 1.000e+00.
int read_dimension(Cells& cells) {
  Cells ahead = cells;
  const std::string_view word = cells.more() ? ahead.word() : std::string_view();
  const double value = detail::number_in(word).value_or(-1);
  if (word.find_first_of(".eE") != word.npos && value >= 0 && value <= kMostBarDimension &&
      value == std::floor(value)) {
    cells = ahead;
    return static_cast<int>(value);
  }
  return static_cast<int>(cells.integer(0, kMostBarDimension, "dimension"));
}

void check_p(const TextLines& lines, Cells& cells) {
  const char* const begin = cells.place();
  const std::string_view rest(begin, lines.line().data() + lines.line().size());
  if (rest.find_first_not_of(" \t") == rest.npos) {
    cells.skip();
    return;
  }
  const double p = cells.number();
  if (!(p >= 0 && p <= 1))
    lines.fail(begin, {"p-value", shortest(p), "a number from 0 to 1, or nothing", {}});
}

// `dim birth death` or GUDHI's `p dim birth death`, one a line; a header line may stand before.
// Behind a header with p a line may end in a p-value, which is checked and left out.
// @param has_p receives whether there is such a header.
Barcode read_rows(const Input& input, bool may_be_empty, bool& has_p) {
  Barcode barcode;
  TextLines lines(input);
  Cells cells(lines);
  std::size_t columns = 0;
  bool header = false;
  has_p = false;
  while (lines.next()) {
    if (columns == 0 && !header) {
      const std::vector<std::string> names = header_names(lines.line());
      if (!names.empty()) {
        if (!is_header(names)) {
          lines.fail(lines.line().data(),
                     {"header", '"' + printable(lines.line(), 40) + '"', "dim,birth,death", {}});
        }
        header = true;
        has_p = names.size() == 4;
        continue;
      }
    }
    if (columns == 0) {  // the first bar says which of the two it is
      Cells counter(lines);
      for (counter.start(); counter.more(); ++columns) counter.word();
      if (columns == 2) {
        lines.fail(lines.line().data(), {"no dimension", "2 cells", "dim birth death", {}});
      }
    }
    constexpr const char* kExpected = "dim birth death, or p dim birth death";
    cells.start();
    if (columns == 4 && !has_p) {
      cells.integer(2, std::numeric_limits<std::int32_t>::max(), "characteristic");
      require_cell(lines, cells, "dimension", kExpected);
    }
    Bar bar;
    bar.dim = read_dimension(cells);
    require_cell(lines, cells, "birth", kExpected);
    bar.birth = cells.number(Allow::infinite);
    require_cell(lines, cells, "death", kExpected);
    bar.death = cells.number(Allow::infinite);
    if (has_p && cells.more()) check_p(lines, cells);
    cells.expect_end(kExpected);
    add_at(lines, barcode, bar);
  }
  if (barcode.empty() && !header && !may_be_empty) {
    input.fail({"no bars", "nothing", "a header or a line dim birth death", {}});
  }
  return barcode;
}

constexpr std::string_view kRipserHeading = "persistence intervals in dim ";

// What Ripser prints: a heading for each dimension and lines ` [birth,death)`; whatever comes
// before the first heading says what was read.
Barcode read_ripser_text(const Input& input) {
  Barcode barcode;
  TextLines lines(input);
  std::optional<int> dim;
  while (lines.next()) {
    std::string_view line = lines.line();
    if (line.starts_with(kRipserHeading) && line.ends_with(':')) {
      Cells cells(lines);
      line.remove_suffix(1);
      cells.start_in(line.substr(kRipserHeading.size()));
      dim = static_cast<int>(cells.integer(0, kMostBarDimension, "dimension"));
      cells.expect_end("the dimension alone");
      continue;
    }
    if (!dim) continue;
    const std::size_t comma = line.find(',');
    if (!line.starts_with('[') || !line.ends_with(')') || comma == std::string_view::npos) {
      lines.fail(line.data(), {"not an interval", printable(line, 40), "[birth,death)",
                               lines.offset() == input.size() ? "is the file truncated?" : ""});
    }
    Bar bar;
    bar.dim = *dim;
    Cells cells(lines);
    cells.start_in(line.substr(1, comma - 1));
    bar.birth = cells.number(Allow::infinite);
    cells.expect_end("one number");
    cells.start_in(line.substr(comma + 1, line.size() - comma - 2));
    if (cells.more()) {  // else it never dies
      bar.death = cells.number(Allow::infinite);
      cells.expect_end("one number");
    }
    add_at(lines, barcode, bar);
  }
  if (!dim) {
    input.fail({"no intervals", "no heading", "\"persistence intervals in dim 0:\"", {}});
  }
  return barcode;
}

Barcode read_dipha(const Input& input) {
  if (detail::dipha_type(input) != detail::DiphaType::diagram) {
    input.fail_at_byte(8, {"not a persistence diagram", "another DIPHA file", "file type 2", {}});
  }
  BinaryCursor cursor(input, std::endian::little, 16);
  constexpr std::size_t kBar = 24;
  const std::size_t count = cursor.read_count("number of bars", kBar);
  input.require_memory(count * 5 * sizeof(double));
  Barcode barcode;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = cursor.offset();
    // An essential class of dimension k is stored as -k-1; its death is only a drawing's.
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

Barcode read_npy(const Input& input) {
  const Image array = detail::read_npy_array(input);
  if (array.dim() != 2 || array.extents[1] != 3) {
    input.fail({"not a barcode",
                fmt::format("shape ({})", fmt::join(array.extents, ", ")),
                "rows of dim, birth, death",
                {}});
  }
  Barcode barcode;
  for (std::size_t k = 0; k < array.values.size(); k += 3) {
    const double dim = array.values[k];
    Fault fault;
    if (!(dim >= 0 && dim <= static_cast<double>(kMostBarDimension) && dim == std::floor(dim))) {
      fault = {"dimension", fmt::format("{}", dim), fmt::format("0 to {}", kMostBarDimension), {}};
    }
    const Bar bar{fault.what.empty() ? static_cast<int>(dim) : 0, array.values[k + 1],
                  array.values[k + 2]};
    if (fault.what.empty()) fault = fault_of_bar(bar);
    if (!fault.what.empty()) {
      fault.what = fmt::format("row {}: {}", k / 3, fault.what);
      input.fail(fault);
    }
    barcode.add(bar, {}, {});
  }
  return barcode;
}

// By content, then by extension; rows of numbers are what is left.
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

bool has_header(const Input& input) {
  TextLines lines(input);
  return lines.next() && is_header(header_names(lines.line()));
}

}  // namespace

bool is_barcode(const Input& input) {
  if (detail::is_dipha(input)) return detail::dipha_type(input) == detail::DiphaType::diagram;
  // Bytes without a magic number may begin like any text, and names say what other text is.
  if (detail::format_by_content(input)) return false;
  switch (format_of(input)) {
    case BarcodeFormat::json:
    case BarcodeFormat::ripser:
    case BarcodeFormat::pers:
      return true;
    default:
      return input.text().substr(0, 64).find("dim") != std::string_view::npos && has_header(input);
  }
}

Fault fault_of_bar(const Bar& bar) {
  if (std::isnan(bar.birth) || bar.birth == kInfinity) {
    return {"birth of a bar", shortest(bar.birth), "a number", {}};
  }
  if (!(bar.death >= bar.birth)) {
    return {"a bar that dies before its birth",
            fmt::format("{} and {}", shortest(bar.birth), shortest(bar.death)),
            "birth <= death",
            {}};
  }
  return {};
}

StoredBarcode read_stored_barcode(const Input& input, std::optional<BarcodeFormat> format) {
  const auto rows = [&](bool may_be_empty) {
    bool has_p = false;
    StoredBarcode stored{read_rows(input, may_be_empty, has_p), {}, {}};
    if (has_p) stored.left_out.emplace_back("p");
    return stored;
  };
  const auto read = [&]() -> StoredBarcode {
    switch (format.value_or(format_of(input))) {
      case BarcodeFormat::json:
        return read_barcode_json(input);
      case BarcodeFormat::ripser:
        return {read_ripser_text(input), {}, {}};
      case BarcodeFormat::dipha:
        return {read_dipha(input), {}, {}};
      case BarcodeFormat::npy:
        return {read_npy(input), {}, {}};
      case BarcodeFormat::pers:
        return rows(true);  // an empty barcode is an empty file
      case BarcodeFormat::csv:
      case BarcodeFormat::none:
        break;
    }
    return rows(false);
  };
  input.take_memory();
  StoredBarcode stored = read();
  stored.bars.sort();
  return stored;
}

Barcode read_barcode(const Input& input, std::optional<BarcodeFormat> format) {
  return read_stored_barcode(input, format).bars;
}

Barcode read_barcode(const std::filesystem::path& path, std::optional<BarcodeFormat> format,
                     const RunContext* context) {
  return read_barcode(Input::open(path, context), format);
}

}  // namespace ph
