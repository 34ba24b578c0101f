// SPDX-License-Identifier: MIT
// Reads the members of a barcode's JSON that describe its origin.
#include <fmt/format.h>

#include "libph/src/io/barcodes/barcode_read.hpp"

namespace ph {
namespace {

using detail::JsonCursor;

/// Reads the members that describe the origin of a barcode.
class InfoReader {
 public:
  InfoReader(JsonCursor& json, BarcodeInfo& info) : json_(json), info_(info) {}

  /// If member `name` describes the origin of the barcode, reads its value. @return false for any
  /// other member.
  bool read(const std::string& name) {
    if (name == "program") {
      info_.program = text();
    } else if (name == "input") {
      read_input();
    } else if (name == "complex") {
      info_.complex = text();
    } else if (name == "field") {
      info_.field = json_.integer(2, kMost, "field");
    } else if (name == "max_dim") {
      info_.max_dim = static_cast<int>(json_.integer(0, kMost, "dimension"));
    } else if (name == "threshold") {
      info_.threshold = number();
    } else if (name == "vertices") {
      info_.vertices = count();
    } else if (name == "edges") {
      info_.edges = static_cast<std::size_t>(count());
    } else if (name == "collapsed") {
      info_.collapsed = json_.boolean();
    } else if (name == "metric") {
      info_.metric = text();
    } else if (name == "construction") {
      info_.construction = text();
    } else if (name == "periodic") {
      json_.for_each_element(
          [&] { info_.periodic.push_back(static_cast<int>(json_.integer(0, kMost, "axis"))); });
    } else if (name == "vertex_weights") {
      info_.vertex_weights = text();
    } else if (name == "subsample") {
      read_subsample();
    } else if (name == "voxels") {
      read_voxels();
    } else if (name == "alpha") {
      read_alpha();
    } else if (name == "superlevel") {
      info_.superlevel = json_.boolean();
    } else if (name == "approximation") {
      info_.approximation = number();
    } else if (name == "min_persistence") {
      info_.min_persistence = number();
    } else if (name == "min_dim") {
      info_.min_dim = static_cast<int>(json_.integer(0, kMost, "dimension"));
    } else if (name == "dims") {
      json_.for_each_element(
          [&] { info_.dims.push_back(static_cast<int>(json_.integer(0, kMost, "dimension"))); });
    } else if (name == "engine") {
      info_.engine = text();
    } else if (name == "timings") {
      json_.for_each_member(
          [&](const std::string& stage) { info_.timings.emplace_back(stage, json_.number()); });
    } else if (name == "peak_memory") {
      info_.peak_memory = static_cast<std::uint64_t>(count());
    } else {
      return false;
    }
    return true;
  }

 private:
  static constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();

  // A null value means that the text is unknown.
  std::string text() { return json_.accept_null() ? std::string() : json_.string(); }
  std::optional<double> number() {
    return json_.accept_null() ? std::nullopt : std::optional(read_barcode_value(json_));
  }
  std::int64_t count() {
    return json_.accept_null()
               ? 0
               : json_.integer(0, std::numeric_limits<std::int64_t>::max(), "number");
  }

  void read_affine() {
    const std::size_t place = json_.place();
    std::vector<double> numbers;
    json_.for_each_element(
        [&] { json_.for_each_element([&] { numbers.push_back(json_.number()); }); });
    if (numbers.size() != 12)
      json_.fail(place, {"affine", fmt::format("{} numbers", numbers.size()), "3 rows of 4", {}});
    auto& affine = info_.affine.emplace();
    for (std::size_t i = 0; i < numbers.size(); ++i) affine[i / 4][i % 4] = numbers[i];
  }

  void read_input() {
    json_.for_each_member([&](const std::string& member) {
      if (member == "path") {
        info_.input = text();
      } else if (member == "description") {
        info_.input_description = text();
      } else if (member == "points") {
        info_.points = count();
      } else if (member == "coordinates") {
        info_.coordinates = count();
      } else if (member == "shape") {
        info_.shape.clear();
        json_.for_each_element([&] { info_.shape.push_back(count()); });
      } else if (member == "affine") {
        read_affine();
      } else if (member == "nan") {
        info_.nan_dropped = text() == "drop";
      } else {
        json_.skip_value();
      }
    });
  }

  void read_subsample() {
    if (json_.accept_null()) return;
    auto& sample = info_.subsample.emplace();
    json_.for_each_member([&](const std::string& member) {
      if (member == "points")
        sample.points = count();
      else if (member == "of")
        sample.of = count();
      else if (member == "covering_radius")
        sample.covering_radius = number().value_or(kInfinity);
      else
        json_.skip_value();
    });
  }

  void read_alpha() {
    if (json_.accept_null()) return;
    auto& alpha = info_.alpha.emplace();
    json_.for_each_member([&](const std::string& member) {
      if (member == "squared") {
        alpha.squared = json_.boolean();
      } else if (member == "period") {
        json_.for_each_element([&] { alpha.period.push_back(json_.number()); });
      } else if (member == "hidden") {
        json_.for_each_element([&] { alpha.hidden.push_back(count()); });
      } else {
        json_.skip_value();
      }
    });
  }

  void read_voxels() {
    if (json_.accept_null()) return;
    auto& grid = info_.voxels.emplace();
    json_.for_each_member([&](const std::string& member) {
      if (member == "edge") {
        grid.voxel = json_.number();
      } else if (member == "value") {
        grid.value = text();
      } else if (member == "first") {
        json_.for_each_element([&] { grid.first.push_back(json_.number()); });
      } else {
        json_.skip_value();
      }
    });
  }

  JsonCursor& json_;
  BarcodeInfo& info_;
};

}  // namespace

double read_barcode_value(detail::JsonCursor& json) {
  if (json.accept_null()) return kInfinity;
  if (json.peek() != '"') return json.number();
  const std::size_t place = json.place();
  const std::string word = json.string();
  if (word != "-inf")
    json.fail(place, {"value", printable(word, 40), "a number, null or \"-inf\"", {}});
  return -kInfinity;
}

bool read_barcode_info(detail::JsonCursor& json, const std::string& name, BarcodeInfo& info) {
  return InfoReader(json, info).read(name);
}

}  // namespace ph
