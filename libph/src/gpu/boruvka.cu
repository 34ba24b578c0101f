// SPDX-License-Identifier: MIT
#include "libph/src/gpu/boruvka.cuh"

#include <thrust/copy.h>
#include <thrust/count.h>
#include <thrust/fill.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/sequence.h>

#include <limits>

namespace ph::gpu {
namespace {

/// Runs Borůvka's algorithm in the same way as on the CPU. Each point keeps its last answer, that
/// is, the nearest point of another component that it found. The answer stays valid while the two
/// points are in different components. After that, its distance is only a lower bound for the
/// distance to the nearest point of another component. Edges are ordered by (length, larger row,
/// smaller row). This is a total order, so components can choose their edges independently without
/// closing a cycle.
class Boruvka {
 public:
  Boruvka(Search& search, double limit, FlagEdge* edges, const RunContext& context)
      : search_(search),
        limit_(std::fmin(limit, std::numeric_limits<double>::max())),
        edges_(edges),
        context_(context),
        size_(search.size()),
        component_(size_),
        nearest_(size_, Nearest{-1, kNone}),
        bounds_(size_),
        ends_(size_),
        takes_(size_),
        joins_(size_) {
    thrust::sequence(thrust::device, component_.begin(), component_.end());
  }

  void run() {
    for (std::uint32_t before = size_; before > 1;) {
      context_.poll();
      context_.report({"spanning forest", size_ - before, size_});
      search_.see(view());
      propose();
      choose();
      join();
      const std::uint32_t after = component_count();
      if (after == before) return;
      before = after;
    }
  }

  BoruvkaView view() {
    return {raw(component_), raw(nearest_), raw(bounds_), raw(ends_), raw(takes_), raw(joins_)};
  }

  /// For each component, finds the length of the shortest edge that leaves it.
  void propose() {
    thrust::fill(thrust::device, bounds_.begin(), bounds_.end(), bits_of(limit_));
    const BoruvkaView v = view();
    for_each_index(size_, [=] __host__ __device__(std::uint32_t p) {
      if (v.knows(p)) lower(v.bounds[v.component[p]], bits_of(v.nearest[p].distance));
    });
    search_.bound_by_followers(v);
    const thrust::counting_iterator<std::uint32_t> first(0);
    asked_.resize(size_);
    const auto end =
        thrust::copy_if(thrust::device, first, first + size_, asked_.begin(),
                        [=] __host__ __device__(std::uint32_t p) { return v.is_worth_asking(p); });
    asked_.resize(static_cast<std::size_t>(end - asked_.begin()));
    search_.ask(asked_, v, context_);
  }

  /// For each component, chooses the first edge with the length found by `propose`.
  void choose() {
    thrust::fill(thrust::device, ends_.begin(), ends_.end(), UINT64_MAX);
    thrust::fill(thrust::device, takes_.begin(), takes_.end(), kNone);
    const BoruvkaView v = view();
    const std::uint32_t* const rows = search_.rows();
    for_each_index(size_, [=] __host__ __device__(std::uint32_t p) {
      if (v.has_best_length(p))
        lower(v.ends[v.component[p]], ends_of(rows[p], rows[v.nearest[p].position]));
    });
    for_each_index(size_, [=] __host__ __device__(std::uint32_t p) {
      const std::uint32_t own = v.component[p];
      if (v.has_best_length(p) && v.ends[own] == ends_of(rows[p], rows[v.nearest[p].position]))
        v.takes[own] = p;
    });
  }

  void join() {
    const BoruvkaView v = view();
    const std::uint32_t* const rows = search_.rows();
    FlagEdge* const edges = edges_;
    const auto other = [=] __host__ __device__(std::uint32_t c) {
      return v.takes[c] == kNone ? c : v.component[v.nearest[v.takes[c]].position];
    };
    for_each_index(size_, [=] __host__ __device__(std::uint32_t c) {
      if (v.component[c] != c) return;
      const std::uint32_t o = other(c);
      // Two components that choose each other choose the same edge.
      v.joins[c] = other(o) == c && c < o ? c : o;
      if (v.joins[c] == c) return;
      const std::uint64_t ends = v.ends[c];
      edges[rows[c]] = {of_bits(v.bounds[c]), static_cast<std::uint32_t>(ends >> 32),
                        static_cast<std::uint32_t>(ends)};
    });
    // Each step doubles the length of the jumps towards the root.
    const auto jumps = [=] __host__ __device__(std::uint32_t c) {
      if (v.component[c] != c) return false;
      const std::uint32_t next = load(v.joins[c]), after = load(v.joins[next]);
      store(v.joins[c], after);
      return next != after;
    };
    const thrust::counting_iterator<std::uint32_t> first(0);
    while (thrust::count_if(thrust::device, first, first + size_, jumps) > 0) context_.poll();
    for_each_index(size_, [=] __host__ __device__(std::uint32_t p) {
      v.component[p] = v.joins[v.component[p]];
    });
  }

  std::uint32_t component_count() {
    const BoruvkaView v = view();
    const thrust::counting_iterator<std::uint32_t> first(0);
    return static_cast<std::uint32_t>(
        thrust::count_if(thrust::device, first, first + size_,
                         [=] __host__ __device__(std::uint32_t p) { return v.component[p] == p; }));
  }

 private:
  Search& search_;
  const double limit_;
  FlagEdge* const edges_;
  const RunContext& context_;
  const std::uint32_t size_;
  Positions component_;
  thrust::device_vector<Nearest> nearest_;
  thrust::device_vector<std::uint64_t> bounds_, ends_;
  Positions takes_, joins_, asked_;
};

}  // namespace

void find_forest(Search& search, double limit, FlagEdge* edges, const RunContext& context) {
  Boruvka(search, limit, edges, context).run();
}

}  // namespace ph::gpu
