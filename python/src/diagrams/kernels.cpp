// SPDX-License-Identifier: MIT
// This file computes kernels for diagrams as Gram matrices.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ph/distances.hpp"
#include "ph/vectorise.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/data/diagrams.hpp"

namespace ph::python {
namespace {

/// The kernel and its width.
struct KernelChoice {
  bool is_scale_space = true;
  double sigma = 1;                ///< used by the scale-space kernel
  WeightedGaussian weighted = {};  ///< used by the weighted Gaussian kernel

  DiagramKernel function() const {
    return [choice = *this](std::span<const Bar> a, std::span<const Bar> b,
                            const RunContext& context) {
      return choice.is_scale_space ? scale_space_kernel(a, b, choice.sigma, context)
                                   : weighted_gaussian_kernel(a, b, choice.weighted, context);
    };
  }
};

KernelChoice choice_of(const std::string& kind, double sigma, double slope, double power) {
  return {kind == "scale_space", sigma, {sigma, slope, power}};
}

/// Returns a square matrix. With `others`, returns a matrix with one column for each of the others.
Block kernels(const std::vector<py::buffer>& diagrams,
              const std::optional<std::vector<py::buffer>>& others, const KernelChoice& choice,
              const RunOptions& options) {
  const Diagrams rows(diagrams);
  const auto size = static_cast<py::ssize_t>(diagrams.size());
  if (!others)
    return Block::of(run(options, false,
                         [&](const RunContext& context) {
                           return gram_matrix(rows.spans(), choice.function(), context);
                         }),
                     {size, size});
  const Diagrams columns(*others);
  // The function diagram_distances accepts any function of two diagrams, including functions that
  // are not distances. It shares the pairs among threads.
  return Block::of(run(options, false,
                       [&](const RunContext& context) {
                         return diagram_distances(rows.spans(), columns.spans(), choice.function(),
                                                  context);
                       }),
                   {size, static_cast<py::ssize_t>(others->size())});
}

}  // namespace

void bind_kernels(py::module_& m) {
  py::class_<KernelChoice>(m, "KernelChoice")
      .def(py::init(&choice_of), py::arg("kind"), py::arg("sigma"), py::arg("slope"),
           py::arg("power"));
  m.def("kernels", &kernels, py::arg("diagrams"), py::arg("others"), py::arg("choice"),
        py::arg("run"));
}

}  // namespace ph::python
