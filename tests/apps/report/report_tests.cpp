// SPDX-License-Identifier: MIT
// The parts that reports are written with; what programs make of them: barcode_report.py,
// segment_report.py.
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "ph/error.hpp"
#include "report/arrays/point_arrays.hpp"
#include "report/arrays/touching_leaves.hpp"
#include "report/arrays/tree_arrays.hpp"
#include "report/arrays/voxel_arrays.hpp"
#include "report/encoding/array_block.hpp"
#include "report/encoding/base64.hpp"
#include "report/encoding/sha256.hpp"
#include "report/metadata.hpp"
#include "report/page_template.hpp"
#include "report/report_file.hpp"

namespace ph::report {
namespace {

/// What `write(OutputFile&)` writes.
template <class Write>
std::string written(Write&& write) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("ph_report_" + std::to_string(getpid()))).string();
  OutputFile file(path);
  write(file);
  file.commit();
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

std::string encoded(std::string_view text, std::size_t piece) {
  Base64 base64;
  std::string result;
  for (std::size_t at = 0; at < text.size(); at += piece) {
    const std::string_view part = text.substr(at, piece);
    base64.append({reinterpret_cast<const std::uint8_t*>(part.data()), part.size()}, result);
  }
  base64.finish(result);
  return result;
}

TEST(Base64, IsThatOfRfc4648InPiecesOfAnySize) {
  const std::pair<const char*, const char*> cases[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"},
                                                       {"\xff\xef\xbe", "/+++"}};
  for (const auto& [text, expected] : cases)
    for (const std::size_t piece : {1, 2, 3, 7}) EXPECT_EQ(encoded(text, piece), expected);
}

TEST(Sha256, IsThatOfFips180) {
  const auto hash = [](std::string_view text) {
    return sha256_hex(std::as_bytes(std::span(text)));
  };
  EXPECT_EQ(hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

std::vector<std::uint8_t> base64_decoded(std::string_view text) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

/// The numbers of an element, as the page reads them.
template <class T>
std::vector<T> numbers_of(const std::string& element, std::size_t count, std::size_t columns) {
  const std::size_t begin = element.find('>') + 1, end = element.rfind("</script>");
  const auto packed = base64_decoded(std::string_view(element).substr(begin, end - begin));
  std::vector<std::uint8_t> bytes(count * sizeof(T) + 1);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &size, packed.data(), packed.size()), Z_OK);
  EXPECT_EQ(size, count * sizeof(T));
  std::vector<std::uint8_t> unplaned(count * sizeof(T));
  for (std::size_t k = 0; k < sizeof(T); ++k)
    for (std::size_t i = 0; i < count; ++i) unplaned[i * sizeof(T) + k] = bytes[k * count + i];
  std::vector<T> numbers(count);
  if (count > 0) std::memcpy(numbers.data(), unplaned.data(), unplaned.size());
  if (element.find("delta") < begin)
    for (std::size_t i = columns; i < count; ++i)
      numbers[i] = static_cast<T>(numbers[i] + numbers[i - columns]);
  return numbers;
}

template <class T>
void expect_round_trip(bool delta) {
  std::mt19937 random(7);
  for (const std::size_t rows : {0, 1, 2, 300, 50'000}) {
    for (const std::size_t columns : {1, 3}) {
      std::vector<T> numbers;
      for (std::size_t i = 0; i < rows * columns; ++i)
        numbers.push_back(static_cast<T>(static_cast<std::int32_t>(random())));
      const std::string element = written([&](OutputFile& file) {
        write_array(file, raw_array("a/b", std::span<const T>(numbers)),
                    {.shape = {rows, columns}, .delta = delta}, default_context());
      });
      EXPECT_EQ(numbers_of<T>(element, numbers.size(), columns), numbers);
    }
  }
}

TEST(Arrays, AreReadBack) {
  for (const bool delta : {false, true}) {
    expect_round_trip<std::uint8_t>(delta);
    expect_round_trip<std::int8_t>(delta);
    expect_round_trip<std::uint16_t>(delta);
    expect_round_trip<std::int16_t>(delta);
    expect_round_trip<std::uint32_t>(delta);
    expect_round_trip<std::int32_t>(delta);
  }
  expect_round_trip<float>(false);
  expect_round_trip<double>(false);
}

TEST(Arrays, SayWhatTheyAre) {
  const std::vector<std::uint16_t> numbers{1, 2, 3, 4};
  const std::string element = written([&](OutputFile& file) {
    write_array(file, raw_array("points/position", std::span<const std::uint16_t>(numbers)),
                {.shape = {2, 2}, .delta = true, .offset = {0, -1.5}, .scale = {0.25, 1e-300}},
                default_context());
  });
  EXPECT_TRUE(element.starts_with(
      "<script type=\"application/x-ph-array\" data-array=\"points/position\" data-type=\"u16\" "
      "data-shape=\"2,2\" data-filter=\"delta planes\" data-offset=\"0,-1.5\" "
      "data-scale=\"0.25,1e-300\">"))
      << element;
  EXPECT_THROW(written([&](OutputFile& file) {
                 write_array(file, raw_array("x", std::span<const std::uint16_t>(numbers)),
                             {.shape = {3}}, default_context());
               }),
               Error);
}

TEST(MetadataText, NoNameEndsTheElement) {
  Metadata meta;
  meta.title = "</script><script>alert(1)</script>\n\xff.csv";
  meta.barcodes.push_back({"<!--", CellKind::grid, Representatives::cycles});
  meta.provenance.command = {"ph-barcode", "<script>"};
  meta.provenance.notes = {{"<b>", "\"quoted\" \\ <i>"}};
  const std::string json = metadata_json(meta);
  EXPECT_EQ(json.find('<'), std::string::npos);
  EXPECT_NE(json.find("\\u003c/script>"), std::string::npos);
  EXPECT_NE(json.find("\\n\xef\xbf\xbd.csv"), std::string::npos) << json;
  EXPECT_NE(json.find("\\\"quoted\\\" \\\\ \\u003ci>"), std::string::npos) << json;
  EXPECT_NE(json.find("\"cells\": \"grid\", \"representatives\": \"cycles\""), std::string::npos);
}

TEST(MetadataText, ATitleHasNoFolders) {
  EXPECT_EQ(title_of("a/b.c/d.csv"), "d.csv");
  EXPECT_EQ(title_of("d.csv"), "d.csv");
  EXPECT_EQ(title_of("-"), "-");
}

TEST(Page, HasItsMarkerOnce) {
  const std::string_view page = page_template();
  if (page.empty()) {
    EXPECT_THROW(require_built_in("--report"), Error);
    GTEST_SKIP() << "reports are not built in";
  }
  const std::size_t place = page.find(kPayloadMarker);
  ASSERT_NE(place, page.npos);
  EXPECT_EQ(page.find(kPayloadMarker, place + 1), page.npos);
  EXPECT_TRUE(page.starts_with("<!doctype html>") || page.starts_with("<!DOCTYPE html>"));
  const std::string whole = written([&](OutputFile& file) {
    ReportFile report(file, {}, default_context());
    report.add("x", std::vector<std::uint8_t>{1});
    report.finish();
  });
  EXPECT_TRUE(whole.starts_with(page.substr(0, place)));
  EXPECT_TRUE(whole.ends_with(page.substr(place + kPayloadMarker.size())));
}

TEST(Normals, AreFoundAgain) {
  const auto direction = [](std::array<std::int8_t, 2> stored) {
    const double u = stored[0] / 127.0, v = stored[1] / 127.0;
    std::array<double, 3> n{u, v, 1 - std::abs(u) - std::abs(v)};
    if (n[2] < 0) {
      n[0] = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
      n[1] = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    }
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& x : n) x /= length;
    return n;
  };
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    std::array<double, 3> n{normal(random), normal(random), normal(random)};
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& x : n) x /= length;
    const auto m = direction(octahedral(n[0], n[1], n[2]));
    EXPECT_GT(n[0] * m[0] + n[1] * m[1] + n[2] * m[2], std::cos(std::numbers::pi / 180));
  }
  EXPECT_EQ(octahedral(0, 0, -1), (std::array<std::int8_t, 2>{127, 127}));
  EXPECT_EQ(octahedral(std::nan(""), 0, 1), (std::array<std::int8_t, 2>{-128, -128}));
}

/// A path of vertices with these births; each edge enters with its later end.
MergeTree path_tree(std::vector<double> births) {
  MergeTree tree;
  tree.births = std::move(births);
  const Index n = tree.size();
  std::vector<Index> oldest(tree.births.size()), sizes(tree.births.size(), 1);
  for (std::size_t v = 0; v < oldest.size(); ++v) oldest[v] = static_cast<Index>(v);
  std::vector<Index> edges;
  for (Index v = 0; v + 1 < n; ++v) edges.push_back(v);
  const auto birth = [&](Index v) { return tree.births[static_cast<std::size_t>(v)]; };
  const auto value = [&](Index e) { return std::max(birth(e), birth(e + 1)); };
  std::ranges::stable_sort(edges, {}, value);
  const auto root = [&](Index v) {
    while (oldest[static_cast<std::size_t>(v)] != v) v = oldest[static_cast<std::size_t>(v)];
    return v;
  };
  for (const Index e : edges) {
    Index elder = root(e), younger = root(e + 1);
    if (std::pair(birth(younger), younger) < std::pair(birth(elder), elder))
      std::swap(elder, younger);
    Index &large = sizes[static_cast<std::size_t>(elder)],
          small = sizes[static_cast<std::size_t>(younger)];
    tree.merges.push_back(
        {value(e), e, e + 1, elder, younger, large, small, birth(elder), birth(younger)});
    large += small;
    oldest[static_cast<std::size_t>(younger)] = elder;
  }
  return tree;
}

/// The partition that the page makes of a cut: the vertices by the smallest leaf of their segment.
std::vector<std::uint32_t> page_cut(const MergeTree& tree, const ContractedTree& contracted,
                                    CutRule rule, double cut) {
  std::vector<std::uint32_t> parent(contracted.leaf_birth.size());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto find = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  for (const auto& k : contracted.merges) {
    const Merge& m = tree.merges[k.merge];
    const bool done = rule == CutRule::value ? m.value <= cut : m.persistence() < cut;
    const auto [low, high] = std::minmax({find(k.younger), find(k.elder)});
    if (done) parent[high] = low;
  }
  std::vector<std::uint32_t> part;
  for (std::size_t v = 0; v < tree.births.size(); ++v) part.push_back(find(contracted.leaf_of[v]));
  return part;
}

template <class A, class B>
void expect_same_partition(const std::vector<A>& a, const std::vector<B>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) ASSERT_EQ(a[i] == a[j], b[i] == b[j]) << i << " " << j;
}

TEST(Trees, CutAsTheProgramsDo) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> births;
    for (int v = 0; v < 60; ++v) births.push_back(static_cast<double>(random() % 12));
    const MergeTree tree = path_tree(births);
    for (const Index min_part : {1, 4}) {
      const auto contraction =
          contracted(tree, CutRule::persistence, 1, min_part, {}, default_context());
      for (const double cut : {1.0, 2.0, 5.0, 100.0})
        expect_same_partition(page_cut(tree, contraction, CutRule::persistence, cut),
                              tree.basins(cut, min_part));
    }
    const auto contraction = contracted(tree, CutRule::value, 2, 1, {}, default_context());
    for (const double cut : {11.0, 12.0})  // all vertices have entered
      expect_same_partition(page_cut(tree, contraction, CutRule::value, cut), tree.components(cut));
  }
}

TEST(Trees, LeavesAreNumberedByTheirSmallestVertexAndEndsByAge) {
  const MergeTree tree = path_tree({5, 0, 7, 2, 9, 4, kInfinity});
  MergeTree some = tree;
  std::erase_if(some.merges, [](const Merge& m) { return m.value == kInfinity; });
  const auto c = contracted(some, CutRule::persistence, 1, 1, {}, default_context());
  EXPECT_EQ(c.leaf_of, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 2, kNone}));
  EXPECT_EQ(c.leaf_birth, (std::vector<double>{0, 2, 4}));
  EXPECT_EQ(c.leaf_vertices, (std::vector<std::uint32_t>{3, 2, 1}));
  ASSERT_EQ(c.merges.size(), 2U);
  EXPECT_EQ(c.merges[0].younger, 1U);
  EXPECT_EQ(c.merges[0].elder, 0U);
  EXPECT_EQ(c.merges[1].younger, 2U);
  EXPECT_EQ(c.merges[1].elder, 1U);
}

TEST(Trees, BarsAreLinkedByValueAndThenByVertex) {
  const MergeTree tree = path_tree({0, 9, 1, 9, 1, 9, 0});
  Barcode bars;
  bars.add({0, 0, 9}, {}, {});
  bars.add({0, 0, kInfinity}, {}, {});
  bars.add({0, 1, 9}, {}, {});
  bars.add({0, 1, 9}, {}, {});
  const std::vector<std::uint32_t> vertices{6, 0, 4, 2};
  const LinkedBars linked = linked_bars(tree, bars, vertices);
  EXPECT_EQ(linked.of_vertex[0], 1U);
  for (std::size_t i = 0; i < tree.merges.size(); ++i) {
    const Merge& m = tree.merges[i];
    const std::uint32_t expected = m.persistence() == 0 ? kNone
                                   : m.younger == 6     ? 0U
                                   : m.younger == 4     ? 2U
                                                        : 3U;
    EXPECT_EQ(linked.of_merge[i], expected) << m.younger;
  }
}

TEST(Trees, TheLeastCutKeepsNoMoreThanAskedFor) {
  const MergeTree tree = path_tree({0, 9, 1, 9, 2, 9, 3, 9, 3});
  for (const CutRule rule : {CutRule::persistence, CutRule::value})
    for (const std::size_t most : {1, 2, 3, 4, 100}) {
      const double from = least_cut(tree, rule, most);
      EXPECT_LE(contracted(tree, rule, from, 1, {}, default_context()).merges.size(),
                std::max<std::size_t>(most, 2))
          << most;
    }
  EXPECT_EQ(least_cut(tree, CutRule::persistence, 100), 6);
  EXPECT_EQ(least_cut({}, CutRule::value, 1), 0);
}

TEST(TouchingLeaves, AreBesideEachOtherInThePicture) {
  constexpr std::uint32_t none = kNone;
  // Two rows of twelve pixels, the second without its first one.
  const std::vector<std::uint32_t> index = {0,  1,  2,  3,  11, 13, 14, 15,
                                            16, 17, 18, 19, 20, 21, 22, 23};
  const std::vector<std::uint32_t> leaf = {5,    5,    none, 1,    2,    5,    none, none,
                                           none, none, none, none, none, none, 7,    2};
  // 1 and 2 are eight columns apart, 5 and 7 nine; 2 and 7 touch; 1 has nobody below.
  EXPECT_EQ(touching_in_picture(index, leaf, 12), (std::vector<std::uint32_t>{1, 2, 1, 5, 2, 7}));
  // The end of a row is not beside the begin of the next one.
  const std::vector<std::uint32_t> ends = {11, 12}, two = {0, 1};
  EXPECT_TRUE(touching_in_picture(ends, two, 12).empty());
  const std::vector<std::uint32_t> rows = {0, 24, 25};
  EXPECT_EQ(touching_in_picture(rows, std::vector<std::uint32_t>{3, 4, none}, 3),
            (std::vector<std::uint32_t>{3, 4}));
  EXPECT_TRUE(touching_in_picture(rows, std::vector<std::uint32_t>{3, 4, none}, 2).empty());
}

/// Bars of H0 by birth: (birth, voxels of its set).
Barcode with_sets(const std::vector<std::pair<double, std::vector<std::uint32_t>>>& bars) {
  Barcode barcode(CellKind::grid);
  for (const auto& [birth, places] : bars) {
    const Index cell[] = {0, 0};
    barcode.add({0, birth, 10}, cell, cell);
    barcode.set_representative(Representatives::voxels, {}, {});
    const std::size_t begin = barcode.store_voxels(places);
    barcode.set_voxels({begin, begin + places.size()}, cell, cell);
  }
  return barcode;
}

using Places = std::vector<std::uint32_t>;

TEST(VoxelSets, AreRunsTheMostPersistentFirst) {
  const VoxelSets sets =
      voxel_sets(with_sets({{5, {9, 7, 8, 3}}, {1, {0}}, {2, {}}, {3, {70'000, 2, 1}}}), {});
  EXPECT_EQ(sets.bars, (Places{1, 3, 0}));
  EXPECT_EQ(sets.start, (Places{0, 1, 3, 5}));
  EXPECT_EQ(sets.runs, (Places{0, 1, 1, 2, 70'000, 1, 3, 1, 7, 3}));
  EXPECT_EQ(sets.note(), "");
}

TEST(VoxelSets, ThatExceedTheBudgetAreLeftOutAndCounted) {
  const Barcode barcode = with_sets({{1, {0, 2, 4, 6}}, {2, {1, 2, 3}}, {3, {0, 2}}, {4, {5}}});
  const VoxelSets few_runs = voxel_sets(barcode, {}, {.runs = 3});
  EXPECT_EQ(few_runs.bars, (Places{1, 2}));
  EXPECT_EQ(few_runs.start, (Places{0, 1, 3}));
  EXPECT_EQ(few_runs.runs, (Places{1, 3, 0, 1, 2, 1}));
  EXPECT_EQ(few_runs.left_out, 2U);
  EXPECT_NE(few_runs.note().find("2 of 4 bars"), std::string::npos);
  const VoxelSets few_voxels = voxel_sets(barcode, {}, {.voxels = 6});
  EXPECT_EQ(few_voxels.bars, (Places{0, 2}));
  EXPECT_EQ(few_voxels.left_out, 2U);
}

TEST(VoxelSets, AreThoseOfABarcodeThatHasThem) {
  Barcode cycles;
  const Index cell[] = {0};
  cycles.add({0, 0, 1}, cell, cell);
  EXPECT_TRUE(voxel_sets(cycles, {}).bars.empty());
}

}  // namespace
}  // namespace ph::report
