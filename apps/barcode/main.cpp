// SPDX-License-Identifier: MIT
#include "barcode/arguments/arguments.hpp"
#include "barcode/batch.hpp"
#include "barcode/run.hpp"
#include "common/run/program.hpp"

int main(int argc, char** argv) {
  return ph::app::run_program(ph::barcode::kProgram, [&](const std::stop_token& stop) {
    ph::barcode::Arguments arguments;
    if (const auto answer = ph::barcode::parse_arguments(argc, argv, arguments))
      return ph::app::answer_command_line(*answer);
    ph::app::Session session("ph-barcode", arguments.common, stop);
    return ph::barcode::run_all(arguments, session);
  });
}
