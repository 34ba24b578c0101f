// SPDX-License-Identifier: MIT
#include "apps/barcode/parts/inputs_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>

#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/detail/core/sealed_part.hpp"
#include "ph/error.hpp"

namespace ph::barcode {
namespace {

void put_texts(ByteWriter& to, const std::vector<std::string>& texts) {
  to.put_list(texts, [&](const std::string& text) { to.put(std::string_view(text)); });
}
std::vector<std::string> get_texts(ByteReader& from, std::string_view what) {
  std::vector<std::string> texts(from.count(sizeof(std::uint64_t), what));
  for (std::string& text : texts) text = from.text(what);
  return texts;
}

}  // namespace

void InputsPart::join(InputsPart other) {
  if (other.whole_ != whole_)
    throw Error(ErrorKind::bad_data,
                "parts of inputs: found parts that differ in inputs, options or number of parts, "
                "expected parts of one batch");
  for (const int number : other.numbers_)
    if (std::ranges::binary_search(numbers_, number))  // mutant: part-twice
      throw Error(ErrorKind::bad_data, fmt::format("parts of inputs: found part {} of {} twice",
                                                   number + 1, whole_.parts));
  std::vector<int> numbers;
  std::ranges::merge(numbers_, other.numbers_, std::back_inserter(numbers));
  numbers_ = std::move(numbers);
  std::ranges::move(other.results_, std::back_inserter(results_));
  std::ranges::sort(results_, {}, &Result::input);
}

std::vector<std::byte> InputsPart::bytes() const {
  ByteWriter to;
  put_texts(to, whole_.inputs);
  put_texts(to, whole_.options);
  to.put(std::int32_t{whole_.parts});
  to.put_list(numbers_, [&](int number) { to.put(std::int32_t{number}); });
  to.put_list(results_, [&](const Result& result) {
    to.put(std::uint64_t{result.input});
    to.put(result.fingerprint);
    to.put(std::int32_t{result.code});
    to.put(std::string_view(result.failure));
    to.put_list(result.bars, [&](const Bar& bar) {
      to.put(std::int32_t{bar.dim});
      to.put(bar.birth);
      to.put(bar.death);
    });
  });
  return sealed_part(kInputsKind, to.take());
}

InputsPart InputsPart::of_bytes(std::span<const std::byte> bytes) {
  ByteReader from(content_of_part(bytes, kInputsKind), "part of inputs");
  InputsPart part({}, 0);
  Whole& whole = part.whole_;
  whole.inputs = get_texts(from, "input");
  whole.options = get_texts(from, "option");
  whole.parts = from.get<std::int32_t>("number of parts");
  part.numbers_.resize(from.count(sizeof(std::int32_t), "numbers"));
  for (int& number : part.numbers_) number = from.get<std::int32_t>("number");
  if (whole.parts < 1 || part.numbers_.empty() || part.numbers_.front() < 0 ||
      part.numbers_.back() >= whole.parts ||
      std::ranges::adjacent_find(part.numbers_, std::ranges::greater_equal()) !=
          part.numbers_.end())
    from.refuse("number");
  constexpr std::size_t bytes_of_result = 36, bytes_of_bar = 20;
  part.results_.resize(from.count(bytes_of_result, "results"));
  for (Result& result : part.results_) {
    result.input = static_cast<std::size_t>(from.get<std::uint64_t>("input"));
    result.fingerprint = from.get<std::uint64_t>("fingerprint");
    result.code = from.get<std::int32_t>("code");
    result.failure = from.text("failure");
    for (std::size_t left = from.count(bytes_of_bar, "bars"); left > 0; --left) {
      Bar bar;
      bar.dim = from.get<std::int32_t>("bar");
      bar.birth = from.get<double>("bar");
      bar.death = from.get<double>("bar");
      if (bar.dim < 0 || !(bar.birth <= bar.death)) from.refuse("bar");
      result.bars.add(bar);
    }
    constexpr int most_code = 255;  // the largest exit code that the system passes on
    const bool failed = result.code != 0;
    if (result.code < 0 || result.code > most_code || failed == result.failure.empty() ||
        (failed && result.bars.size() > 0))
      from.refuse("code");
  }
  from.expect_end();
  // The part must contain exactly one result for each input of its parts, and no result for any
  // other input.
  auto next = part.results_.begin();
  for (std::size_t i = 0; i < whole.inputs.size(); ++i)
    if (std::ranges::binary_search(part.numbers_, part_of(i, whole.parts)) &&
        (next == part.results_.end() || next++->input != i))
      from.refuse("list of results");
  if (next != part.results_.end()) from.refuse("list of results");
  return part;
}

}  // namespace ph::barcode
