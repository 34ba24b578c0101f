// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/batch.hpp"
#include "apps/barcode/run.hpp"
#include "apps/common/run/run_main.hpp"

int main(int argc, char** argv) {
  using namespace ph::barcode;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run_all);
}
