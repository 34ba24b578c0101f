// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <set>

#include "libph/src/io/barcodes/barcode_read.hpp"
#include "ph/detail/io/json_cursor.hpp"

namespace ph {
namespace {

using detail::JsonCursor;

/// Calls `take` with each member of the next object.
template <class Take>
void for_each_member(JsonCursor& json, Take&& take) {
  std::string name;
  json.expect('{');
  for (bool first = true; json.next_member(first, name);) take(name);
}

// A death of null means that the class never dies.
double value_of(JsonCursor& json) {
  if (json.accept_null()) return kInfinity;
  if (json.peek() != '"') return json.number();
  const std::size_t place = json.place();
  const std::string word = json.string();
  if (word != "-inf")
    json.fail(place, {"value", printable(word, 40), "a number, null or \"-inf\"", {}});
  return -kInfinity;
}

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
      for_each_member(json_, [&](const std::string& member) {
        if (member == "path")
          info_.input = text();
        else if (member == "description")
          info_.input_description = text();
        else
          json_.skip_value();
      });
    } else if (name == "complex") {
      info_.complex = text();
    } else if (name == "field") {
      info_.field = json_.integer(2, kMost, "field");
    } else if (name == "max_dim") {
      info_.max_dim = static_cast<int>(json_.integer(0, kMost, "dimension"));
    } else if (name == "threshold") {
      info_.threshold = number();
    } else if (name == "metric") {
      info_.metric = text();
    } else if (name == "construction") {
      info_.construction = text();
    } else if (name == "periodic") {
      json_.expect('[');
      for (bool first = true; json_.next_element(first);)
        info_.periodic.push_back(static_cast<int>(json_.integer(0, kMost, "axis")));
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
    } else if (name == "engine") {
      info_.engine = text();
    } else if (name == "timings") {
      for_each_member(json_, [&](const std::string& stage) {
        info_.timings.emplace_back(stage, json_.number());
      });
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
    return json_.accept_null() ? std::nullopt : std::optional(value_of(json_));
  }
  std::int64_t count() {
    return json_.accept_null()
               ? 0
               : json_.integer(0, std::numeric_limits<std::int64_t>::max(), "number");
  }

  void read_subsample() {
    if (json_.accept_null()) return;
    auto& sample = info_.subsample.emplace();
    for_each_member(json_, [&](const std::string& member) {
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
    for_each_member(json_, [&](const std::string& member) {
      if (member == "squared") {
        alpha.squared = json_.boolean();
      } else if (member == "period") {
        json_.expect('[');
        for (bool first = true; json_.next_element(first);) alpha.period.push_back(json_.number());
      } else if (member == "hidden") {
        json_.expect('[');
        for (bool first = true; json_.next_element(first);) alpha.hidden.push_back(count());
      } else {
        json_.skip_value();
      }
    });
  }

  void read_voxels() {
    if (json_.accept_null()) return;
    auto& grid = info_.voxels.emplace();
    for_each_member(json_, [&](const std::string& member) {
      if (member == "edge") {
        grid.voxel = json_.number();
      } else if (member == "value") {
        grid.value = text();
      } else if (member == "first") {
        json_.expect('[');
        for (bool first = true; json_.next_element(first);) grid.first.push_back(json_.number());
      } else {
        json_.skip_value();
      }
    });
  }

  JsonCursor& json_;
  BarcodeInfo& info_;
};

/// Reads the JSON that write_barcode_json writes. Unknown members are skipped.
class Reader {
 public:
  explicit Reader(const Input& input) : input_(input), json_(input) {}

  StoredBarcode read() {
    StoredBarcode stored;
    InfoReader info(json_, stored.info);
    bool format = false, bars = false;
    for_each_member(json_, [&](const std::string& name) {
      const std::size_t place = json_.place();
      if (name == "format") {
        const std::string value = json_.string();
        if (value != "ph-barcode") {
          json_.fail(place, {"format", printable(value, 40), "ph-barcode", {}});
        }
        format = true;
      } else if (name == "version") {
        json_.integer(1, 1, "version");
      } else if (name == "representatives") {
        if (bars)
          json_.fail(place, {"representatives", "them after the bars", "them before the bars", {}});
        representatives_ = representatives();
      } else if (name == "bars") {
        if (bars) json_.fail(place, {"bars", "a second list", "one", {}});
        bars = true;
        read_bars();
      } else if (!info.read(name)) {
        skip(name);
      }
    });
    json_.expect_end();
    if (!format || !bars) {
      input_.fail({"not a barcode",
                   format ? "no bars" : "no format",
                   R"("format": "ph-barcode" and "bars")",
                   {}});
    }
    stored.bars = std::move(barcode_);
    stored.left_out.assign(skipped_.begin(), skipped_.end());
    return stored;
  }

 private:
  void skip(const std::string& name) {
    // This number of names is enough to tell the user what is lost.
    constexpr std::size_t most = 20;
    if (skipped_.size() < most) skipped_.insert(printable(name, 40));
    json_.skip_value();
  }

  Representatives representatives() {
    const std::size_t place = json_.place();
    const std::string value = json_.string();
    if (value == "cycles") return Representatives::cycles;
    if (value == "cocycles") return Representatives::cocycles;
    // Sets of voxels are not read, because only segmentation programs need them, and a few numbers
    // in the file can expand to an entire image.
    if (value != "none" && value != "voxels") {
      json_.fail(place,
                 {"representatives", printable(value, 40), "cycles, cocycles, voxels or none", {}});
    }
    return Representatives::none;
  }

  void read_bars() {
    json_.expect('[');
    for (bool first = true; json_.next_element(first);) {
      if ((++count_ & 0xFFF) == 0) input_.poll();
      read_bar();
    }
  }

  void read_bar() {
    json_.peek();
    const std::size_t place = json_.place();
    Bar bar;
    bool first = true, dim = false, birth = false, death = false, born = false, died = false;
    std::string name;
    birth_.clear();
    death_.clear();
    chain_.clear();
    coefficients_.clear();
    json_.expect('{');
    const auto once = [&](bool& seen) {
      if (seen) json_.fail(json_.place(), {name, "a second one", "one per bar", {}});
      seen = true;
    };
    while (json_.next_member(first, name)) {
      if (name == "dim") {
        once(dim);
        bar.dim = static_cast<int>(json_.integer(0, kMostBarDimension, "dimension"));
      } else if (name == "birth") {
        once(birth);
        bar.birth = value_of(json_);
      } else if (name == "death") {
        once(death);
        bar.death = value_of(json_);
      } else if (name == "birth_cell") {
        once(born);
        if (!json_.accept_null()) read_cell(birth_);
      } else if (name == "death_cell") {
        once(died);
        if (!json_.accept_null()) read_cell(death_);
      } else if (name == "representative" && representatives_ != Representatives::none) {
        read_chain();
      } else {
        skip(name);
      }
    }
    if (!dim || !birth || !death) {
      json_.fail(place, {"incomplete bar",
                         !dim     ? "no dim"
                         : !birth ? "no birth"
                                  : "no death",
                         "dim, birth and death",
                         {}});
    }
    if (const Fault fault = fault_of_bar(bar); !fault.what.empty()) json_.fail(place, fault);
    input_.require_memory((birth_.size() + death_.size() + chain_.size()) * sizeof(Index));
    if (barcode_.empty()) {  // the first bar shows whether cells are known, and of which kind
      barcode_ = Barcode(kind_);
      with_cells_ = !birth_.empty();
    }
    if (with_cells_ == birth_.empty() || (!with_cells_ && death_.size() + chain_.size() > 0)) {
      json_.fail(place, {"birth cell",
                         birth_.empty() ? "none" : "one",
                         "one for each bar, or no cells at all",
                         {}});
    }
    barcode_.add(bar, birth_, death_);
    if (representatives_ != Representatives::none) {
      barcode_.set_representative(representatives_, chain_, coefficients_);
    }
  }

  void set_kind(CellKind kind, std::size_t place) {
    if (any_cell_ && kind != kind_) {
      json_.fail(place, {"cell", "a second kind of cell", "cells of one kind", {}});
    }
    any_cell_ = true;
    kind_ = kind;
  }

  void read_cell(std::vector<Index>& numbers) {
    json_.peek();
    const std::size_t place = json_.place();
    numbers.clear();
    bool first = true, known = false;
    std::string name;
    json_.expect('{');
    while (json_.next_member(first, name)) {
      if (read_numbers(name, numbers, 0, place)) {
        known = true;
      } else {
        json_.skip_value();
      }
    }
    if (!known || numbers.empty()) {
      json_.fail(place, {"cell", "none", "a member vertices, grid or row", {}});
    }
  }

  // If member `name` contains the numbers of a cell, stores them in `numbers`, starting at index
  // `begin`.
  // @return false for any other member.
  bool read_numbers(const std::string& name, std::vector<Index>& numbers, std::size_t begin,
                    std::size_t place) {
    constexpr Index kMost = std::numeric_limits<Index>::max();
    if (name != "row" && name != "vertices" && name != "grid") return false;
    numbers.resize(begin);
    if (name == "row") {
      set_kind(CellKind::row, place);
      numbers.push_back(json_.integer(0, kMost, "row"));
    } else {
      set_kind(name == "grid" ? CellKind::grid : CellKind::vertices, place);
      json_.expect('[');
      for (bool first = true; json_.next_element(first);) {
        numbers.push_back(json_.integer(0, kMost, "number of a cell"));
      }
    }
    return true;
  }

  void read_chain() {
    json_.peek();
    const std::size_t place = json_.place();
    std::string name;
    chain_.clear();
    coefficients_.clear();
    json_.expect('[');
    for (bool first = true; json_.next_element(first);) {
      const std::size_t before = chain_.size();
      std::int64_t coefficient = 0;
      json_.expect('{');
      for (bool first_member = true; json_.next_member(first_member, name);) {
        if (name == "coefficient") {
          coefficient =
              json_.integer(-(std::int64_t{1} << 31), std::int64_t{1} << 31, "coefficient");
        } else if (!read_numbers(name, chain_, before, place)) {
          json_.skip_value();
        }
      }
      coefficients_.push_back(coefficient);
      // All cells of a chain have equally many numbers.
      const std::size_t numbers = chain_.size() - before;
      if (numbers == 0 || chain_.size() != numbers * coefficients_.size() || coefficient == 0) {
        json_.fail(place, {"representative",
                           "cells of different sizes or without a coefficient",
                           "cells of one dimension, each with its coefficient",
                           {}});
      }
    }
  }

  const Input& input_;
  JsonCursor json_;
  Barcode barcode_;
  Representatives representatives_ = Representatives::none;
  CellKind kind_ = CellKind::vertices;
  bool any_cell_ = false, with_cells_ = false;
  std::size_t count_ = 0;
  std::set<std::string> skipped_;
  std::vector<Index> birth_, death_, chain_;
  std::vector<std::int64_t> coefficients_;
};

}  // namespace

StoredBarcode read_barcode_json(const Input& input) { return Reader(input).read(); }

}  // namespace ph
