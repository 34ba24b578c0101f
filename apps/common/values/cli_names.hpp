// SPDX-License-Identifier: MIT
#pragma once
// This header declares the classes of CLI11, because the header of CLI11 takes seconds to compile
// and few files use it.

namespace CLI {

class App;
class Option;

}  // namespace CLI
