// SPDX-License-Identifier: MIT
#include "ph/detail/facade/bar_bytes.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace ph {

void put_bars(ByteWriter& to, const Barcode& bars) {
  to.put(std::uint64_t{bars.size()});
  for (std::size_t i = 0; i < bars.size(); ++i) {
    to.put(std::int32_t{bars[i].dim});
    to.put(bars[i].birth);
    to.put(bars[i].death);
    const auto death = bars.death_cell(i);
    const auto put_numbers = [&](std::span<const Index> numbers) {
      to.put(static_cast<std::uint8_t>(numbers.size()));
      for (const Index n : numbers) to.put(std::int64_t{n});
    };
    put_numbers(bars.birth_cell(i).numbers);
    put_numbers(death ? death->numbers : std::span<const Index>());
  }
}

void get_bars(ByteReader& from, Barcode& bars) {
  constexpr std::size_t bytes_of_bar = 22;
  const std::size_t count = from.count(bytes_of_bar, "bars");
  std::vector<Index> birth, death;
  const auto get_numbers = [&](std::vector<Index>& numbers) {
    numbers.resize(from.get<std::uint8_t>("bar"));
    for (Index& n : numbers) n = static_cast<Index>(from.get<std::int64_t>("bar"));
  };
  for (std::size_t i = 0; i < count; ++i) {
    Bar bar;
    bar.dim = from.get<std::int32_t>("bar");
    bar.birth = from.get<double>("bar");
    bar.death = from.get<double>("bar");
    if (bar.dim < 0 || !(bar.birth <= bar.death)) from.refuse("bar");
    get_numbers(birth);
    get_numbers(death);
    bars.add(bar, birth, death);
  }
}

void add_bars(Barcode& to, const Barcode& bars) {
  to.reserve_more(bars.size());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const auto death = bars.death_cell(i);
    to.add(bars[i], bars.birth_cell(i).numbers, death ? death->numbers : std::span<const Index>());
  }
}

}  // namespace ph
