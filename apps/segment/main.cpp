// SPDX-License-Identifier: MIT
#include "common/run/run_main.hpp"
#include "segment/arguments/arguments.hpp"
#include "segment/run.hpp"

int main(int argc, char** argv) {
  using namespace ph::segment;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run);
}
