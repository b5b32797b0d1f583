// A program's command line, parsed by CLI11: what happens when there is nothing to run.
#pragma once

#include <CLI/CLI.hpp>

#include <iostream>
#include <optional>

#include "common/error.h"

namespace ballpit {

/// Parses the command line. The exit status, if that is all: help was asked for and printed, or
/// the input was bad and one line says so.
inline std::optional<int> endAfterParsing(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
        return std::nullopt;
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        std::cerr << "error: " << error.what() << " (--help shows the options)\n";
        return exitBadInput;
    }
}

}  // namespace ballpit
