// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/libph/io/barcodes/barcode_support.hpp"

namespace ph::test {
namespace {

std::vector<Index> numbers(const InputCell& cell) {
  return {cell.numbers.begin(), cell.numbers.end()};
}

TEST(ReadBarcode, JsonBringsCellsAndRepresentativesBack) {
  for (const CellKind kind : {CellKind::vertices, CellKind::grid}) {
    const Barcode barcode = example(kind);
    const Barcode read = back(text_of(barcode, BarcodeFormat::json));
    EXPECT_EQ(read.cell_kind(), kind);
    for (std::size_t i = 0; i < barcode.size(); ++i) {
      EXPECT_EQ(numbers(read.birth_cell(i)), numbers(barcode.birth_cell(i)));
      ASSERT_EQ(read.death_cell(i).has_value(), barcode.death_cell(i).has_value());
      if (const auto death = barcode.death_cell(i)) {
        EXPECT_EQ(numbers(*read.death_cell(i)), numbers(*death));
      }
    }
  }
  Barcode rows(CellKind::row);
  rows.add({0, 1, 2}, std::array<Index, 1>{0}, std::array<Index, 1>{7});
  rows.set_representative(Representatives::cycles, std::array<Index, 2>{0, 3},
                          std::array<std::int64_t, 2>{1, -1});
  const Barcode read = back(text_of(rows, BarcodeFormat::json));
  EXPECT_EQ(numbers(*read.death_cell(0)), std::vector<Index>{7});
  EXPECT_EQ(read.representatives(), Representatives::cycles);
  ASSERT_EQ(read.representative(0).size(), 2U);
  EXPECT_EQ(numbers(read.representative(0).cell(1)), std::vector<Index>{3});
  EXPECT_EQ(read.representative(0).coefficient(1), -1);
}

TEST(ReadBarcode, JsonTellsOfVoxelsByRuns) {
  Barcode barcode(CellKind::grid);
  const std::array<std::uint32_t, 5> places{7, 3, 2, 4, 9};
  const std::size_t begin = barcode.store_voxels(places);
  const std::array<Index, 2> birth{0, 4}, death{1, 4};
  barcode.add({0, 1, 2}, birth, death);
  barcode.set_representative(Representatives::voxels, {}, {});
  barcode.set_voxels({begin, begin + 5}, std::array<Index, 2>{0, 2}, std::array<Index, 2>{1, 2});
  barcode.add({1, 1, kInfinity}, death, {});
  barcode.set_representative(Representatives::voxels, death, std::array<std::int64_t, 1>{1});
  barcode.set_voxels({}, std::array<Index, 2>{1, 2}, {});
  const std::string text = text_of(barcode, BarcodeFormat::json);
  EXPECT_TRUE(contains(text, R"("representatives": "voxels")"));
  EXPECT_TRUE(contains(text, R"("birth_voxel": [0, 2], "death_voxel": [1, 2], )"
                             R"("voxels": [[2, 3], [7, 1], [9, 1]]})"));
  EXPECT_TRUE(
      contains(text, R"("birth_voxel": [1, 2], "death_voxel": null, "representative": [{)"));
  const Barcode read = back(text);
  EXPECT_EQ(read.representatives(), Representatives::voxels);
  EXPECT_EQ(numbers(read.birth_cell(0)), (std::vector<Index>{0, 4}));
  EXPECT_TRUE(std::ranges::equal(read.voxels(0), std::array{2, 3, 4, 7, 9}));
  EXPECT_TRUE(std::ranges::equal(read.birth_voxel(0), std::array{0, 2}));
  EXPECT_TRUE(std::ranges::equal(read.death_voxel(0), std::array{1, 2}));
  EXPECT_TRUE(read.voxels(1).empty());
  EXPECT_TRUE(std::ranges::equal(read.birth_voxel(1), std::array{1, 2}));
  EXPECT_TRUE(read.death_voxel(1).empty());
  EXPECT_EQ(read.representative(1).size(), 1U);
  EXPECT_EQ(text_of(read, BarcodeFormat::json), text);
}

TEST(ReadBarcode, JsonBringsSetsWithoutCellsBack) {
  Barcode barcode(CellKind::grid);  // the first bar has neither cells nor a chain
  const std::size_t begin = barcode.store_voxels(std::array<std::uint32_t, 1>{5});
  barcode.add({0, 1, 2});
  barcode.set_representative(Representatives::voxels, {}, {});
  barcode.set_voxels({begin, begin + 1}, std::array<Index, 1>{5}, std::array<Index, 1>{6});
  barcode.add({1, 1, 2});
  barcode.set_representative(Representatives::voxels, std::array<Index, 1>{11},
                             std::array<std::int64_t, 1>{1});
  barcode.set_voxels({}, std::array<Index, 1>{5}, std::array<Index, 1>{6});
  const std::string text = text_of(barcode, BarcodeFormat::json);
  EXPECT_EQ(text_of(back(text), BarcodeFormat::json), text);
}

TEST(ReadBarcode, VoxelsStayInTheMemoryLimit) {
  // Few numbers stand for 2^32 - 1 voxels.
  const std::string text = R"({"format": "ph-barcode", "representatives": "voxels", "bars": [
 {"dim": 0, "birth": 1, "death": 2, "voxels": [[0, 4294967295]]}]})";
  RunContext context;
  context.memory.set_limit(std::size_t{1} << 20);
  const Input input = Input::hold({text.begin(), text.end(), &context.memory}, "v.json", &context);
  try {
    read_barcode(input);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::resource);
  }
}

// The bars are not in order: loops and p-values move with their bars.
TEST(ReadBarcode, JsonBringsLoopsAndPValuesBack) {
  const StoredBarcode read = read_stored_barcode(Input::view(R"({"format": "ph-barcode",
 "representatives": "cycles", "bars": [
 {"dim": 1, "birth": 3, "death": 4, "birth_cell": {"vertices": [1, 2]}, "p": 0.25,
  "representative": [{"vertices": [1, 2], "coefficient": 1}, {"vertices": [0, 1], "coefficient": 2}],
  "loops": [{"vertices": [0, 1, 2], "coefficient": 2, "length": 2.5, "tight": "shortest"},
            {"vertices": [4, 5, 6], "coefficient": -1, "tight": "shortest"}]},
 {"dim": 1, "birth": 1, "death": 4, "birth_cell": {"vertices": [0, 2]},
  "representative": [{"vertices": [0, 2], "coefficient": 1}]}]})",
                                                             "l.json"));
  ASSERT_EQ(read.bars.size(), 2U);
  EXPECT_EQ(read.bars[0].birth, 1);
  ASSERT_EQ(read.loops.size(), 2U);
  EXPECT_TRUE(read.loops[0].loops.empty());
  EXPECT_EQ(read.loops[1].tightness, Tightness::shortest);
  EXPECT_EQ(read.loops[1].loops,
            (std::vector<Loop>{{{0, 1, 2}, 2, 2.5}, {{4, 5, 6}, -1, std::nullopt}}));
  ASSERT_EQ(read.p_values.size(), 2U);
  EXPECT_TRUE(std::isnan(read.p_values[0]));
  EXPECT_EQ(read.p_values[1], 0.25);
  EXPECT_TRUE(read.left_out.empty());
}

TEST(ReadBarcode, JsonSkipsWhatItDoesNotKnow) {
  const Barcode read = back(
      R"({"format": "ph-barcode", "x": {"a": [1, true, null, "\u00e9\ud83d\ude00\n"]}, "version": 1,
 "bars": [{"death": null, "y": [], "birth": 1e0, "dim": 2}]})");
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0], (Bar{2, 1, kInfinity}));
}

TEST(ReadBarcode, JsonSaysWhereItCameFrom) {
  const auto stored = [](const std::string& text) {
    return read_stored_barcode(Input::view(text, "b.json"));
  };
  const StoredBarcode read = stored(R"({"format": "ph-barcode", "version": 1, "program": "p 1",
 "input": {"path": "a", "description": "d", "points": 9, "coordinates": 3, "shape": [4, 5]},
 "vertices": 4, "edges": 6, "collapsed": true, "complex": "rips", "field": 3, "max_dim": 2,
 "threshold": 1.5, "vertex_weights": "dtm 2", "metric": "cosine", "construction": "cells",
 "periodic": [0, 2], "min_persistence": 0.125, "min_dim": 1,
 "subsample": {"points": 4, "of": 9, "covering_radius": 0.5},
 "voxels": {"edge": 2, "first": [0, -1], "value": "density", "x": 1}, "approximation": 0.25,
 "alpha": {"squared": true, "period": [2, 0], "hidden": [3, 5], "x": []}, "superlevel": true,
 "engine": "twist", "shape": "round", "timings": {"read": 0.5, "plan": 1}, "peak_memory": 77,
 "bars": [{"dim": 1, "birth": 0, "death": 1, "loops": []}]})");
  const BarcodeInfo& info = read.bars.info();
  EXPECT_EQ(info.program, "p 1");
  EXPECT_EQ(info.input, "a");
  EXPECT_EQ(info.input_description, "d");
  EXPECT_EQ(info.points, 9);
  EXPECT_EQ(info.coordinates, 3);
  EXPECT_EQ(info.shape, (std::vector<Index>{4, 5}));
  EXPECT_EQ(info.vertices, 4);
  EXPECT_EQ(info.edges, 6U);
  EXPECT_TRUE(info.collapsed);
  EXPECT_EQ(info.complex, "rips");
  EXPECT_EQ(info.field, 3);
  EXPECT_EQ(info.max_dim, 2);
  EXPECT_EQ(info.threshold, 1.5);
  EXPECT_EQ(info.vertex_weights, "dtm 2");
  EXPECT_EQ(info.metric, "cosine");
  EXPECT_EQ(info.construction, "cells");
  EXPECT_EQ(info.periodic, (std::vector<int>{0, 2}));
  EXPECT_EQ(info.min_persistence, 0.125);
  EXPECT_EQ(info.min_dim, 1);
  ASSERT_TRUE(info.subsample && info.voxels);
  EXPECT_EQ(info.subsample->points, 4);
  EXPECT_EQ(info.subsample->of, 9);
  EXPECT_EQ(info.subsample->covering_radius, 0.5);
  EXPECT_EQ(info.voxels->voxel, 2);
  EXPECT_EQ(info.voxels->first, (std::vector<double>{0, -1}));
  EXPECT_EQ(info.voxels->value, "density");
  ASSERT_TRUE(info.alpha);
  EXPECT_TRUE(info.alpha->squared);
  EXPECT_EQ(info.alpha->period, (std::vector<double>{2, 0}));
  EXPECT_EQ(info.alpha->hidden, (std::vector<Index>{3, 5}));
  EXPECT_TRUE(info.superlevel);
  EXPECT_EQ(info.approximation, 0.25);
  EXPECT_EQ(info.engine, "twist");
  EXPECT_EQ(info.timings,
            (std::vector<std::pair<std::string, double>>{{"read", 0.5}, {"plan", 1}}));
  EXPECT_EQ(info.peak_memory, 77U);
  EXPECT_EQ(read.left_out, (std::vector<std::string>{"shape"}));
  EXPECT_TRUE(contains(
      bad_data([&] { stored(R"({"format": "ph-barcode", "superlevel": 1, "bars": []})"); }),
      "expected true or false"));
  EXPECT_TRUE(stored(R"({"format": "ph-barcode", "superlevel": false, "bars": []})").bars.empty());
  // If a file does not state a fact, the fact is unknown and is not written.
  const StoredBarcode bare = stored(R"({"format": "ph-barcode", "bars": [], "threshold": null})");
  EXPECT_EQ(bare.bars.info().complex, "");
  EXPECT_EQ(bare.bars.info().threshold, std::nullopt);
  const std::string text = text_of(bare.bars, BarcodeFormat::json);
  for (const char* member : {"complex", "field", "max_dim", "threshold", "engine"})
    EXPECT_FALSE(contains(text, std::string("\"") + member)) << member;
  const auto lowest = stored(R"({"format": "ph-barcode", "bars": [], "threshold": "-inf"})");
  EXPECT_EQ(lowest.bars.info().threshold, -kInfinity);
}

TEST(ReadBarcode, JsonRefusesDamage) {
  const std::string whole = text_of(example(), BarcodeFormat::json);
  check_prefixes(
      whole, "b.json", [](const Input& in) { read_barcode(in); },
      [&](std::size_t length) { return length + 1 == whole.size(); });
  const auto bar = [](const std::string& text) {
    return R"({"format": "ph-barcode", "bars": [)" + text + "]}";
  };
  const auto chain = [](const std::string& text) {
    return R"({"format": "ph-barcode", "representatives": "cycles", "bars": [
        {"dim": 1, "birth": 1, "death": 2, "birth_cell": {"vertices": [1, 2]},
         "representative": [{"vertices": [1, 2], "coefficient": 1}], )" +
           text + "}]}";
  };
  const auto set = [](const std::string& text) {
    return R"({"format": "ph-barcode", "input": {"shape": [2, 5]}, "representatives": "voxels",
        "bars": [{"dim": 0, "birth": 1, "death": 2, )" +
           text + "}]}";
  };
  for (const std::string& text : std::vector<std::string>{
           "{}",
           "{\"bars\": []}",
           R"({"format": "other", "bars": []})",
           R"({"format": "ph-barcode", "version": 2, "bars": []})",
           R"({"format": "ph-barcode", "bars": [], "bars": []})",
           bar("{}"),
           bar("1"),
           bar("{,}"),
           bar(R"({"dim": 0, "birth": 1})"),
           bar(R"({"dim": -1, "birth": 1, "death": 2})"),
           bar(R"({"dim": 0.5, "birth": 1, "death": 2})"),
           bar(R"({"dim": 99999999999, "birth": 1, "death": 2})"),
           bar(R"({"dim": 0, "birth": 3, "death": 2})"),
           bar(R"({"dim": 0, "birth": null, "death": 2})"),
           bar(R"({"dim": 0, "birth": NaN, "death": 2})"),
           bar(R"({"dim": 0, "birth": "nan", "death": 2})"),
           bar(R"({"dim": 0, "birth": 1e999, "death": 2})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2, "birth_cell": {"vertices": [-1]}})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2, "birth_cell": {"corners": [1]}})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2, "birth_cell": {"row": 1},
                   "death_cell": {"vertices": [1]}})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2, "birth_cell": {"vertices": []}})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2, "death_cell": {"row": 1}})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2, "birth_cell": {"row": 1}},
                  {"dim": 0, "birth": 1, "death": 2})"),
           R"({"format": "ph-barcode", "representatives": "cyclic", "bars": []})",
           R"({"format": "ph-barcode", "bars": [], "representatives": "cycles"})",
           bar(R"({"dim": 0, "birth": 1, "death": 2, "x": "\q"})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2, "x": "\u12g4"})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2} {})"),
           bar(R"({"dim": 0, "birth": 1, "death": 2, "p": 1.5})"),
           bar(R"({"dim": 1, "birth": 1, "death": 2,
                   "loops": [{"vertices": [1], "coefficient": 1}]})"),
           chain(R"("loops": [{"vertices": [], "coefficient": 1}])"),
           chain(R"("loops": [{"vertices": [1]}])"),
           chain(R"("loops": [{"grid": [[1]], "coefficient": 1}])"),
           chain(R"("loops": [{"vertices": [1], "coefficient": 1, "tight": "yes"}])"),
           set(R"("voxels": [[0, 0]])"),
           set(R"("voxels": [[0, 2, 1]])"),
           set(R"("voxels": [[0, 2], [1, 1]])"),
           set(R"("voxels": [[4294967295, 2]])"),
           set(R"("birth_voxel": [2, 5])"),
           set(R"("birth_voxel": [1])"),
           bar("") + "x"}) {
    EXPECT_TRUE(contains(bad_data([&] { back(text, "b.json"); }), "b.json")) << text;
  }
  const std::string deep(100000, '[');
  EXPECT_TRUE(contains(bad_data([&] { back("{\"x\": " + deep); }), "too deeply"));
  EXPECT_TRUE(contains(bad_data([&] { back(bar("\n  {\"dim\": x}"), "b.json"); }), "b.json:2:11"));
}

TEST(ReadBarcode, CellsThatAreNotKnownStayUnknown) {
  Barcode rows(CellKind::row);  // bars from a file without cells
  for (int i = 0; i < 40; ++i) rows.add({0, 1, 2}, {}, {});
  const Barcode read = back(text_of(rows, BarcodeFormat::json));
  EXPECT_EQ(read.size(), 40U);
  EXPECT_TRUE(read.birth_cell(0).numbers.empty());
  EXPECT_FALSE(read.death_cell(0).has_value());
}

}  // namespace
}  // namespace ph::test
