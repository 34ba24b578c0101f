// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>

#include "libph/src/io/barcodes/barcode_read.hpp"
#include "ph/detail/io/json_cursor.hpp"

namespace ph {
namespace {

using detail::JsonCursor;

/// Reads the JSON that write_barcode_json writes. Unknown members are skipped.
class Reader {
 public:
  explicit Reader(const Input& input) : input_(input), json_(input) {
    if (input.context() != nullptr) claim_.emplace(input.context()->memory, 0);
  }

  StoredBarcode read() {
    StoredBarcode stored;
    BarcodeInfo info;
    shape_ = &info.shape;
    bool format = false, bars = false;
    json_.for_each_member([&](const std::string& name) {
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
      } else if (!read_barcode_info(json_, name, info)) {
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
    stored.bars.set_info(std::move(info));
    stored.loops = std::move(loops_);
    stored.p_values = std::move(p_values_);
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
    const auto known = value_named<Representatives>(value);
    if (!known)
      json_.fail(place,
                 {"representatives", printable(value, 40), "cycles, cocycles, voxels or none", {}});
    // Only images have voxels. The first bars may have neither cells nor a chain.
    if (*known == Representatives::voxels) set_kind(CellKind::grid, place);
    return *known;
  }

  void read_bars() {
    json_.for_each_element([&] {
      if ((++count_ & 0xFFF) == 0) input_.poll();
      read_bar();
    });
  }

  void read_bar() {
    json_.peek();
    const std::size_t place = json_.place();
    Bar bar;
    bool dim = false, birth = false, death = false, born = false, died = false;
    BarLoops loops;
    double p = std::nan("");
    for (auto* const numbers : {&birth_, &death_, &chain_, &birth_voxel_, &death_voxel_})
      numbers->clear();
    coefficients_.clear();
    runs_.clear();
    json_.for_each_member([&](const std::string& name) {
      const auto once = [&](bool& seen) {
        if (seen) json_.fail(json_.place(), {name, "a second one", "one per bar", {}});
        seen = true;
      };
      if (name == "dim") {
        once(dim);
        bar.dim = static_cast<int>(json_.integer(0, kMostBarDimension, "dimension"));
      } else if (name == "birth") {
        once(birth);
        bar.birth = read_barcode_value(json_);
      } else if (name == "death") {
        once(death);
        bar.death = read_barcode_value(json_);
      } else if (name == "birth_cell") {
        once(born);
        if (!json_.accept_null()) read_cell(birth_);
      } else if (name == "death_cell") {
        once(died);
        if (!json_.accept_null()) read_cell(death_);
      } else if (name == "representative" && representatives_ != Representatives::none) {
        read_chain();
      } else if (name == "loops") {
        loops = read_loops();
      } else if (name == "p") {
        p = read_p();
      } else if (representatives_ == Representatives::voxels && name == "voxels") {
        read_runs();
      } else if (representatives_ == Representatives::voxels && name == "birth_voxel") {
        read_voxel(birth_voxel_);
      } else if (representatives_ == Representatives::voxels && name == "death_voxel") {
        if (!json_.accept_null()) read_voxel(death_voxel_);
      } else {
        skip(name);
      }
    });
    if (!dim || !birth || !death) {
      json_.fail(place, {"incomplete bar",
                         !dim     ? "no dim"
                         : !birth ? "no birth"
                                  : "no death",
                         "dim, birth and death",
                         {}});
    }
    if (const Fault fault = fault_of_bar(bar); !fault.what.empty()) json_.fail(place, fault);
    require_cells(place);
    check_loops(loops, place);
    input_.require_memory((birth_.size() + death_.size() + chain_.size()) * sizeof(Index));
    barcode_.add(bar, birth_, death_);
    if (representatives_ != Representatives::none)
      barcode_.set_representative(representatives_, chain_, coefficients_);
    if (representatives_ == Representatives::voxels)
      barcode_.set_voxels(store_runs(), birth_voxel_, death_voxel_);
    loop_bytes_ += bytes_of(std::span(&loops, 1));
    if (!loops.loops.empty() || !loops_.empty()) {
      loops_.resize(barcode_.size() - 1);
      loops_.push_back(std::move(loops));
    }
    if (!std::isnan(p) || !p_values_.empty()) {
      p_values_.resize(barcode_.size() - 1, std::nan(""));
      p_values_.push_back(p);
    }
    if (claim_) claim_->grow_to(barcode_.bytes() + loop_bytes_ + p_values_.size() * sizeof(double));
  }

  /// The first bar shows whether cells are known, and of which kind they are.
  void require_cells(std::size_t place) {
    if (barcode_.empty()) {
      barcode_ = Barcode(kind_);
      with_cells_ = !birth_.empty();
    }
    if (with_cells_ == birth_.empty() || (!with_cells_ && !death_.empty())) {
      json_.fail(place, {"birth cell",
                         birth_.empty() ? "none" : "one",
                         "one for each bar, or no cells at all",
                         {}});
    }
  }

  /// Refuses loops whose vertices cannot belong to the bar's cycle.
  void check_loops(const BarLoops& loops, std::size_t place) const {
    if (loops.loops.empty()) return;
    if (coefficients_.empty() || kind_ == CellKind::row)
      json_.fail(place, {"loops", "a bar without a cycle of edges", "loops next to a cycle", {}});
    const std::size_t numbers =
        kind_ == CellKind::grid ? chain_.size() / coefficients_.size() : std::size_t{1};
    for (const Loop& loop : loops.loops)
      if (loop.numbers.empty() || loop.numbers.size() % numbers != 0)
        json_.fail(place, {"loop",
                           fmt::format("{} numbers", loop.numbers.size()),
                           fmt::format("{} per vertex", numbers),
                           {}});
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
    bool known = false;
    json_.for_each_member([&](const std::string& name) {
      if (read_numbers(name, numbers, 0, place)) {
        known = true;
      } else {
        json_.skip_value();
      }
    });
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
      read_list(numbers, "number of a cell");
    }
    return true;
  }

  std::int64_t read_coefficient() {
    return json_.integer(-(std::int64_t{1} << 31), std::int64_t{1} << 31, "coefficient");
  }

  void read_chain() {
    json_.peek();
    const std::size_t place = json_.place();
    chain_.clear();
    coefficients_.clear();
    json_.for_each_element([&] {
      const std::size_t before = chain_.size();
      std::int64_t coefficient = 0;
      json_.for_each_member([&](const std::string& name) {
        if (name == "coefficient") {
          coefficient = read_coefficient();
        } else if (!read_numbers(name, chain_, before, place)) {
          json_.skip_value();
        }
      });
      coefficients_.push_back(coefficient);
      // All cells of a chain have equally many numbers.
      const std::size_t numbers = chain_.size() - before;
      if (numbers == 0 || chain_.size() != numbers * coefficients_.size() || coefficient == 0) {
        json_.fail(place, {"representative",
                           "cells of different sizes or without a coefficient",
                           "cells of one dimension, each with its coefficient",
                           {}});
      }
    });
  }

  BarLoops read_loops() {
    BarLoops read;
    json_.for_each_element([&] {
      json_.peek();
      const std::size_t place = json_.place();
      Loop loop;
      loop.coefficient = 0;
      json_.for_each_member([&](const std::string& name) {
        if (name == "coefficient") {
          loop.coefficient = read_coefficient();
        } else if (name == "length") {
          loop.length = read_barcode_value(json_);
        } else if (name == "tight") {
          read.tightness = read_tightness();
        } else if (name == "grid") {
          set_kind(CellKind::grid, place);
          json_.for_each_element([&] { read_list(loop.numbers, "coordinate"); });
        } else if (!read_numbers(name, loop.numbers, 0, place)) {
          json_.skip_value();
        }
      });
      if (loop.coefficient == 0)
        json_.fail(place, {"loop", "no coefficient", "a coefficient other than 0", {}});
      read.loops.push_back(std::move(loop));
    });
    return read;
  }

  Tightness read_tightness() {
    const std::size_t place = json_.place();
    const std::string value = json_.string();
    const auto known = value_named<Tightness>(value);
    if (!known) json_.fail(place, {"tight", printable(value, 40), "no, locally or shortest", {}});
    return *known;
  }

  double read_p() {
    json_.peek();
    const std::size_t place = json_.place();
    const double p = json_.number();
    if (!(p >= 0 && p <= 1))
      json_.fail(place, {"p-value", shortest(p), "a number from 0 to 1", {}});
    return p;
  }

  // Reads the coordinates of a voxel.
  void read_voxel(std::vector<Index>& voxel) {
    json_.peek();
    const std::size_t place = json_.place();
    voxel.clear();
    read_list(voxel, "coordinate of a voxel");
    if (shape_->empty()) return;  // files of older versions do not state it
    bool is_inside = voxel.size() == shape_->size();
    for (std::size_t axis = 0; is_inside && axis < voxel.size(); ++axis)
      is_inside = voxel[axis] < (*shape_)[axis];
    if (!is_inside)
      json_.fail(place,
                 {"voxel",
                  fmt::format("[{}]", fmt::join(voxel, ", ")),
                  fmt::format("a voxel of the image of {} voxels", fmt::join(*shape_, " x ")),
                  {}});
  }

  void read_list(std::vector<Index>& numbers, const char* what) {
    json_.for_each_element(
        [&] { numbers.push_back(json_.integer(0, std::numeric_limits<Index>::max(), what)); });
  }

  // Reads a set of voxels as runs [first, count], which ascend and do not meet.
  void read_runs() {
    constexpr std::int64_t kMostVoxels = std::int64_t{1} << 32;
    std::int64_t end = 0;
    runs_.clear();
    json_.for_each_element([&] {
      json_.peek();
      const std::size_t place = json_.place();
      run_.clear();
      read_list(run_, "place or number of voxels");
      if (run_.size() != 2 || run_[0] < end || run_[1] < 1 || run_[1] > kMostVoxels - run_[0])
        json_.fail(place, {"run of voxels",
                           fmt::format("[{}]", fmt::join(run_, ", ")),
                           "the place of the first voxel, after the runs before it, and a number "
                           "of voxels",
                           {}});
      end = run_[0] + run_[1];
      runs_.push_back({run_[0], end});
    });
  }

  VoxelRange store_runs() {
    std::size_t count = 0;
    for (const auto& [begin, end] : runs_) count += static_cast<std::size_t>(end - begin);
    // The array of all voxels may double, and its old and its new copy exist at the same time.
    input_.require_memory(2 * sizeof(std::uint32_t) * (voxel_count_ + count));
    VoxelRange range{voxel_count_, voxel_count_ + count};
    voxel_count_ = range.end;
    std::vector<std::uint32_t> places;
    for (const auto& [begin, end] : runs_)
      for (std::int64_t place = begin; place < end; ++place) {
        places.push_back(static_cast<std::uint32_t>(place));
        constexpr std::size_t kBlock = 4096;
        if (places.size() < kBlock && (place + 1 < end || &end != &runs_.back().end)) continue;
        barcode_.store_voxels(places);
        places.clear();
      }
    return range;
  }

  struct Run {
    std::int64_t begin, end;
  };

  const Input& input_;
  JsonCursor json_;
  std::optional<MemoryClaim> claim_;  // of the barcode and its loops
  std::size_t loop_bytes_ = 0;
  Barcode barcode_;
  Representatives representatives_ = Representatives::none;
  CellKind kind_ = CellKind::vertices;
  bool any_cell_ = false, with_cells_ = false;
  std::size_t count_ = 0;
  std::set<std::string> skipped_;
  std::vector<Index> birth_, death_, chain_, birth_voxel_, death_voxel_, run_;
  std::vector<std::int64_t> coefficients_;
  std::vector<Run> runs_;
  std::size_t voxel_count_ = 0;  // the number of all stored voxels
  const std::vector<Index>* shape_ = nullptr;
  std::vector<BarLoops> loops_;
  std::vector<double> p_values_;
};

}  // namespace

StoredBarcode read_barcode_json(const Input& input) { return Reader(input).read(); }

}  // namespace ph
