// SPDX-License-Identifier: MIT
#include "apps/common/run/run_main.hpp"
#include "apps/distance/arguments/arguments.hpp"
#include "apps/distance/run.hpp"

int main(int argc, char** argv) {
  using namespace ph::distance_program;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run);
}
