// SPDX-License-Identifier: MIT
#pragma once
#include <thrust/device_vector.h>
#include <thrust/execution_policy.h>
#include <thrust/system/cuda/error.h>
#include <thrust/system_error.h>

#include <cmath>
#include <cstdint>
#include <cuda/atomic>
#include <cuda/std/bit>

#include "ph/detail/metric/metric.hpp"

// Common definitions of the device code. This code is compiled without fused multiply-add
// (-fmad=false), so that a number is the same wherever it is computed.

namespace ph::gpu {

#define PH_DEVICE __host__ __device__ inline

inline constexpr std::uint32_t kNone = UINT32_MAX;

template <class T>
T* raw(thrust::device_vector<T>& v) {
  return thrust::raw_pointer_cast(v.data());
}

/// @throws thrust::system_error if CUDA has reported an error.
inline void check(cudaError_t error) {
  if (error != cudaSuccess) throw thrust::system_error(error, thrust::cuda_category());
}

template <class Body>
__global__ void call_body(std::uint32_t count, Body body) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < count) body(i);
}
/// Calls body(i) for all i < count, on the device. Work that is sent to the device later starts
/// only when all calls have finished.
template <class Body>
void for_each_index(std::uint32_t count, Body body) {
  constexpr std::uint32_t threads = 128;
  if (count == 0) return;
  call_body<<<count / threads + 1, threads>>>(count, body);
  check(cudaGetLastError());
}

template <class T>
PH_DEVICE T load(T& cell) {
  return cuda::atomic_ref<T, cuda::thread_scope_device>(cell).load(cuda::memory_order_relaxed);
}
template <class T>
PH_DEVICE void store(T& cell, T value) {
  cuda::atomic_ref<T, cuda::thread_scope_device>(cell).store(value, cuda::memory_order_relaxed);
}
/// Lowers a number to `value` unless the number is already smaller. The number is read first,
/// because most calls do not lower it and reading is cheap.
PH_DEVICE void lower(std::uint64_t& cell, std::uint64_t value) {
  if (value < load(cell))
    cuda::atomic_ref<std::uint64_t, cuda::thread_scope_device>(cell).fetch_min(
        value, cuda::memory_order_relaxed);
}

/// The bits of a double. Doubles that are not negative have the same order as their bits.
PH_DEVICE std::uint64_t bits_of(double x) { return cuda::std::bit_cast<std::uint64_t>(x); }
PH_DEVICE double of_bits(std::uint64_t bits) { return cuda::std::bit_cast<double>(bits); }

// These functions compute the same distances as PointMetric if no square of a coordinate overflows.

inline constexpr double kLeastPlainSquare = PointMetric::kLeastPlainSquare;

PH_DEVICE double square_of_distance(const double* x, const double* y, int axes) {
  double sum = 0;
  for (int k = 0; k < axes; ++k) sum += (x[k] - y[k]) * (x[k] - y[k]);
  return sum;
}
/// @param square the result of square_of_distance, which has lost digits if it is tiny.
PH_DEVICE double distance_of_square(double square, const double* x, const double* y, int axes) {
  if (square >= kLeastPlainSquare || square == 0) return std::sqrt(square);
  double largest = 0;
  for (int k = 0; k < axes; ++k) largest = std::fmax(largest, std::fabs(x[k] - y[k]));
  double sum = 0;
  for (int k = 0; k < axes; ++k) {
    const double t = (x[k] - y[k]) / largest;
    sum += t * t;
  }
  return largest * std::sqrt(sum);
}
/// An upper bound for the computed squares of all distances up to d, between two points or between
/// a point and a box.
PH_DEVICE double reach_of(double d, int axes) {
  return std::fmax(d * d * (1 + 4e-16 * (axes + 8)), kLeastPlainSquare);
}

/// The nearest point of another component, and its distance.
struct Nearest {
  double distance;
  std::uint32_t position;  ///< kNone if no such point lies within `distance`
};

}  // namespace ph::gpu
