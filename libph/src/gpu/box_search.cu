// SPDX-License-Identifier: MIT
#include <thrust/copy.h>
#include <thrust/functional.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/scan.h>
#include <thrust/sequence.h>
#include <thrust/sort.h>

#include "libph/src/gpu/boruvka.cuh"
#include "libph/src/gpu/linear_bvh.cuh"

namespace ph::gpu {
namespace {

/// Sorts rows by a key. Rows with equal keys keep their order.
template <class Key, class KeyOf>
void sort_rows(Positions& rows, KeyOf key_of) {
  thrust::device_vector<Key> keys(rows.size());
  const auto key = raw(keys);
  const auto row = raw(rows);
  for_each_index(static_cast<std::uint32_t>(rows.size()),
                 [=] __host__ __device__(std::uint32_t i) { key[i] = key_of(row[i]); });
  thrust::stable_sort_by_key(thrust::device, keys.begin(), keys.end(), rows.begin());
}

/// The rows in the order of a space-filling curve. Equal points are side by side, in the order of
/// their rows.
template <int Axes>
Positions order_of(const double* x, std::uint32_t size, const Curve& curve) {
  Positions rows(size);
  thrust::sequence(thrust::device, rows.begin(), rows.end());
  for (int k = Axes - 1; k >= 0; --k)
    sort_rows<double>(rows, [=] __host__ __device__(std::uint32_t row) {
      return x[std::size_t{row} * Axes + k] + 0.0;  // the sum turns -0 into 0
    });
  sort_rows<std::uint64_t>(rows, [=] __host__ __device__(std::uint32_t row) {
    return curve.code<Axes>(x + std::size_t{row} * Axes).low;
  });
  sort_rows<std::uint64_t>(rows, [=] __host__ __device__(std::uint32_t row) {
    return curve.code<Axes>(x + std::size_t{row} * Axes).high;
  });
  return rows;
}

template <int Axes>
class BvhSearch final : public Search {
 public:
  /// @param x the coordinates by row. @param rows the rows of at least two points, all distinct, in
  /// the order of the curve.
  BvhSearch(const double* x, Positions&& rows, const Curve& curve)
      : rows_(std::move(rows)),
        coordinates_(rows_.size() * Axes),
        nodes_(rows_.size() - 1),
        boxes_((rows_.size() - 1) * 2 * Axes),
        labels_(rows_.size() - 1, BvhView<Axes>::kMixed),
        changes_(rows_.size()) {
    build(x, curve);
  }

  std::uint32_t size() const override { return static_cast<std::uint32_t>(rows_.size()); }
  const std::uint32_t* rows() const override { return thrust::raw_pointer_cast(rows_.data()); }
  BvhView<Axes> view() {
    return {size(), raw(coordinates_), raw(rows_), raw(nodes_), raw(boxes_), raw(labels_)};
  }

  void build(const double* x, const Curve& curve) {
    const BvhView<Axes> tree = view();
    thrust::device_vector<Code> codes(size());
    const auto coordinates = raw(coordinates_);
    const auto code = raw(codes);
    for_each_index(size(), [=] __host__ __device__(std::uint32_t p) {
      const double* const from = x + std::size_t{tree.rows[p]} * Axes;
      for (int k = 0; k < Axes; ++k) coordinates[std::size_t{p} * Axes + k] = from[k];
      code[p] = curve.code<Axes>(from);
    });
    Positions parents_of_nodes(size() - 1), parents_of_leaves(size());
    const auto parent_of_node = raw(parents_of_nodes), parent_of_leaf = raw(parents_of_leaves);
    for_each_index(size() - 1, [=] __host__ __device__(std::uint32_t i) {
      const auto node = tree.node_at(code, i);
      tree.nodes[i] = node;
      (node.first(i) == node.split ? parent_of_leaf : parent_of_node)[node.split] = i;
      (node.last(i) == node.split + 1 ? parent_of_leaf : parent_of_node)[node.split + 1] = i;
    });
    // When the second thread reaches a node, the boxes of both children are ready.
    Positions arrivals(size() - 1, 0);
    const auto arrival = raw(arrivals);
    for_each_index(size(), [=] __host__ __device__(std::uint32_t p) {
      for (std::uint32_t node = parent_of_leaf[p];; node = parent_of_node[node]) {
        cuda::atomic_ref<std::uint32_t, cuda::thread_scope_device> count(arrival[node]);
        if (count.fetch_add(1, cuda::memory_order_acq_rel) == 0) return;
        tree.join_boxes(node);
        if (node == 0) return;
      }
    });
  }

  /// Labels each node with its component if all its points belong to one component.
  void see(const BoruvkaView& v) override {
    const auto change = raw(changes_);
    for_each_index(size(), [=] __host__ __device__(std::uint32_t p) {
      change[p] = p > 0 && v.component[p] != v.component[p - 1] ? 1 : 0;
    });
    thrust::inclusive_scan(thrust::device, changes_.begin(), changes_.end(), changes_.begin());
    const BvhView<Axes> tree = view();
    for_each_index(size() - 1, [=] __host__ __device__(std::uint32_t i) {
      const auto node = tree.nodes[i];
      const std::uint32_t first = node.first(i), last = node.last(i);
      tree.labels[i] = change[first] == change[last] ? v.component[first] : BvhView<Axes>::kMixed;
    });
  }

  void bound_by_followers(const BoruvkaView& v) override {
    const BvhView<Axes> tree = view();
    for_each_index(size() - 1, [=] __host__ __device__(std::uint32_t p) {
      if (v.component[p] != v.component[p + 1]) v.bound(p, p + 1, tree.distance(p, p + 1));
    });
  }

  void ask(Positions& asked, const BoruvkaView& v, const RunContext&) override {
    const BvhView<Axes> tree = view();
    const std::uint32_t* const ask = raw(asked);
    for_each_index(static_cast<std::uint32_t>(asked.size()),
                   [=] __host__ __device__(std::uint32_t i) {
                     const std::uint32_t p = ask[i];
                     const double within = of_bits(load(v.bounds[v.component[p]]));
                     if (v.nearest[p].distance <= within)
                       v.answer(p, tree.nearest_foreign(p, v.component, within));
                   });
  }

 private:
  Positions rows_;
  thrust::device_vector<double> coordinates_;
  thrust::device_vector<typename BvhView<Axes>::Node> nodes_;
  thrust::device_vector<double> boxes_;
  Positions labels_, changes_;
};

/// Joins each copy of a point to the first copy. @return the rows of the distinct points, in the
/// order of `rows`. @param rows has equal points side by side, in the order of their rows.
Positions join_copies(const double* x, int axes, Positions& rows, FlagEdge* edges) {
  const auto size = static_cast<std::uint32_t>(rows.size());
  Positions heads(size), distinct(size);
  const auto head = raw(heads), row = raw(rows);
  for_each_index(size, [=] __host__ __device__(std::uint32_t i) {
    bool is_copy = i > 0;
    for (int k = 0; is_copy && k < axes; ++k)
      is_copy = x[std::size_t{row[i]} * axes + k] == x[std::size_t{row[i - 1]} * axes + k];
    head[i] = is_copy ? 0 : i;
  });
  thrust::inclusive_scan(thrust::device, heads.begin(), heads.end(), heads.begin(),
                         thrust::maximum<std::uint32_t>());
  for_each_index(size, [=] __host__ __device__(std::uint32_t i) {
    if (head[i] != i) edges[row[i]] = {0.0, row[i], row[head[i]]};
  });
  const thrust::counting_iterator<std::uint32_t> first(0);
  const auto end =
      thrust::copy_if(thrust::device, rows.begin(), rows.end(), first, distinct.begin(),
                      [=] __host__ __device__(std::uint32_t i) { return head[i] == i; });
  distinct.resize(static_cast<std::size_t>(end - distinct.begin()));
  return distinct;
}

template <int Axes>
std::unique_ptr<Search> search_of(const double* x, std::uint32_t size, std::span<const double> box,
                                  FlagEdge* edges) {
  const Curve curve = Curve::of<Axes>(box);
  Positions rows = order_of<Axes>(x, size, curve);
  Positions distinct = join_copies(x, Axes, rows, edges);
  rows = Positions();
  if (distinct.size() < 2) return nullptr;
  return std::make_unique<BvhSearch<Axes>>(x, std::move(distinct), curve);
}

}  // namespace

std::unique_ptr<Search> search_by_boxes(const double* x, std::uint32_t size, int axes,
                                        std::span<const double> box, FlagEdge* edges) {
  using Make =
      std::unique_ptr<Search>(const double*, std::uint32_t, std::span<const double>, FlagEdge*);
  static constexpr Make* make[] = {search_of<1>, search_of<2>, search_of<3>, search_of<4>,
                                   search_of<5>, search_of<6>, search_of<7>, search_of<8>};
  return make[axes - 1](x, size, box, edges);
}

}  // namespace ph::gpu
