// SPDX-License-Identifier: MIT
#pragma once
#include "core/bytes/byte_reader.hpp"
#include "core/bytes/byte_writer.hpp"
#include "ph/barcode.hpp"

namespace ph {

/// Writes bars with their cells, in their order.
void put_bars(ByteWriter& to, const Barcode& bars);
/// Reads bars and adds them to others. @throws Error (bad_data).
void get_bars(ByteReader& from, Barcode& bars);
/// Adds the bars of another barcode, including cells.
void add_bars(Barcode& to, const Barcode& bars);

}  // namespace ph
