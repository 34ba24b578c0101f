// SPDX-License-Identifier: MIT
#include "common/run/program.hpp"
#include "distance/run.hpp"

int main(int argc, char** argv) {
  return ph::app::run_program(ph::distance_program::kProgram, [argc, argv](std::stop_token stop) {
    return ph::distance_program::run(argc, argv, std::move(stop));
  });
}
