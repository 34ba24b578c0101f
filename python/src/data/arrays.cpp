// SPDX-License-Identifier: MIT
#include "python/src/data/arrays.hpp"

#include "python/src/calls/bindings.hpp"

namespace ph::python {

Block Block::of(Points&& points) {
  const std::vector<py::ssize_t> shape{points.rows(), points.cols()};
  auto owner = std::make_shared<Points>(std::move(points));
  return Block(std::shared_ptr<void>(owner, owner->data()), sizeof(double), letter_of<double>(),
               shape, false);
}

Block Block::of(const Image& image, std::shared_ptr<const RunContext> context) {
  struct Owner {
    std::shared_ptr<const RunContext> context;  // this member is destroyed last
    Voxels voxels;
  };
  const auto owner = std::make_shared<const Owner>(Owner{std::move(context), image.values});
  const Voxels& voxels = owner->voxels;
  return with_voxels(voxels.type(), voxels.data(), [&]<class T>(const T* first) {
    return Block(std::shared_ptr<void>(owner, const_cast<T*>(first)), sizeof(T), letter_of<T>(),
                 std::vector<py::ssize_t>(image.extents.begin(), image.extents.end()),
                 voxels.is_borrowed());
  });
}

py::buffer_info Block::info() const {
  std::vector<py::ssize_t> strides(shape_.size(), item_);
  for (std::size_t k = shape_.size(); k-- > 1;) strides[k - 1] = strides[k] * shape_[k];
  return py::buffer_info(data_.get(), item_, format_, static_cast<py::ssize_t>(shape_.size()),
                         shape_, std::move(strides), is_read_only_);
}

VoxelType voxel_type_of(const py::buffer_info& array) {
  if (holds<std::uint8_t>(array)) return VoxelType::uint8;
  if (holds<std::uint16_t>(array)) return VoxelType::uint16;
  if (holds<std::int16_t>(array)) return VoxelType::int16;
  if (holds<float>(array)) return VoxelType::float32;
  if (holds<double>(array)) return VoxelType::float64;
  throw Error(ErrorKind::internal, "an image of the wrong type reached _core");
}

PointsView points_of(const py::buffer_info& array) {
  constexpr py::ssize_t size = sizeof(double);
  if (!holds<double>(array) || array.ndim != 2 || array.strides[0] % size != 0 ||
      array.strides[1] % size != 0)
    throw Error(ErrorKind::internal, "points of the wrong type or layout reached _core");
  return {static_cast<const double*>(array.ptr), array.shape[0], array.shape[1],
          array.strides[0] / size, array.strides[1] / size};
}

void bind_arrays(py::module_& m) {
  py::class_<Block>(m, "Block", py::buffer_protocol()).def_buffer(&Block::info);
}

}  // namespace ph::python
