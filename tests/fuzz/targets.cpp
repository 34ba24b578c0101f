// SPDX-License-Identifier: MIT
#include "tests/fuzz/targets.hpp"

#include <algorithm>

#include "tests/fuzz/readers.hpp"

namespace ph::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = [] {
    std::vector<Target> list;
    for (const NamedReader& reader : readers()) {
      list.push_back({std::string(reader.name),
                      [name = reader.name](std::string_view bytes) { run_reader(name, bytes); }});
    }
    list.push_back({"gzip", &run_gzip});
    list.push_back({"png_chunks", &run_png});
    list.push_back({"tree_sums", &run_tree});
    list.push_back({"barcode_arguments", &run_barcode_arguments});
    list.push_back({"cluster_arguments", &run_cluster_arguments});
    list.push_back({"distance_arguments", &run_distance_arguments});
    list.push_back({"distance_groups", &run_distance_groups});
    list.push_back({"segment_arguments", &run_segment_arguments});
    list.push_back({"vectorise_arguments", &run_vectorise_arguments});
    list.push_back({"vectorise_fit", &run_vectorise_fit});
    list.push_back({"image_part", &run_image_part});
    list.push_back({"cloud_part", &run_cloud_part});
    list.push_back({"inputs_part", &run_inputs_part});
    list.push_back({"engines", &run_engines});
    list.push_back({"diagrams", &run_diagrams});
    list.push_back({"report", &run_report});
#ifdef PH_FUZZ_C
    list.push_back({"c", &run_c});
#endif
#ifdef PH_FUZZ_ALPHA
    list.push_back({"alpha", &run_alpha});
    list.push_back({"alpha_signs", &run_alpha_signs});
#endif
    return list;
  }();
  return all;
}

const Target* find_target(std::string_view name) {
  const auto found = std::find_if(targets().begin(), targets().end(),
                                  [name](const Target& target) { return target.name == name; });
  return found == targets().end() ? nullptr : &*found;
}

}  // namespace ph::fuzz
