// SPDX-License-Identifier: MIT
#include "apps/cluster/arguments/arguments.hpp"
#include "apps/cluster/run.hpp"
#include "apps/common/run/run_main.hpp"

int main(int argc, char** argv) {
  using namespace ph::cluster;
  return ph::app::run_main(kProgram, argc, argv, parse_arguments, run);
}
