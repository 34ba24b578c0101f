// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/cubical/sinks/pair_sink.hpp"
#include "libph/src/cubical/slabs/slabs.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::cubical {

/// Does the same as pair_voxels, but processes the grid slab by slab. Memory: eight bytes per voxel
/// of a slab, the critical cells of a slab, and 16 to 40 bytes per voxel of a layer. With three
/// axes, loops also need memory for the critical squares that are not paired with a cube and the
/// critical edges that are not paired with a voxel. They also need a temporary file of four bytes
/// per voxel. Precondition: all wanted bars come from the two graphs, or there are three axes and a
/// GridFrame can hold all voxels.
/// @throws Error (resource) if there is too little memory for loops, after all other bars have been
/// passed on; Error (io) if there is no room for the file.
template <Field K>
void pair_in_slabs(Slabs& slabs, const K& field, const BarRequest& wanted,
                   const RunContext& context, PairSink& pairs);

extern template void pair_in_slabs(Slabs&, const Z2&, const BarRequest&, const RunContext&,
                                   PairSink&);
extern template void pair_in_slabs(Slabs&, const Zp&, const BarRequest&, const RunContext&,
                                   PairSink&);

}  // namespace ph::cubical
