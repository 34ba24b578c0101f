// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/cubical/sinks/pair_sink.hpp"
#include "libph/src/cubical/slabs/slabs.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::cubical {

/// The same as pair_voxels for a grid that is processed one slab at a time. Memory: eight bytes per
/// voxel of a slab, its critical cells, and 16 to 40 bytes per voxel of a layer. Loops of three
/// axes also need the critical squares and edges that pair with no cube and no voxel, and a
/// temporary file of four bytes per voxel. Precondition: no bars are wanted that come from neither
/// graph, or there are three axes and all voxels fit a GridFrame.
/// @throws Error (resource) if loops do not fit, after all other bars were passed on; Error (io)
///         without room for the file.
template <Field K>
void pair_in_slabs(Slabs& slabs, const K& field, const BarRequest& wanted,
                   const RunContext& context, PairSink& pairs);

extern template void pair_in_slabs(Slabs&, const Z2&, const BarRequest&, const RunContext&,
                                   PairSink&);
extern template void pair_in_slabs(Slabs&, const Zp&, const BarRequest&, const RunContext&,
                                   PairSink&);

}  // namespace ph::cubical
