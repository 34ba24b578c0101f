// SPDX-License-Identifier: MIT
#pragma once
#include "ph/barcode.hpp"
#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"

namespace ph {

/// Writes bars with their cells, in their order.
void put_bars(ByteWriter& to, const Barcode& bars);
/// Reads bars and adds them to `bars`. @throws Error (bad_data).
void get_bars(ByteReader& from, Barcode& bars);
/// Adds the bars of another barcode, including cells.
void add_bars(Barcode& to, const Barcode& bars);

}  // namespace ph
