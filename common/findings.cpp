// Text and JSON of findings.
#include "common/findings.h"
#include "common/words.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

namespace ballpit {

using nlohmann::json;

namespace {

constexpr std::size_t longestList = 10'000;

}  // namespace

void Findings::add(const std::string& name, std::int64_t value) {
    entries_.push_back({name, std::to_string(value), json(value).dump()});
}
void Findings::add(const std::string& name, double value) {
    entries_.push_back({name, withDigits(value), json(value).dump()});
}
void Findings::add(const std::string& name, const std::string& value) {
    entries_.push_back({name, value, json(value).dump()});
}
void Findings::list(const std::string& name, const std::vector<std::uint32_t>& values) {
    if (values.size() <= longestList) entries_.push_back({name, "", json(values).dump()});
}
void Findings::list(const std::string& name, const std::vector<double>& values) {
    if (values.size() <= longestList) entries_.push_back({name, "", json(values).dump()});
}
void Findings::list(const std::string& name, const std::vector<Vec3>& values) {
    if (values.size() > longestList) return;
    json rows = json::array();
    for (const Vec3 v : values) rows.push_back({v.x, v.y, v.z});
    entries_.push_back({name, "", rows.dump()});
}

void Findings::print(bool asJson) const {
    if (asJson) {
        std::cout << "{\"title\": " << json(title_);
        for (Entry entry : entries_) {
            std::replace(entry.name.begin(), entry.name.end(), ' ', '_');
            std::cout << ", " << json(entry.name) << ": " << entry.json;
        }
        std::cout << "}\n";
        return;
    }
    std::cout << title_ << '\n';
    std::size_t width = 0;
    for (const Entry& entry : entries_) width = std::max(width, entry.name.size());
    for (const Entry& entry : entries_) {
        if (entry.text.empty()) continue;
        std::cout << "  " << entry.name << std::string(width + 2 - entry.name.size(), ' ')
                  << entry.text << '\n';
    }
}

}  // namespace ballpit
