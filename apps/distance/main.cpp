// SPDX-License-Identifier: MIT
#include "common/run/run_main.hpp"
#include "distance/arguments/arguments.hpp"
#include "distance/run.hpp"

int main(int argc, char** argv) {
  using namespace ph::distance_program;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run);
}
