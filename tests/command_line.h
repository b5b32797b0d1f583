// Calls runMain with a command line, and catches all that comes of it.
#pragma once

#include <functional>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/options.h"

namespace ballpit::test {

/// What a command line leads to: the exit code, what was printed, and the options of the run.
struct CommandLine {
    int exitCode;
    std::string output, errors;
    Options options;
    bool ran = false;
};

/// Turns a stream's text into a string for a scope.
class Captured {
public:
    explicit Captured(std::ostream& stream)
        : stream_(stream), before_(stream.rdbuf(text_.rdbuf())) {}
    ~Captured() { stream_.rdbuf(before_); }
    std::string text() const { return text_.str(); }

private:
    std::ostringstream text_;
    std::ostream& stream_;
    std::streambuf* before_;
};

/// `line` holds the arguments, separated by spaces.
inline CommandLine runWith(const std::string& line,
                           const std::function<int(const Options&)>& run = nullptr) {
    std::istringstream stream("ballpit " + line);
    std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    CommandLine result{};
    const Captured output(std::cout), errors(std::cerr);
    result.exitCode = runMain(static_cast<int>(arguments.size()), arguments.data(), "A test.", {},
                              [&](const Options& options) {
                                  result.options = options;
                                  result.ran = true;
                                  return run ? run(options) : static_cast<int>(exitOk);
                              });
    result.output = output.text();
    result.errors = errors.text();
    return result;
}

}  // namespace ballpit::test
