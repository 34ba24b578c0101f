// SPDX-License-Identifier: MIT
#include "barcode/arguments/arguments.hpp"
#include "barcode/batch.hpp"
#include "barcode/run.hpp"
#include "common/run/run_main.hpp"

int main(int argc, char** argv) {
  using namespace ph::barcode;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run_all);
}
