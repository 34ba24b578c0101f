// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "arguments.hpp"

namespace ph::barcode {

/// A complex with what the user is told about it.
struct BuiltComplex {
  AnyComplex complex;
  std::string name;                 ///< "rips", "cubical", "explicit", "lower-star"
  std::optional<double> threshold;  ///< that its values obey; nothing: all are there
  bool empty = false;               ///< there are no points or cells at all
  /// A threshold that has to be applied to the bars, because the complex holds larger values too.
  std::optional<double> cut;
};

/// Builds the complex that the arguments ask for, or the one that suits the data.
/// @param name of the input, for messages.
/// @throws Error (usage) if an option does not fit the data; Error (bad_data) "name: …".
BuiltComplex build_complex(ReadResult&& input, const std::string& name, const Arguments& arguments,
                           const RunContext& context);
/// The same from data that are needed again.
BuiltComplex build_complex(const ReadResult& input, const std::string& name,
                           const Arguments& arguments, const RunContext& context);

}  // namespace ph::barcode
