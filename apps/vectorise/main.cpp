// SPDX-License-Identifier: MIT
#include "apps/common/run/run_main.hpp"
#include "apps/vectorise/arguments/arguments.hpp"
#include "apps/vectorise/run.hpp"

int main(int argc, char** argv) {
  using namespace ph::vectorise;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run);
}
