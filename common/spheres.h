// Bodies on the host, numbered as the user numbers them: body k is element k of every array.
#pragma once

#include <string>
#include <vector>

#include "common/vec3.cuh"

namespace ballpit {

struct Spheres {
    std::vector<Vec3> positions;      ///< m
    std::vector<Vec3> velocities;     ///< m/s
    std::vector<float> radii;         ///< m, 0 or more
    std::vector<float> masses;        ///< kg, above 0
    std::vector<float> restitutions;  ///< 0 to 1
    std::vector<Vec3> colors;         ///< red, green, blue in 0 to 1

    std::size_t count() const { return positions.size(); }

    void add(Vec3 position, Vec3 velocity, float radius, float mass, float restitution,
             Vec3 color = {0.7f, 0.7f, 0.7f}) {
        positions.push_back(position);
        velocities.push_back(velocity);
        radii.push_back(radius);
        masses.push_back(mass);
        restitutions.push_back(restitution);
        colors.push_back(color);
    }
};

/// The k-th of eight bright colours that are easily told apart, in turn.
Vec3 paletteColor(std::size_t k);

/// Empty if body values are usable, else what is wrong with value k: "radius -0.5: ...".
std::string faultOfPosition(Vec3 value);
std::string faultOfVelocity(Vec3 value);
std::string faultOfRadius(float value);
std::string faultOfMass(float value);
std::string faultOfRestitution(float value);

}  // namespace ballpit
