// Lists and numbers in messages.
#pragma once

#include <cstdio>
#include <sstream>
#include <string>

namespace ballpit {

/// "a, b, c": nameOf(item) for each item of a range.
template <class Range, class NameOf>
std::string commaSeparated(const Range& range, NameOf nameOf) {
    std::string words;
    for (const auto& item : range) {
        if (!words.empty()) words += ", ";
        words += nameOf(item);
    }
    return words;
}

/// With at most so many significant digits, as short as that allows.
inline std::string withDigits(double value, int digits = 6) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

/// Each line as a comment of a CSV file: "# line".
inline std::string asComments(const std::string& lines) {
    std::istringstream each(lines);
    std::string comments;
    for (std::string line; std::getline(each, line);) comments += "# " + line + '\n';
    return comments;
}

}  // namespace ballpit
