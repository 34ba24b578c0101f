// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

namespace ph::alpha {

/// A point or vector of R³.
template <class T>
struct Vector {
  T x, y, z;

  friend bool operator==(const Vector&, const Vector&) = default;
  friend Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector operator*(const T& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// True if `a` comes first in the order of the coordinates, x first. No translation changes this
/// order.
inline bool lexicographically_before(const Vector<double>& a, const Vector<double>& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

}  // namespace ph::alpha
