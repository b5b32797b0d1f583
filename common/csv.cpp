// Reading and writing the CSV of bodies.
#include "common/csv.h"

#include <charconv>
#include <cstdio>
#include <fstream>
#include <string_view>

#include "common/error.h"
#include "common/whole_file.h"

namespace ballpit {

namespace {

constexpr const char* header = "x,y,z,vx,vy,vz,radius,mass,restitution,red,green,blue";
constexpr std::size_t requiredFields = 9, allFields = 12;

[[noreturn]] void fail(const std::string& path, int line, const std::string& what) {
    throw InputError(path + ":" + std::to_string(line) + ": " + what);
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<float> parseFields(const std::string& path, int number, std::string_view line) {
    std::vector<float> fields;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        const std::string_view field = trimmed(line.substr(begin, end - begin));
        float value = 0.0f;
        const auto [stop, error] =
            std::from_chars(field.data(), field.data() + field.size(), value);
        if (field.empty() || error != std::errc() || stop != field.data() + field.size())
            fail(path, number,
                 "field " + std::to_string(fields.size() + 1) + " is '" + std::string(field) +
                     "', not a number");
        fields.push_back(value);
        begin = end + 1;
    }
    if (fields.size() != requiredFields && fields.size() != allFields)
        fail(path, number,
             std::to_string(fields.size()) +
                 " fields: 9 are needed (x,y,z,vx,vy,vz,radius,mass,restitution) or "
                 "12 with red,green,blue");
    return fields;
}

void addChecked(Spheres& spheres, const std::string& path, int line, const std::vector<float>& f) {
    const Vec3 position{f[0], f[1], f[2]}, velocity{f[3], f[4], f[5]};
    for (const std::string& fault :
         {faultOfPosition(position), faultOfVelocity(velocity), faultOfRadius(f[6]),
          faultOfMass(f[7]), faultOfRestitution(f[8])})
        if (!fault.empty()) fail(path, line, fault);
    const Vec3 grey{0.7f, 0.7f, 0.7f};
    spheres.add(position, velocity, f[6], f[7], f[8],
                f.size() == allFields ? Vec3{f[9], f[10], f[11]} : grey);
}

}  // namespace

Spheres readSpheres(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw InputError(path + ": cannot be read (does the file exist?)");
    Spheres spheres;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        const std::string_view text = trimmed(line);
        const bool isHeader = number == 1 && text.rfind("x,", 0) == 0;
        if (text.empty() || isHeader) continue;
        addChecked(spheres, path, number, parseFields(path, number, text));
    }
    if (spheres.count() == 0) throw InputError(path + ": no balls in it; one line each: " + header);
    return spheres;
}

void writeSpheres(const std::string& path, const Spheres& spheres) {
    std::string text = std::string(header) + '\n';
    for (std::size_t k = 0; k < spheres.count(); ++k) {
        const Vec3 p = spheres.positions[k], v = spheres.velocities[k], c = spheres.colors[k];
        char line[256];
        // Nine digits give a float back exactly.
        std::snprintf(line, sizeof line,
                      "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", p.x, p.y,
                      p.z, v.x, v.y, v.z, spheres.radii[k], spheres.masses[k],
                      spheres.restitutions[k], c.x, c.y, c.z);
        text += line;
    }
    writeWhole(path, text);
}

}  // namespace ballpit
