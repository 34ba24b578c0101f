# SPDX-License-Identifier: MIT
"""Faults in reading and writing the files of other programs; see program_mutants.py."""
from mutant import found_by

MUTANTS = [
    *found_by("io_write_tests", [
        ("bars: a column may be there twice", "bars-column-twice", ""),
        ("bars: any column without a name is an index", "bars-index", "&& columns.roles.empty()", ""),
        ("bars: one cell too many is an index", "bars-cell-too-many", "lines.line().starts_with('\"') &&", ""),
        ("bars with voxels: -inf is a number", "bars-infinite", "std::abs(stored)", "stored"),
    ]),
    *found_by("segment_test", [
        ("clouds: single precision reaches twice as far", "cloud-single", ">", "> 2 *"),
        ("clouds: one of three normals gets the other name", "cloud-normals", "!has(cloud_, from) ||", ""),
        ("clouds: padding is a field", "cloud-padding", '"_"', '"__"'),
        ("clouds: colours are opaque", "cloud-opacity", "alpha(point)", "(0 * alpha(point) + 255)"),
    ]),
    *found_by("io_read_tests", [
        ("PCD: zeros without end are padding", "pcd-padding", ">=", ">= 999 *"),
        ("camera: coefficients beyond the model are left out", "camera-coefficients", "&& d.back() == 0", ""),
    ]),
    *found_by("ph_vectorise_fits", [
        ("Euler curves: one change is none", "euler-change", "kInfinity", "curve.at[k]"),
    ], targets=["ph-vectorise"]),
    *found_by("faults_corpus", [
        ("outputs: only lower case is a packed file", "output-packed", "ends_in(path,", "path.ends_with("),
    ], targets=["ph-barcode", "ph-segment", "ph-distance", "ph-vectorise", "peak"]),
    *found_by("segment_program_test", [
        ("frames: a list that fails has ended", "frame-list-error", "EAGAIN", "EAGAIN && errno != EBADF"),
        ("frames: the last name needs a line end", "frame-list-last", "return std::nullopt;"),
    ]),
    *found_by("program_descriptors", [
        ("outputs: any descriptor is the caller's", "output-descriptor", "return flags >= 0;"),
        ("outputs: the log behind standard output is replaced", "output-log", "kStandardOutput, files::", ""),
        ("outputs: pipes are never the same", "output-pipes", "mixed", "lost"),
    ], targets=["ph-barcode", "ph-segment", "ph-distance", "ph-vectorise"]),
    *found_by("program_overwrites", [
        ("clusters: labels replace the points", "cluster-inputs", "inputs.add(a.input(), a.format)",
         "static_cast<void>(a)"),
    ], targets=["ph-barcode", "ph-segment", "ph-cluster"]),
    *found_by("ph_cluster_inputs", [
        ("clusters: points that were left out have no rows", "cluster-rows", "dropped.size()", "0 * dropped.size()"),
        ("clusters: the core distance is that of the nearest point", "cluster-core", "*last", "of_point[i].front()"),
    ], targets=["ph-cluster"]),
    *found_by("ph_barcode_faults", [
        ("outputs: bits that set an ID are kept", "output-mode", "0777", "07777"),
    ], targets=["ph-barcode"]),
    *found_by("ph_barcode_stored", [
        ("JSON of bars: all axes close up", "json-periodic", "if (image.periodic[axis])", ""),
        ("JSON of bars: joined parts left nothing out", "json-min-persistence", ""),
    ], targets=["ph-barcode"]),
]
