// SPDX-License-Identifier: MIT
#pragma once
#include "ph/barcode.hpp"

namespace ph {

/// A class of H0 as a branch of the merge tree: from its birth to the value at which it joins the
/// branch of an elder class.
struct Branch {
  double birth = 0;
  double death = kInfinity;
  /// Position of the elder branch in the list of branches; -1 if this class never dies.
  Index elder = -1;

  bool is_infinite() const { return elder < 0; }
  double persistence() const { return birth == death ? 0 : death - birth; }
  friend bool operator==(const Branch&, const Branch&) = default;
};

}  // namespace ph
