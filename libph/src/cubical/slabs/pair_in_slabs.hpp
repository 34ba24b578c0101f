// SPDX-License-Identifier: MIT
#pragma once
#include "cubical/pair_sink.hpp"
#include "cubical/slabs/slabs.hpp"

namespace ph::cubical {

/// As pair_voxels, of a grid of which a slab is seen at a time. Memory: eight bytes a voxel of a
/// slab and what its critical cells take, 16 to 40 bytes a voxel of a layer, and for loops of three
/// axes what the critical squares and edges take that pair with no cube and no voxel; for these
/// also a temporary file of four bytes a voxel. Precondition: no bars are wanted that come from
/// neither graph, or there are three axes and all voxels fit a GridFrame.
/// @throws Error (resource) if loops do not fit, after all other bars were handed over; Error (io)
///         without room for the file.
template <Field K>
void pair_in_slabs(Slabs& slabs, const K& field, const BarRequest& wanted,
                   const RunContext& context, PairSink& pairs);

extern template void pair_in_slabs(Slabs&, const Z2&, const BarRequest&, const RunContext&,
                                   PairSink&);
extern template void pair_in_slabs(Slabs&, const Zp&, const BarRequest&, const RunContext&,
                                   PairSink&);

}  // namespace ph::cubical
