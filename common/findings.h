// What a chapter's executable found, as lines for people or one JSON object for tools.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/vec3.cuh"

namespace ballpit {

class Findings {
public:
    explicit Findings(std::string title) : title_(std::move(title)) {}

    /// A line "name   value".
    void add(const std::string& name, std::int64_t value);
    void add(const std::string& name, double value);
    void add(const std::string& name, const std::string& value);

    /// Lists go into the JSON alone, for figures; one of more than 10 000 elements is left out.
    void list(const std::string& name, const std::vector<std::uint32_t>& values);
    void list(const std::string& name, const std::vector<double>& values);
    void list(const std::string& name, const std::vector<Vec3>& values);

    /// Text with the title above it, or one line of JSON in which a name's blanks are "_".
    void print(bool json) const;

private:
    struct Entry {
        std::string name, text, json;
    };
    std::string title_;
    std::vector<Entry> entries_;
};

}  // namespace ballpit
