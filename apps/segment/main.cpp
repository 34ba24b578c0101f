// SPDX-License-Identifier: MIT
#include "common/run/program.hpp"
#include "segment/run.hpp"

int main(int argc, char** argv) {
  return ph::app::run_program(ph::segment::kProgram, [argc, argv](std::stop_token stop) {
    return ph::segment::run(argc, argv, std::move(stop));
  });
}
