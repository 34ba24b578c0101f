// SPDX-License-Identifier: MIT
#include "common/run/run_main.hpp"
#include "vectorise/arguments/arguments.hpp"
#include "vectorise/run.hpp"

int main(int argc, char** argv) {
  using namespace ph::vectorise;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run);
}
