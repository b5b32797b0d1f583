// What can go wrong, and the exit code each kind of failure has in every executable.
#pragma once

#include <stdexcept>
#include <string>

namespace ballpit {

enum ExitCode { exitOk = 0, exitFailed = 1, exitBadInput = 2, exitNotFinite = 3 };

/// The user asked for something that cannot be done: one line saying what is wrong, where, and
/// what would be right. Executables print it and end with exit code 2, having written nothing.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A body's position or velocity stopped being a finite number: executables save the last good
/// state and end with exit code 3.
struct NotFiniteError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace ballpit
