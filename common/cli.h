// A program's command line, parsed by CLI11: the options that several programs have, and what
// happens when there is nothing to run.
#pragma once

#include <CLI/CLI.hpp>

#include <iostream>
#include <optional>
#include <string>

#include "common/device.h"
#include "common/error.h"

namespace ballpit {

/// --device, which is `device` unless it is given.
inline void addDevice(CLI::App& app, Device& device) {
    app.add_option_function<std::string>(
           "--device",
           [&device](const std::string& word) {
               device = word == name(Device::cuda) ? Device::cuda : Device::cpu;
           },
           "cuda or cpu")
        ->check(CLI::IsMember({"cuda", "cpu"}))
        ->default_str(name(device));
}

/// --out and --stamp of programs that write tables.
inline void addOutput(CLI::App& app, std::string& out, std::string& stamp) {
    app.add_option("--out", out, "folder for the files")->capture_default_str();
    app.add_option("--stamp", stamp, "lines for the files' head: machine, commit, command");
}

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
