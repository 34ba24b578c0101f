// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "libph/src/rips/beta_skeleton/pair_points.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/filtration.hpp"
#include "ph/rips.hpp"

namespace ph {

/// Computes H0 and H1 of the Vietoris-Rips filtration of points with few coordinates. It uses only
/// the points, without a list of edges (see pair_points.hpp).
struct BetaSkeletonEngine {
  static constexpr Engine id = Engine::beta_skeleton;
  static constexpr std::array rips_forms{RipsForm::points};
  /// A condition that the points or the task do not meet. The text is empty if they meet all
  /// conditions.
  static std::string_view obstacle(const RipsInput& input, const Task& task);
  static Suitability suitability(const RipsInput& input, const Task& task);
  template <Filtration F>
  static bool can_run(const F& f, const Task& task) {
    if constexpr (requires { f.points_alone(); })
      return f.points_alone() && obstacle(task).empty();
    else
      return false;
  }
  template <Filtration F>
  static Suitability suitability(const F&, const Task&) {
    return kSuits;
  }
  static constexpr int listed_dim(int) { return -1; }
  static constexpr bool goes_by_edges = true;
  static constexpr bool stops_early = true;

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context) {
    if constexpr (requires { f.points_alone(); }) {
      Reporter<F> reporter(f, bars);
      pair_points(
          *f.points_alone(), field,
          {.threshold = f.threshold(), .loops = bars.max_dim() > 0, .apexes = bars.wants_cells()},
          reporter, context);
    }
  }

 private:
  static constexpr Suitability kSuits{5, "H0 and H1 of points of few coordinates need no edges"};
  static std::string_view obstacle(const Task& task);

  /// Turns pairs of points into bars.
  template <class F>
  class Reporter final : public PointPairObserver {
   public:
    Reporter(const F& f, BarcodeBuilder<F>& bars) : f_(f), bars_(bars) {}

    void on_join(Vertex younger, const Edge& edge) override {
      add({0, 0, edge.value}, std::array{younger}, std::array{edge.smaller, edge.larger});
    }
    void on_component(Vertex oldest) override {
      add({0, 0, kInfinity}, std::array{oldest}, std::array<Vertex, 0>{});
    }
    void on_death(const Edge& birth, const Edge& death, Vertex apex) override {
      std::array triangle{death.smaller, death.larger, apex};
      std::sort(triangle.begin(), triangle.end());
      add({1, birth.value, death.value}, std::array{birth.smaller, birth.larger}, triangle);
    }
    void on_essential(const Edge& birth) override {
      add({1, birth.value, kInfinity}, std::array{birth.smaller, birth.larger},
          std::array<Vertex, 0>{});
    }

   private:
    template <class Birth, class Death>
    void add(const Bar& bar, const Birth& birth, const Death& death) {
      birth_.clear();
      death_.clear();
      if (bars_.wants_cells()) {
        append(birth, birth_);
        append(death, death_);
      }
      bars_.add_bar(bar, birth_, death_);
    }
    template <class Vertices>
    void append(const Vertices& vertices, std::vector<Index>& cell) const {
      for (const Vertex v : vertices) f_.append_input_cell(0, f_.vertex_cell(v), cell);
    }

    const F& f_;
    BarcodeBuilder<F>& bars_;
    std::vector<Index> birth_, death_;  // scratch
  };
};

}  // namespace ph
