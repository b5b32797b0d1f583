// What can go wrong, and the exit code each kind of failure has in every executable.
#pragma once

#include <iostream>
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

/// A CUDA call or kernel failed.
struct CudaError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Calls `run`, which returns an exit code; an exception becomes one line on stderr and its code.
template <class Run>
int reportingErrors(Run run) {
    const auto report = [](const std::exception& error, int code) {
        std::cerr << "error: " << error.what() << '\n';
        return code;
    };
    try {
        return run();
    } catch (const InputError& error) {
        return report(error, exitBadInput);
    } catch (const NotFiniteError& error) {
        return report(error, exitNotFinite);
    } catch (const std::exception& error) {
        return report(error, exitFailed);
    }
}

}  // namespace ballpit
