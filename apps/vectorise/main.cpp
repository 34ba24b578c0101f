// SPDX-License-Identifier: MIT
#include "common/run/program.hpp"
#include "vectorise/run.hpp"

int main(int argc, char** argv) {
  return ph::app::run_program(ph::vectorise::kProgram, [argc, argv](std::stop_token stop) {
    return ph::vectorise::run(argc, argv, std::move(stop));
  });
}
