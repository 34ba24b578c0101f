// SPDX-License-Identifier: MIT
#include "tests/fuzz/content.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

template <class Numbers>
bool none_is_nan(const Numbers& numbers) {
  return std::none_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); });
}

/// True if the row offsets of a compressed sparse matrix ascend from 0 to `size`.
bool are_offsets(const std::vector<std::size_t>& offsets, std::size_t size) {
  return !offsets.empty() && offsets.front() == 0 && offsets.back() == size &&
         std::is_sorted(offsets.begin(), offsets.end());
}

/// Checks that the sizes and values of an image agree.
void require_image(const Image& image) {
  std::size_t voxels = 1;
  for (const Index extent : image.extents) {
    require(extent >= 0, "an image has a negative extent");
    voxels *= static_cast<std::size_t>(extent);
  }
  require(voxels == image.values.size(), "the sizes of an image are not those of its values");
  require(image.masked || none_is_nan(image.values), "an image without a mask has a NaN");
}

void add_cell(Content& content, std::span<const Index> numbers) {
  for (const Index number : numbers) require(number >= 0, "a cell has a negative number");
  content.numbers.push_back(static_cast<double>(numbers.size()));
  content.add(numbers);
}

bool is_older(const Bar& a, const Bar& b) {
  return std::tie(a.dim, a.birth, a.death) < std::tie(b.dim, b.birth, b.death);
}

}  // namespace

bool operator==(const Content& a, const Content& b) {
  return a.head == b.head && a.ends == b.ends && a.numbers.size() == b.numbers.size() &&
         std::equal(a.numbers.begin(), a.numbers.end(), b.numbers.begin(),
                    [](double x, double y) { return std::memcmp(&x, &y, sizeof(double)) == 0; });
}

Content content_of(const Points& points) {
  Content content;
  content.head = fmt::format("R^{}", points.cols());
  for (Index i = 0; i < points.rows(); ++i) {
    const std::span row(points.data() + i * points.cols(), static_cast<std::size_t>(points.cols()));
    for (const double x : row) require(std::isfinite(x), "a coordinate is not finite");
    content.add(row);
    content.end_row();
  }
  return content;
}

Content content_of(const DistanceMatrix& distances) {
  Content content;
  for (Index i = 0; i < distances.size(); ++i) {
    for (Index j = 0; j < i; ++j) content.numbers.push_back(distances(i, j));
    content.end_row();
  }
  for (const double d : content.numbers) require(d >= 0, "a distance is negative or NaN");
  return content;
}

Content content_of(const SparseDistances& sparse) {
  Content content;
  content.head = fmt::format("{} points", sparse.size());
  for (const WeightedEdge& edge : sparse.edges()) {
    require(0 <= edge.u && edge.u < edge.v && edge.v < sparse.size(), "an edge is out of range");
    require(edge.value >= 0 && edge.value < kInfinity, "an edge has no finite distance");
    content.numbers.insert(content.numbers.end(),
                           {static_cast<double>(edge.u), static_cast<double>(edge.v), edge.value});
    content.end_row();
  }
  return content;
}

Content content_of(const Image& image) {
  require_image(image);
  Content content;
  content.head = fmt::format("{}", fmt::join(image.extents, " x "));
  for (const double value : image.values)  // an absent voxel is any NaN
    content.numbers.push_back(std::isnan(value) ? kInfinity : value);
  content.end_row();
  return content;
}

Content content_of(const PerseusImage& perseus) {
  require_image(perseus.image);
  const auto& extents = perseus.image.extents;
  require(perseus.periodic.size() == extents.size(), "an axis is neither periodic nor not");
  Content content;
  content.head = fmt::format("{} axes, periodic: {}", extents.size(),
                             fmt::join(perseus.periodic.begin(), perseus.periodic.end(), " "));
  std::vector<Index> place(extents.size());
  for (const double value : perseus.image.values) {
    if (!std::isnan(value)) {
      content.add(place);
      content.numbers.push_back(value);
      content.end_row();
    }
    for (std::size_t axis = place.size(); axis-- > 0 && ++place[axis] == extents[axis];)
      place[axis] = 0;
  }
  return content;
}

Content content_of(const SimplicesInput& simplices) {
  const SimplexList& list = simplices.simplices;
  require(are_offsets(list.offsets, list.vertices.size()), "simplices overlap");
  require(list.values.size() == list.size() && simplices.lines.size() == list.size(),
          "a simplex lacks its value or line");
  require(none_is_nan(list.values), "the value of a simplex is NaN");
  Content content;
  for (std::size_t i = 0; i < list.size(); ++i) {
    require(!list.simplex(i).empty(), "a simplex has no vertices");
    for (const Index v : list.simplex(i)) require(v >= 0, "a vertex is negative");
    content.add(list.simplex(i));
    content.numbers.push_back(list.values[i]);
    content.end_row();
  }
  return content;
}

Content content_of(const BoundaryInput& boundary) {
  const BoundaryMatrix& m = boundary.matrix;
  require(are_offsets(m.offsets, m.rows.size()), "columns overlap");
  require(m.offsets.size() == m.size() + 1 && boundary.places.size() == m.size(),
          "a column lacks its facets or place");
  require(m.values.empty() || m.values.size() == m.size(), "a column lacks its value");
  require(none_is_nan(m.values), "the value of a column is NaN");
  Content content;
  for (std::size_t i = 0; i < m.size(); ++i) {
    require(m.dims[i] >= 0, "a dimension is negative");
    content.numbers.push_back(m.dims[i]);
    for (std::size_t k = m.offsets[i]; k < m.offsets[i + 1]; ++k) {
      require(m.rows[k] >= 0 && m.rows[k] < static_cast<Index>(m.size()),
              "a facet is out of range");
      content.numbers.push_back(static_cast<double>(m.rows[k]));
    }
    content.end_row();
  }
  for (const double value : m.values) {
    content.numbers.push_back(value);
    content.end_row();
  }
  return content;
}

Content content_of(const Mesh& mesh) {
  require(mesh.vertices.cols() == 3, "a vertex has not three coordinates");
  require(are_offsets(mesh.offsets, mesh.corners.size()), "faces overlap");
  Content content;
  content.head = fmt::format("{} vertices", mesh.vertices.rows());
  for (Index i = 0; i < mesh.vertices.rows(); ++i) {
    for (Index k = 0; k < 3; ++k) content.numbers.push_back(mesh.vertices(i, k));
    content.end_row();
  }
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    for (std::size_t k = mesh.offsets[face]; k < mesh.offsets[face + 1]; ++k) {
      require(mesh.corners[k] >= 0 && mesh.corners[k] < mesh.vertices.rows(),
              "a corner is out of range");
      content.numbers.push_back(static_cast<double>(mesh.corners[k]));
    }
    content.end_row();
  }
  return content;
}

Content content_of(const Cloud& cloud) {
  require(cloud.width >= 0 && cloud.height >= 0, "a cloud has a negative size");
  const auto points = static_cast<std::size_t>(cloud.size());
  require(cloud.data.size() == points * cloud.stride, "the points of a cloud are not its data");
  Content content;
  if (cloud.organised()) content.head = fmt::format("{} x {}, ", cloud.width, cloud.height);
  content.head += fmt::format("from {}:", fmt::join(cloud.viewpoint, " "));
  for (const CloudField& field : cloud.fields) {
    const std::size_t end = field.offset + field.count * size_of(field.type);
    require(field.count > 0 && end <= cloud.stride, "a field is not inside its point");
    content.head += fmt::format(" {} {} {}", field.name, static_cast<int>(field.type), field.count);
  }
  for (std::size_t i = 0; i < points && cloud.stride > 0; ++i) {
    for (const CloudField& field : cloud.fields) {
      const std::byte* from = cloud.data.data() + i * cloud.stride + field.offset;
      for (std::size_t k = 0; k < field.count * size_of(field.type); ++k)
        content.numbers.push_back(std::to_integer<unsigned>(from[k]));
    }
    content.end_row();
  }
  return content;
}

Content content_of(const Raster& raster) {
  require(raster.width > 0 && raster.height > 0, "a picture is empty");
  require(raster.channels >= 1 && raster.channels <= 4, "a picture has no such colours");
  require(raster.bits == 8 || raster.bits == 16, "a picture has neither 8 nor 16 bits");
  const auto row = static_cast<std::size_t>(raster.width * raster.channels);
  require(raster.samples.size() == row * static_cast<std::size_t>(raster.height),
          "a picture has too few samples");
  Content content;
  content.head = fmt::format("{} channels, {} bits", raster.channels, raster.bits);
  for (const std::uint16_t sample : raster.samples) {
    require(sample >> raster.bits == 0, "a sample is out of range");
    content.numbers.push_back(sample);
    if (content.numbers.size() % row == 0) content.end_row();
  }
  return content;
}

Content content_of(const Barcode& barcode) {
  require(std::is_sorted(barcode.begin(), barcode.end(), is_older), "bars are not in order");
  Content content;
  content.head = fmt::format("cells {}, representatives {}", static_cast<int>(barcode.cell_kind()),
                             static_cast<int>(barcode.representatives()));
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    const Bar& bar = barcode[i];
    require(bar.dim >= 0 && bar.birth <= bar.death && bar.birth < kInfinity, "a bar is none");
    content.numbers.insert(content.numbers.end(),
                           {static_cast<double>(bar.dim), bar.birth, bar.death});
    const auto death = barcode.death_cell(i);
    if (!barcode.birth_cell(i).numbers.empty() || death) {
      add_cell(content, barcode.birth_cell(i).numbers);
      if (death) add_cell(content, death->numbers);
    }
    if (barcode.representatives() != Representatives::none) {
      const InputChain chain = barcode.representative(i);
      for (std::size_t k = 0; k < chain.size(); ++k) {
        add_cell(content, chain.cell(k).numbers);
        require(chain.coefficient(k) != 0, "a coefficient is zero");
        content.numbers.push_back(static_cast<double>(chain.coefficient(k)));
      }
      // The list of the voxels is in no particular order.
      std::vector<Index> voxels(barcode.voxels(i).begin(), barcode.voxels(i).end());
      std::ranges::sort(voxels);
      require(std::ranges::adjacent_find(voxels) == voxels.end(), "a voxel is listed twice");
      for (const auto list :
           {std::span<const Index>(voxels), barcode.birth_voxel(i), barcode.death_voxel(i)})
        if (!list.empty()) add_cell(content, list);
    }
    content.end_row();
  }
  return content;
}

Content content_of(const segment::SceneTree& scene) {
  Content content;
  content.head = segment::tree_bytes(scene);
  const segment::SceneCut cut = segment::cut(scene, scene.first_cut);
  require(cut.labels.size() == static_cast<std::size_t>(scene.width * scene.height),
          "a point has no label");
  for (const std::uint32_t label : cut.labels) {
    require(label <= cut.segments.size(), "a label without a segment");
    content.numbers.push_back(label);
    content.end_row();
  }
  return content;
}

Content content_of(const ReadResult& result) {
  require(result.format != Format::automatic && !result.description.empty(),
          "a result does not say what it is");
  return std::visit([](const auto& data) { return content_of(data); }, result.data);
}

Content content_of(const std::vector<double>& values) {
  require(none_is_nan(values), "a value is NaN");
  Content content;
  for (const double value : values) {
    content.numbers.push_back(value);
    content.end_row();
  }
  return content;
}

}  // namespace ph::fuzz
