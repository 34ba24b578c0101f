// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <vector>

#include "libph/src/rips/edge_link_sweep.hpp"
#include "ph/detail/components/component_representatives.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// Computes H0 to H3 of Vietoris-Rips filtrations by the sweep of edge links (see
/// edge_link_sweep.hpp). The engine stores the living classes, and stores the graph as n^2 bits or
/// as lists. It stores no columns of triangles or tetrahedra.
struct EdgeLinkEngine {
  static constexpr Engine id = Engine::edge_links;
  template <Filtration F>
  static bool can_run(const F& f, const Task& task) {
    if constexpr (FlagFiltration<F>)
      return task.wants_no_sets() &&
             (task.max_dim < 2 ||
              (task.max_dim == 2 && task.representatives != Representatives::cycles &&
               f.vertex_count() <= kMostVerticesOfSurfaces) ||
              (task.max_dim == 3 && task.representatives == Representatives::none &&
               !task.zero_length && f.vertex_count() <= kMostVerticesOfVolumes));
    else
      return false;
  }
  template <Filtration F>
  static Suitability suitability(const F&, const Task&) {
    return {4, "H1 to H3 of a Rips complex need no triangles"};
  }
  static constexpr int listed_dim(int) { return 1; }
  static constexpr bool goes_by_edges = true;
  /// The sweep stops once nothing more can happen, usually before its lists are full.
  static constexpr bool stops_early = true;
  static double rips_bytes(std::size_t vertices, std::size_t edges) {
    return LinkGraph::bytes(vertices, edges);
  }

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context,
                  const SweepTuning& tuning = {}) {
    if constexpr (FlagFiltration<F>) {
      Reporter<F, K> reporter(f, field, bars, context);
      const SweepRequest wanted{.surfaces = bars.max_dim() >= 2,
                                .volumes = bars.max_dim() >= 3,
                                .cycles = bars.representatives() == Representatives::cycles,
                                .cocycles = bars.representatives() == Representatives::cocycles,
                                .zero_length = bars.wants_zero_length(),
                                .tuning = tuning};
      EdgeLinkSweep<K>(f.vertex_count(), f.vertex_births(), f.binned_edges(), field, wanted,
                       reporter, context)
          .run();
      reporter.report_components();
    }
  }

 private:
  static constexpr std::size_t kMostVerticesOfSurfaces = TriangleCochain<Z2>::kMostVertices;
  static constexpr std::size_t kMostVerticesOfVolumes = TetrahedronCochain<Z2>::kMostVertices;

  /// Turns the events of the sweep into bars.
  template <class F, Field K>
  class Reporter final : public SweepObserver<K> {
   public:
    using Observer = SweepObserver<K>;
    using Vertex = typename Observer::Vertex;
    using Position = typename Observer::Position;
    using Triangle = typename Observer::Triangle;
    using Tetrahedron = typename Observer::Tetrahedron;
    using Pentachoron = typename Observer::Pentachoron;
    using EdgeValues = std::span<const typename Observer::EdgeValue>;
    using TriangleValues = std::span<const typename Observer::TriangleValue>;

    Reporter(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context)
        : f_(f),
          field_(field),
          bars_(bars),
          is_dead_(f.vertex_count(), false, &context.memory),
          components_(is_dead_.size(), field, bars, &context.memory),
          terms_(&context.memory) {}

    void on_join(Vertex elder, Vertex younger, Position edge) override {
      is_dead_[younger] = true;
      if (bars_.add_pair(0, f_.vertex_cell(younger), f_.edge_cell(edge)))
        components_.give(younger, elder, cell_of_vertex());
      components_.join(elder, younger);
    }
    Position position_of(Vertex u, Vertex v) const override { return f_.edge_position(u, v); }
    void on_death(Position birth, Triangle death, EdgeValues representative) override {
      if (bars_.add_pair(1, f_.edge_cell(birth), f_.triangle_cell(death.edge, death.apex)))
        give(representative);
    }
    void on_death(Triangle birth, Tetrahedron death, TriangleValues cocycle) override {
      if (bars_.add_pair(2, f_.triangle_cell(birth.edge, birth.apex), cell_of(death)))
        give(cocycle);
    }
    void on_death(Tetrahedron birth, Pentachoron death) override {
      bars_.add_pair(3, cell_of(birth), f_.pentachoron_cell(death.edge, death.others));
    }
    void on_essential(Position birth, EdgeValues representative) override {
      if (bars_.add_essential(1, f_.edge_cell(birth))) give(representative);
    }
    void on_essential(Triangle birth, TriangleValues cocycle) override {
      if (bars_.add_essential(2, f_.triangle_cell(birth.edge, birth.apex))) give(cocycle);
    }
    void on_essential(Tetrahedron birth) override { bars_.add_essential(3, cell_of(birth)); }

    void report_components() {
      for (Vertex v = 0; v < is_dead_.size(); ++v)
        if (!is_dead_[v] && bars_.add_essential(0, f_.vertex_cell(v)))
          components_.give(v, std::nullopt, cell_of_vertex());
    }

   private:
    auto cell_of_vertex() const {
      return [this](Vertex v) { return f_.vertex_cell(v); };
    }
    auto cell_of(const Tetrahedron& t) const {
      return f_.tetrahedron_cell(t.edge, t.larger, t.smaller);
    }
    void give(EdgeValues representative) {
      if (bars_.representatives() == Representatives::none) return;
      terms_.clear();
      for (const auto& [edge, value] : representative)
        terms_.emplace_back(f_.edge_cell(edge), value);
      bars_.add_representative(1, terms_, field_);
    }
    void give(TriangleValues cocycle) {
      if (bars_.representatives() == Representatives::none) return;
      terms_.clear();
      for (const auto& [v, value] : cocycle)
        terms_.emplace_back(f_.triangle_cell_of(v[0], v[1], v[2]), value);
      bars_.add_representative(2, terms_, field_);
    }

    const F& f_;
    const K& field_;
    BarcodeBuilder<F>& bars_;
    std::pmr::vector<bool> is_dead_;
    ComponentRepresentatives<F, K> components_;
    std::pmr::vector<Entry<typename F::Cell, K>> terms_;
  };
};

}  // namespace ph
