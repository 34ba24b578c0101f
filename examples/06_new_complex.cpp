// SPDX-License-Identifier: MIT
// A complex of your own needs three small functions, and runs on every engine that needs no more
// than these. Here it is a polygon whose sides appear one by one, followed by the disc inside.
#include <iostream>
#include <ph/custom.hpp>
#include <ph/ph.hpp>

// A polygon with n corners. The cells are numbered: 0 … n-1 are the corners, n … 2n-1 the sides
// (side n+i joins corner i to the next corner), and 2n is the disc. The value of each cell is its
// number.
class Polygon : public ph::CellFiltration<Polygon, 2, int> {
 public:
  explicit Polygon(int corners) : n_(corners) {}

  double value(Cell cell) const { return cell; }
  template <class Visit>
  void for_each_cell(int dim, Visit visit) const {
    for (int i = first(dim); i < first(dim + 1); ++i) visit(i);
  }
  template <class Visit>
  void for_each_facet(int dim, Cell cell, Visit visit) const {
    if (dim == 1) {
      const int corner = cell - n_;
      visit((corner + 1) % n_, +1);
      visit(corner, -1);
    }
    if (dim == 2)
      for (int side = n_; side < 2 * n_; ++side) visit(side, +1);
  }

 private:
  int first(int dim) const { return dim <= 0 ? 0 : dim == 1 ? n_ : dim == 2 ? 2 * n_ : 2 * n_ + 1; }

  int n_;
};

int main() {
  const Polygon polygon(6);
  const ph::Barcode bars = ph::persistence(polygon, {.field = 3});
  for (const ph::Bar& bar : bars)
    std::cout << "H" << bar.dim << " [" << bar.birth << ", " << bar.death << ")\n";

  // The engine `oracle` needs only the functions of the class above.
  const ph::Barcode truth = ph::persistence(polygon, {.field = 3, .engine = ph::Engine::standard});
  std::cout << (ph::first_difference(bars, truth).empty() ? "agrees" : "disagrees")
            << " with the oracle\n";
}
