// SPDX-License-Identifier: MIT
#include "python/src/scenes/scene_state.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "ph/detail/segment/tree_barcode.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/results/state.hpp"

namespace ph::python {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Field = std::tuple<std::string, int, std::size_t, std::size_t>;

constexpr const char* kThing = "a segmentation";

py::dict state_of_cloud(const Cloud& cloud) {
  std::vector<Field> fields;
  for (const CloudField& f : cloud.fields)
    fields.emplace_back(f.name, static_cast<int>(f.type), f.count, f.offset);
  py::dict state;
  state["width"] = cloud.width;
  state["height"] = cloud.height;
  state["viewpoint"] = cloud.viewpoint;
  state["fields"] = fields;
  state["stride"] = cloud.stride;
  state["data"] = Block::copy_of(
      Bytes(reinterpret_cast<const std::uint8_t*>(cloud.data.data()), cloud.data.size()));
  return state;
}

/// Makes a cloud with all members except the data of the points.
Cloud cloud_of_state(const py::dict& state) {
  Cloud cloud;
  cloud.width = state["width"].cast<Index>();
  cloud.height = state["height"].cast<Index>();
  cloud.viewpoint = state["viewpoint"].cast<std::array<double, 7>>();
  cloud.stride = state["stride"].cast<std::size_t>();
  for (const auto& [name, type, count, offset] : state["fields"].cast<std::vector<Field>>()) {
    if (type < 0 || type > static_cast<int>(FieldType::float64))
      throw py::value_error("type of a field");
    cloud.fields.push_back({name, static_cast<FieldType>(type), count, offset});
  }
  return cloud;
}

/// The content of a state. The arrays live as long as this object.
struct Members {
  py::buffer_info tree_array, data_array;
  Bytes tree, data;  // the bytes of these arrays
  std::shared_ptr<SceneCloud> cloud;
  bool is_checked = false;
  std::string plane_note;

  explicit Members(const py::dict& state)
      : tree_array(state["tree"].cast<py::buffer>().request()),
        tree(numbers_of<std::uint8_t>(tree_array)),
        is_checked(state["checked"].cast<bool>()),
        plane_note(state["plane_note"].cast<std::string>()) {
    if (!py::isinstance<py::str>(state["plane_note"])) throw py::type_error("bytes as a note");
    const auto of_cloud = state["cloud"].cast<std::optional<py::dict>>();
    if (!of_cloud) return;
    cloud = std::make_shared<SceneCloud>();
    cloud->cloud = cloud_of_state(*of_cloud);
    data_array = (*of_cloud)["data"].cast<py::buffer>().request();
    data = numbers_of<std::uint8_t>(data_array);
  }
};

}  // namespace

Block tree_file(const SegmentedScene& scene) {
  const std::string tree = segment::tree_bytes(scene.result.tree);
  return Block::copy_of(Bytes(reinterpret_cast<const std::uint8_t*>(tree.data()), tree.size()));
}

py::dict state_of(const SegmentedScene& scene) {
  py::dict state;
  state["tree"] = tree_file(scene);
  state["cloud"] = scene.cloud() ? py::object(state_of_cloud(*scene.cloud())) : py::none();
  state["checked"] = scene.result.checked;
  state["plane_note"] = scene.result.plane_note;
  return state;
}

SegmentedScene scene_of_state(const py::dict& state, const RunOptions& options) {
  const Members members = of_state(kThing, [&] { return Members(state); });
  SegmentedScene scene;
  run_task(options, false, [&](const SharedContext& context) {
    if (members.cloud) {
      context->memory.require(members.data.size());
      Cloud& cloud = members.cloud->cloud;
      const auto data = std::as_bytes(members.data);
      cloud.data.assign(data.begin(), data.end());
      cloud.check();
    }
    const std::string_view tree(reinterpret_cast<const char*>(members.tree.data()),
                                members.tree.size());
    scene.result = segmentation_of_tree(Input::view(tree, "state of a segmentation"), *context);
    const Cloud* cloud = members.cloud ? &members.cloud->cloud : nullptr;
    if (cloud &&
        (cloud->width != scene.result.tree.width || cloud->height != scene.result.tree.height))
      throw Error(ErrorKind::bad_data,
                  fmt::format("state of {}: found a cloud of {} x {} points, "
                              "expected {} x {} as in the tree",
                              kThing, cloud->height, cloud->width, scene.result.tree.height,
                              scene.result.tree.width));
    scene.input = members.cloud;
    scene.result.checked = members.is_checked;
    scene.result.plane_note = members.plane_note;
  });
  return scene;
}

segment::Segmentation segmentation_of_tree(const Input& tree, const RunContext& context) {
  segment::Segmentation result;
  result.tree = segment::read_tree(tree);
  if (!result.tree.plane) result.plane_note = "the tree was made without a plane";
  result.barcode = segment::barcode_of(result.tree.merge_tree);
  result.cut = segment::cut(result.tree, result.tree.first_cut, context);
  return result;
}

}  // namespace ph::python
