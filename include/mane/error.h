#pragma once

#include <stdexcept>
#include <string>

namespace mane {

/// The user gave something that cannot be used. The message says where, what was found and what was
/// expected; the command line prints it and ends with exit code 2.
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The state became non-finite. The message names the wisp, the time and the likely parameter.
class SimulationError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace mane
