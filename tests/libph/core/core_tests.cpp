// SPDX-License-Identifier: MIT
// Fields, sorting, barcodes.
#include <array>
#include <climits>
#include <tuple>
#include <type_traits>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/persistence.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/known_spaces.hpp"

namespace ph::test {
namespace {

// ---- fields

template <Field K>
void expect_field_axioms(const K& k, const std::vector<typename K::Element>& elements) {
  const auto zero = k.from_int(0), one = k.from_int(1);
  EXPECT_TRUE(k.is_zero(zero));
  EXPECT_FALSE(k.is_zero(one));
  for (const auto a : elements) {
    EXPECT_EQ(k.add(a, zero), a);
    EXPECT_EQ(k.multiply(a, one), a);
    EXPECT_TRUE(k.is_zero(k.multiply(a, zero)));
    EXPECT_TRUE(k.is_zero(k.add(a, k.negate(a))));
    EXPECT_EQ(k.negate(a), k.multiply(a, k.from_int(-1)));
    if (!k.is_zero(a)) {
      EXPECT_EQ(k.multiply(a, k.inverse(a)), one) << +a;
    }
    for (const auto b : elements) {
      EXPECT_EQ(k.add(a, b), k.add(b, a));
      EXPECT_EQ(k.multiply(a, b), k.multiply(b, a));
      EXPECT_EQ(k.is_zero(k.multiply(a, b)), k.is_zero(a) || k.is_zero(b));
      for (const auto c : elements) {
        EXPECT_EQ(k.add(k.add(a, b), c), k.add(a, k.add(b, c)));
        EXPECT_EQ(k.multiply(k.multiply(a, b), c), k.multiply(a, k.multiply(b, c)));
        EXPECT_EQ(k.multiply(a, k.add(b, c)), k.add(k.multiply(a, b), k.multiply(a, c)));
      }
    }
  }
}

TEST(Fields, AxiomsHold) {
  expect_field_axioms(Z2{}, {false, true});
  for (const std::int64_t p : {2, 3, 5, 7, 11, 13, 101, 65521, 65537, 2147483629, 2147483647}) {
    SCOPED_TRACE(p);
    const Zp k(p);
    EXPECT_EQ(k.characteristic(), p);
    std::vector<Zp::Element> elements;
    for (const std::int64_t a :
         {std::int64_t{0}, std::int64_t{1}, std::int64_t{2}, p / 2, p / 2 + 1, p / 3, p - 2, p - 1})
      elements.push_back(static_cast<Zp::Element>(a % p));
    expect_field_axioms(k, elements);
  }
}

TEST(Fields, EveryElementOfASmallFieldHasItsInverse) {
  for (const std::int64_t p : {2, 3, 5, 7, 251}) {
    const Zp k(p);
    for (Zp::Element a = 1; a < p; ++a) {
      EXPECT_LT(k.inverse(a), p);
      EXPECT_EQ(k.multiply(a, k.inverse(a)), 1U) << a << " mod " << p;
    }
  }
}

TEST(Fields, IntegersMapToResidues) {
  for (const std::int64_t p : {2, 3, 5, 7, 2147483647}) {
    const Zp k(p);
    for (const int value : {0, 1, -1, 2, -2, 7, -7, INT_MAX, INT_MIN, INT_MIN + 1}) {
      const auto residue = static_cast<std::int64_t>(k.from_int(value));
      EXPECT_GE(residue, 0);
      EXPECT_LT(residue, p);
      EXPECT_EQ((std::int64_t{value} - residue) % p, 0) << value << " mod " << p;
    }
  }
  for (const int value : {-3, -2, -1, 0, 1, 2, 3, INT_MIN, INT_MAX})
    EXPECT_EQ(Z2::from_int(value), value % 2 != 0);
}

TEST(Fields, OnlyPrimesBelowTwoToThe31) {
  for (const std::int64_t p :
       {std::int64_t{-7}, std::int64_t{-2}, std::int64_t{0}, std::int64_t{1}, std::int64_t{4},
        std::int64_t{9}, std::int64_t{25}, std::int64_t{561}, std::int64_t{46337} * 46337,
        std::int64_t{2147483648}, std::int64_t{2147483659}, std::int64_t{4294967311}, INT64_MAX,
        INT64_MIN}) {
    EXPECT_FALSE(is_field_characteristic(p)) << p;
    expect_error(ErrorKind::usage, std::to_string(p), [p] { Zp k(p); });
  }
}

// ---- sorting

TEST(RadixSort, IsAStableSort) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Generator random(seed);
    struct Item {
      double value;
      int place;
      bool operator==(const Item&) const = default;
    };
    std::pmr::vector<Item> items(
        static_cast<std::size_t>(random.integer(0, 1) * 1000 + random.integer(0, 3000)));
    const int kind = random.integer(0, 4);
    for (std::size_t i = 0; i < items.size(); ++i) {
      double v = random.real() - 0.5;
      if (kind == 0) v = random.integer(-3, 3);
      if (kind == 1) v = std::ldexp(v, random.integer(-1074, 1023));
      if (kind == 2) v = 1;
      if (kind == 3) v = static_cast<float>(v);
      if (random.integer(0, 99) == 0) v = random.coin() ? kInfinity : -kInfinity;
      items[i] = {v + 0.0, static_cast<int>(i)};
    }
    auto expected = items;
    std::stable_sort(expected.begin(), expected.end(),
                     [](const Item& a, const Item& b) { return a.value < b.value; });
    radix_sort_by_value(items, [](const Item& item) { return item.value; });
    EXPECT_EQ(items, expected) << "seed " << seed;
  }
}

// ---- barcodes

TEST(Barcodes, AreOrderedByDimensionBirthDeathAndBirthCell) {
  Barcode barcode;
  const auto add = [&](Bar bar, Index birth_cell) {
    const std::array birth{birth_cell}, death{birth_cell + 100};
    const std::span<const Index> killer(death);
    barcode.add(bar, birth, bar.is_infinite() ? killer.first(0) : killer);
  };
  add({1, 0, 2}, 1);
  add({0, 0, kInfinity}, 2);
  add({0, 0, 3}, 9);
  add({0, 0, 3}, 4);
  add({0, -kInfinity, 1}, 5);
  add({0, -1, 7}, 6);
  barcode.sort();
  EXPECT_EQ(
      bars_of(barcode),
      (std::vector<Bar>{
          {0, -kInfinity, 1}, {0, -1, 7}, {0, 0, 3}, {0, 0, 3}, {0, 0, kInfinity}, {1, 0, 2}}));
  const std::vector<Index> expected{5, 6, 4, 9, 2, 1};
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    EXPECT_EQ(barcode.birth_cell(i).numbers[0], expected[i]) << "cells move with their bars";
    ASSERT_EQ(barcode.death_cell(i).has_value(), !barcode[i].is_infinite());
    if (const auto death = barcode.death_cell(i)) {
      EXPECT_EQ(death->numbers[0], expected[i] + 100);
    }
  }
  EXPECT_EQ(barcode.bars(0).size(), 5U);
  EXPECT_EQ(barcode.bars(1).size(), 1U);
  EXPECT_TRUE(barcode.bars(-1).empty());
  EXPECT_TRUE(barcode.bars(2).empty());
}

// Adds bars in random order or in descending order. Few and many bars with the same birth are
// sorted by different methods.
TEST(Barcodes, WithoutCellsAreOrderedByValues) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Generator random(seed);
    const int values = random.coin() ? 3 : 1000;
    std::vector<Bar> bars;
    for (int k = random.integer(0, 5000); k-- > 0;) {
      const double birth = random.integer(-values, values) / 8.0;
      bars.push_back({random.integer(0, 2), random.integer(0, 99) == 0 ? -kInfinity : birth,
                      random.coin() ? kInfinity : birth + random.integer(0, values)});
    }
    const auto key = [](const Bar& x) { return std::tie(x.dim, x.birth, x.death); };
    std::vector<Bar> expected = bars;
    std::ranges::sort(expected, {}, key);
    if (random.coin()) bars.assign(expected.rbegin(), expected.rend());
    Barcode barcode;
    for (const Bar& bar : bars) barcode.add(bar);
    barcode.sort();
    EXPECT_EQ(bars_of(barcode), expected) << "seed " << seed;
  }
}

TEST(Barcodes, EqualBarsAreSortedByTheirCellsWhereValuesAreSortedAlready) {
  Barcode barcode;
  for (const Index vertex : {Index{3}, Index{8}, Index{5}, Index{1}}) {
    const std::vector<Index> birth{vertex}, death{vertex, vertex + 1};
    barcode.add({0, 0, vertex == 3 ? 1.0 : 2.0}, birth, death);
  }
  barcode.sort();
  const std::vector<Index> expected{3, 1, 5, 8};
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    EXPECT_EQ(barcode.birth_cell(i).numbers[0], expected[i]);
    EXPECT_EQ(barcode.death_cell(i)->numbers[1], expected[i] + 1);
  }
}

TEST(Barcodes, BarsOfATemporaryAreKept) {
  const auto three_bars = [] {
    Barcode barcode;
    barcode.add({0, 0, 3}, {}, {});
    barcode.add({1, 0, 1}, {}, {});
    barcode.add({1, 2, 4}, {}, {});
    barcode.sort();
    return barcode;
  };
  static_assert(std::is_same_v<decltype(three_bars().bars(1)), std::vector<Bar>>);
  std::vector<double> deaths;
  for (const Bar& bar : three_bars().bars(1)) deaths.push_back(bar.death);
  EXPECT_EQ(deaths, (std::vector<double>{1, 4}));
}

TEST(Barcodes, TheLongestBarIsTheFirstOfTheLongest) {
  Barcode barcode;
  barcode.add({0, 0, 3}, {}, {});
  barcode.add({0, 1, 4}, {}, {});
  barcode.add({0, 5, kInfinity}, {}, {});
  barcode.add({1, 0, 1}, {}, {});
  barcode.add({1, 2, 4}, {}, {});
  barcode.add({1, 3, 5}, {}, {});
  barcode.sort();
  EXPECT_EQ(barcode.longest(0), 2U);
  EXPECT_EQ(barcode.longest(1), 4U);
  expect_error(ErrorKind::usage, "dimension 2", [&] { barcode.longest(2); });
  expect_error(ErrorKind::usage, "dimension 0", [] { Barcode().longest(0); });
}

TEST(Barcodes, AnInfiniteBarIsLongerThanOneFromMinusInfinity) {
  Barcode barcode;
  barcode.add({0, -kInfinity, 1}, {}, {});
  barcode.add({0, 5, kInfinity}, {}, {});
  barcode.sort();
  EXPECT_EQ(barcode.longest(0), 1U) << "infinite ones first";
}

TEST(Barcodes, PersistenceOfInfiniteValues) {
  EXPECT_EQ((Bar{0, 1, kInfinity}.persistence()), kInfinity);
  EXPECT_EQ((Bar{0, -kInfinity, 1}.persistence()), kInfinity);
  EXPECT_EQ((Bar{0, -kInfinity, -kInfinity}.persistence()), 0);
  EXPECT_EQ((Bar{0, -kInfinity, kInfinity}.persistence()), kInfinity);
}

TEST(Barcodes, FirstDifferenceIsInWords) {
  Barcode a, b;
  a.add({0, 0, 1}, {}, {});
  b.add({0, 0, 1}, {}, {});
  EXPECT_EQ(first_difference(a, b), "");
  EXPECT_EQ(first_difference(Barcode(), Barcode()), "");
  b.add({1, 2, 3}, {}, {});
  EXPECT_NE(first_difference(a, b).find("H1 [2, 3) is in the second"), std::string::npos);
  EXPECT_NE(first_difference(b, a).find("H1 [2, 3) is in the first"), std::string::npos);
  a.add({1, 2, 2.5}, {}, {});
  EXPECT_NE(first_difference(a, b).find("H1 [2, 2.5) is in the first"), std::string::npos);
}
}  // namespace
}  // namespace ph::test
