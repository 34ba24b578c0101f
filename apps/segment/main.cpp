// SPDX-License-Identifier: MIT
#include "apps/common/run/run_main.hpp"
#include "apps/segment/arguments/arguments.hpp"
#include "apps/segment/run.hpp"

int main(int argc, char** argv) {
  using namespace ph::segment;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run);
}
