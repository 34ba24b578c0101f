// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "ph/detail/core/floating.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/detail/io/table.hpp"

namespace ph {
namespace {

constexpr std::size_t kShown = 40;           // bytes of a cell shown in a message
constexpr std::size_t kProbe = 4096;         // bytes that decide between text and binary
constexpr std::size_t kPollBytes = 1 << 18;  // bytes between two polls of the stop token

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool ends_cell(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';'; }

std::string quoted(std::string_view bytes) {
  std::string result(1, '"');
  result += printable(bytes, kShown);
  result += '"';
  return result;
}

bool starts_with_word(std::string_view cell, std::string_view word) {
  if (!cell.empty() && (cell[0] == '-' || cell[0] == '+')) cell.remove_prefix(1);
  if (cell.size() < word.size()) return false;
  return std::equal(word.begin(), word.end(), cell.begin(),
                    [](char a, char b) { return a == to_lower(b); });
}

// For a decimal number that double cannot represent: true if the number is too small and rounds to
// zero, false if it is too large. The sign of the number's decimal exponent decides.
bool rounds_to_zero(std::string_view cell) {
  std::size_t i = !cell.empty() && (cell[0] == '-' || cell[0] == '+') ? 1 : 0;
  std::int64_t leading = 0;  // decimal exponent of the first non-zero digit
  bool point = false, found = false;
  for (; i < cell.size() && (is_digit(cell[i]) || cell[i] == '.'); ++i) {
    if (cell[i] == '.') {
      point = true;
    } else if (cell[i] != '0') {
      found = true;
      if (!point) ++leading;
    } else if (found && !point) {
      ++leading;
    } else if (!found && point) {
      --leading;
    }
    if (found && point) break;
  }
  while (i < cell.size() && to_lower(cell[i]) != 'e') ++i;
  if (i == cell.size()) return leading < 0;
  ++i;
  const bool negative = i < cell.size() && cell[i] == '-';
  if (i < cell.size() && (cell[i] == '-' || cell[i] == '+')) ++i;
  std::int64_t exponent = 0;
  const auto [stop, error] = std::from_chars(cell.data() + i, cell.data() + cell.size(), exponent);
  if (error != std::errc{}) return negative;
  // This limit is larger than the number of digits in a line.
  exponent = std::min(exponent, std::int64_t{1} << 40);
  return (negative ? leading - exponent : leading + exponent) < 0;
}

std::string hint_for(std::string_view cell) {
  if (starts_with_word(cell, "0x")) return "hexadecimal numbers are not read";
  if (cell.find('_') != std::string_view::npos) return "write numbers without digit separators";
  if (cell.find(',') != std::string_view::npos) return "write a decimal point, not a comma";
  if (!cell.empty() && cell[0] == '\'') return "write numbers without quotes";
  if (cell.find('\r') != std::string_view::npos) return "end lines with a line feed";
  if (cell.find(".#INF") != std::string_view::npos) return "write infinity as inf";
  if (cell.find(".#") != std::string_view::npos) return "write NaN as nan";
  if (cell.find('#', 1) != std::string_view::npos) return "write a blank before the # of a comment";
  if (cell.find('\0') != std::string_view::npos) return "is this a binary file?";
  return {};
}

// The end of a quoted text, in which each quote is written twice. Returns `begin` if there is no
// closing quote.
const char* end_of_quotes(const char* begin, const char* end) {
  for (const char* close = begin;;) {
    close = std::find(close + 1, end, '"');
    if (close == end) return begin;  // there is no closing quote
    if (close + 1 == end || close[1] != '"') return close + 1;
    ++close;
  }
}

// True if a '#' belongs to the cell that begins before it. The cell may be a word or 1.#INF, an old
// way to write infinity.
bool is_in_cell(const char* cell, const char* hash) {
  if (cell == hash) return false;
  if (*cell == '-' || *cell == '+') ++cell;
  const bool is_number = is_digit(*cell) || (*cell == '.' && cell + 1 != hash);
  return !is_number || hash[-1] == '.';
}

// The start of a line's comment, or the end of the line if it has no comment.
const char* start_of_comment(const char* begin, const char* end) {
  constexpr std::array<std::string_view, 7> kSpreadsheetErrors{
      "#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NUM!", "#NAME?", "#NULL!"};
  bool in_quotes = false;
  const char* cell = begin;  // the cell that contains `hash` or ends before it
  for (const char* p = begin;; ++p) {
    const auto* const hash =
        static_cast<const char*>(std::memchr(p, '#', static_cast<std::size_t>(end - p)));
    if (hash == nullptr) return end;
    for (const char* q = hash; q != p; --q) {
      if (!ends_cell(q[-1])) continue;
      cell = q;
      break;
    }
    if (std::count(p, hash, '"') % 2 != 0) in_quotes = !in_quotes;
    const std::string_view rest(hash, static_cast<std::size_t>(end - hash));
    const bool is_error = std::ranges::any_of(
        kSpreadsheetErrors, [&](std::string_view error) { return rest.starts_with(error); });
    if (!in_quotes && !is_error && !is_in_cell(cell, hash)) return hash;
    p = hash;
  }
}

}  // namespace

namespace detail {

void require_text(const Input& input, std::string_view hint) {
  const std::string_view probe = input.text().substr(0, kProbe);
  const std::string_view mark = probe.substr(0, 2);
  // The hint names no option, because programs that only read clouds have no --format.
  const std::string to_utf8 = "save it as UTF-8";
  if (const auto foreign = foreign_kind(input.text())) {
    input.fail_at_byte(
        0, {"not plain text", std::string(foreign->name), "UTF-8", std::string(foreign->advice)});
  }
  if (mark == "\xFF\xFE" || mark == "\xFE\xFF") {
    input.fail_at_byte(0, {"not plain text", "a UTF-16 byte order mark", "UTF-8", to_utf8});
  }
  const std::size_t nul = probe.find('\0');
  if (nul == std::string_view::npos) return;
  const auto nuls = static_cast<std::size_t>(std::ranges::count(probe, '\0'));
  const bool utf16 =
      nul < 2 && nuls * 3 > probe.size() && nuls * 3 < probe.size() * 2 &&
      std::ranges::all_of(probe, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  input.fail_at_byte(nul, {"not plain text", utf16 ? "NUL bytes as in UTF-16" : "a NUL byte",
                           "UTF-8", utf16 ? to_utf8 : std::string(hint)});
}

}  // namespace detail

TextLines::TextLines(const Input& input) : TextLines(input, 0, 0) {
  detail::require_text(input, "is this a binary file of another format?");
  if (input.text().starts_with("\xEF\xBB\xBF")) position_ += 3;
}

TextLines::TextLines(const Input& input, std::size_t offset, std::size_t lines_before)
    : input_(input),
      position_(input.text().data() + offset),
      end_(input.text().data() + input.size()),
      start_(position_),
      number_(lines_before) {}

bool TextLines::next() {
  while (position_ != end_) {
    ++number_;
    if (offset() - polled_ >= kPollBytes) input_.poll(polled_ = offset());
    start_ = position_;
    const auto left = static_cast<std::size_t>(end_ - position_);
    const auto* stop =
        static_cast<const char*>(std::memchr(start_, '\n', std::min(left, kMaxLine + 1)));
    if (stop == nullptr) {
      if (left > kMaxLine) {
        input_.fail_at(number_, 1,
                       {"line too long", fmt::format("no line end in {} MiB", kMaxLine >> 20),
                        "lines of data", "is this text?"});
      }
      stop = end_;
      position_ = end_;
    } else {
      position_ = stop + 1;
    }
    const char* begin = start_;
    if (begin != stop) {
      const char* const comment = start_of_comment(begin, stop);
      if (comment != stop) {
        stop = comment;
        // A tab before a comment belongs to the comment, even if tabs separate cells.
        while (begin != stop && (stop[-1] == ' ' || stop[-1] == '\t')) --stop;
      } else if (stop[-1] == '\r') {
        --stop;
      }
    }
    const auto is_blank = [tab = tab_](char c) { return c == ' ' || c == tab; };
    while (begin != stop && is_blank(*begin)) ++begin;
    while (begin != stop && is_blank(stop[-1])) --stop;
    if (begin == stop) continue;
    line_ = std::string_view(begin, static_cast<std::size_t>(stop - begin));
    return true;
  }
  line_ = {};
  return false;
}

void TextLines::fail(const char* place, const Fault& fault) const {
  input_.fail_at(number_, column(place), fault);
}

void Cells::start_in(std::string_view part) {
  position_ = part.data();
  end_ = position_ + part.size();
  while (position_ != end_ && is_blank(*position_)) ++position_;
  while (position_ != end_ && is_blank(end_[-1])) --end_;
}

template <class T>
T Cells::floating(Allow allow) {
  const char* begin = position_;
  const char* digits = begin;
  const bool in_quotes = begin != end_ && *begin == '"';
  if (in_quotes) ++digits;
  // The function from_chars accepts no plus sign.
  if (digits != end_ && *digits == '+' && end_ - digits > 1 && digits[1] != '-') ++digits;
  T value = 0;
  const auto [last, error] = floating_from_chars(digits, end_, value);
  const char* stop = last;
  if (in_quotes && stop != end_ && *stop == '"') ++stop;
  if (allow >= Allow::any && error == std::errc::invalid_argument) {
    const char* const end = end_of_cell(begin);
    const bool is_missing = allow == Allow::missing && is_empty_cell(begin, stop);
    if (is_missing || detail::is_missing_value({begin, static_cast<std::size_t>(end - begin)})) {
      after_cell(is_missing ? stop : end);
      return std::numeric_limits<T>::quiet_NaN();
    }
  }
  if (error == std::errc::invalid_argument || (stop != end_ && !ends_cell(*stop)) ||
      (in_quotes && stop == last)) {
    reject(begin, stop, "not a number", "a decimal number", hints_.word);
  }
  if (error == std::errc::result_out_of_range) {
    if (!rounds_to_zero({digits, last})) {
      reject(begin, stop, "number out of range",
             fmt::format("at most {:.2g} in absolute value", std::numeric_limits<T>::max()));
    }
    value = 0;
  }
  if (!std::isfinite(value)) {
    if (std::isnan(value) && (allow < Allow::any || last[-1] == ')')) {
      reject(begin, stop, "not a number", "a decimal number", hints_.missing);
    }
    if (std::isinf(value) && allow == Allow::finite) {
      reject(begin, stop, "infinite number", "a finite one");
    }
  }
  after_cell(stop);
  return value + T{0};  // the sum turns -0.0 into +0.0
}

template float Cells::floating<float>(Allow);
template double Cells::floating<double>(Allow);

double Cells::number(Allow allow) { return floating<double>(allow); }

template <class T>
T Cells::whole(T least, T most, const char* what) {
  const char* begin = position_;
  T value = 0;
  const auto [stop, error] = std::from_chars(begin, end_, value);
  const bool negative = begin != end_ && *begin == '-';
  if ((error == std::errc::invalid_argument && !negative) || (stop != end_ && !ends_cell(*stop))) {
    reject(begin, stop, fmt::format("{} is not an integer", what), "a decimal integer");
  }
  if (error != std::errc{} || value < least || value > most) {
    reject(begin, stop, fmt::format("{} out of range", what), fmt::format("{} to {}", least, most));
  }
  after_cell(stop);
  return value;
}

std::int64_t Cells::integer(std::int64_t least, std::int64_t most, const char* what) {
  return whole<std::int64_t>(least, most, what);
}

std::uint64_t Cells::unsigned64(const char* what) {
  return whole<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max(), what);
}

std::string_view Cells::word() {
  const char* begin = position_;
  const char* stop = end_of_cell(begin);
  if (stop == begin) reject(begin, stop, "empty cell", "a value");
  after_cell(stop);
  return {begin, static_cast<std::size_t>(stop - begin)};
}

std::string_view Cells::skip() {
  const char* begin = position_;
  const char* stop = end_of_cell(begin);
  if (skipped_to_ != ' ') {
    stop = std::find(stop, end_, skipped_to_);
    while (stop != begin && is_blank(stop[-1])) --stop;
  }
  after_cell(stop);
  return {begin, static_cast<std::size_t>(stop - begin)};
}

const char* Cells::end_of_cell(const char* begin) const {
  const char* stop = begin;
  if (stop != end_ && *stop == '"') stop = end_of_quotes(begin, end_);
  while (stop != end_ && !ends_cell(*stop)) ++stop;
  return stop;
}

bool Cells::is_empty_cell(const char* begin, const char* stop) const {
  if (stop - begin == 2) return *begin == '"' && begin[1] == '"';
  return stop == begin && stop != end_ && ends_cell(*stop);
}

void Cells::expect_end(std::string_view expected) {
  if (!more()) return;
  const char* place = position_;
  lines_->fail(place, {"extra cell", quoted(word()), std::string(expected), {}});
}

void Cells::after_cell(const char* end_of_cell) {
  const char* p = end_of_cell;
  while (p != end_ && is_blank(*p)) ++p;
  if (p == end_) {
    position_ = p;
    return;
  }
  const char found = ends_cell(*p) ? *p : ' ';
  if (separator_ == 0) {
    separator_ = found;
  } else if (found != separator_) {
    const char* end_of_both = p;
    if (found != ' ') ++end_of_both;
    while (end_of_both != end_ && !ends_cell(*end_of_both)) ++end_of_both;
    const auto name = [](char c) {
      return c == ' ' ? std::string("a blank") : c == '\t' ? "a tab" : fmt::format("'{}'", c);
    };
    lines_->fail(
        position_,
        {"mixed separators",
         fmt::format("{} in {}", name(found),
                     quoted({position_, static_cast<std::size_t>(end_of_both - position_)})),
         fmt::format("{}, as between the preceding cells", name(separator_)),
         found == ',' || separator_ == ',' ? "write a decimal point if the comma was one" : ""});
  }
  if (found != ' ') {
    ++p;
    while (p != end_ && is_blank(*p)) ++p;
  }
  position_ = p;
}

void Cells::reject(const char* begin, const char* stop, std::string what, std::string expected,
                   const Message& hint) const {
  while (stop != end_ && !ends_cell(*stop)) ++stop;
  const std::string_view cell(begin, static_cast<std::size_t>(stop - begin));
  if (cell.empty()) {
    std::string advice = hints_.missing.marked();
    if (stop != end_ && *stop == '\t')
      advice.insert(
          0, advice.empty() ? "write one tab between cells" : "write one tab between cells; ");
    lines_->fail(begin, {"empty cell", stop == end_ ? "the end of the line" : quoted({stop, 1}),
                         std::move(expected), std::move(advice)});
  }
  const std::string why = hint_for(cell);
  lines_->fail(begin, {std::move(what), quoted(cell), std::move(expected),
                       !why.empty()                                       ? Message(why)
                       : cell == "\"\"" || detail::is_missing_value(cell) ? hints_.missing
                                                                          : hint});
}

}  // namespace ph
