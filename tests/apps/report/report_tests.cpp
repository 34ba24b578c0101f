// SPDX-License-Identifier: MIT
// Tests how a report is written: its encodings, its metadata and its page. The reports that
// programs write are tested in barcode_report.py, barcode_report_data.py and segment_report.py.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>

#include "ph/detail/io/base64.hpp"
#include "ph/detail/report/array_block.hpp"
#include "ph/detail/report/metadata.hpp"
#include "ph/detail/report/page_template.hpp"
#include "ph/detail/report/report_file.hpp"
#include "ph/detail/report/sha256.hpp"
#include "ph/error.hpp"
#include "tests/support/report_arrays.hpp"

namespace ph::report {
namespace {

/// The text that `write` writes to a Sink.
template <class Write>
std::string written(Write&& write) {
  std::string text;
  write([&text](std::string_view piece) { text += piece; });
  return text;
}

std::string encoded(std::string_view text, std::size_t piece) {
  detail::Base64 base64;
  std::string result;
  for (std::size_t at = 0; at < text.size(); at += piece)
    base64.append(std::as_bytes(std::span(text.substr(at, piece))), result);
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
  // The bytes come in one piece, or in pieces that do not end with a block.
  const auto hash = [](std::string_view text) {
    Sha256 whole, pieces;
    whole.add(std::as_bytes(std::span(text)));
    for (std::size_t at = 0, size = 1; at < text.size(); at += size, size = size % 150 + 1)
      pieces.add(std::as_bytes(std::span(text.substr(at, size))));
    EXPECT_EQ(pieces.hex(), whole.hex());
    return whole.hex();
  };
  EXPECT_EQ(hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

template <class T>
void expect_round_trip(bool delta) {
  std::mt19937 random(7);
  for (const std::size_t rows : {0, 1, 2, 300, 50'000}) {
    for (const std::size_t columns : {1, 3}) {
      std::vector<T> numbers;
      for (std::size_t i = 0; i < rows * columns; ++i)
        numbers.push_back(static_cast<T>(static_cast<std::int32_t>(random())));
      const std::string element = written([&](const Sink& sink) {
        write_array(sink, raw_array("a/b", std::span<const T>(numbers)),
                    {.shape = {rows, columns}, .delta = delta}, default_context());
      });
      EXPECT_EQ(test::numbers_of<T>(element, numbers.size(), columns), numbers);
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
  const std::string element = written([&](const Sink& sink) {
    write_array(sink, raw_array("points/position", std::span<const std::uint16_t>(numbers)),
                {.shape = {2, 2}, .delta = true, .offset = {0, -1.5}, .scale = {0.25, 1e-300}},
                default_context());
  });
  EXPECT_TRUE(element.starts_with(
      "<script type=\"application/x-ph-array\" data-array=\"points/position\" data-type=\"u16\" "
      "data-shape=\"2,2\" data-filter=\"delta planes\" data-offset=\"0,-1.5\" "
      "data-scale=\"0.25,1e-300\">"))
      << element;
  EXPECT_THROW(written([&](const Sink& sink) {
                 write_array(sink, raw_array("x", std::span<const std::uint16_t>(numbers)),
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
    EXPECT_THROW(require_built_in(), Error);
    GTEST_SKIP() << "reports are not built in";
  }
  const std::size_t place = page.find(kPayloadMarker);
  ASSERT_NE(place, page.npos);
  EXPECT_EQ(page.find(kPayloadMarker, place + 1), page.npos);
  EXPECT_TRUE(page.starts_with("<!doctype html>") || page.starts_with("<!DOCTYPE html>"));
  const std::string whole = written([&](const Sink& sink) {
    ReportFile report(sink, {}, default_context());
    report.add("x", std::vector<std::uint8_t>{1});
    report.finish();
  });
  EXPECT_TRUE(whole.starts_with(page.substr(0, place)));
  EXPECT_TRUE(whole.ends_with(page.substr(place + kPayloadMarker.size())));
}

}  // namespace
}  // namespace ph::report
