// How each scene is made.
#include "common/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "common/device.h"
#include "common/error.h"
#include "common/random.h"
#include "common/words.h"
#include "stability/catalogue.h"

namespace ballpit {

namespace {

constexpr float standardGravity = 9.81f;
constexpr float sphereVolumeFactor = 4.18879020f;  // 4 pi / 3

/// Balls placed so far, by cell: finds whether a new one has room.
class PlacedBalls {
public:
    explicit PlacedBalls(float cellSize) : cellSize_(cellSize) {}

    bool hasRoom(Vec3 position, float radius) const {
        const auto [x, y, z] = cellOf(position);
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    if (!cellHasRoom(key(x + dx, y + dy, z + dz), position, radius)) return false;
        return true;
    }

    void add(Vec3 position, float radius) {
        const auto [x, y, z] = cellOf(position);
        cells_[key(x, y, z)].push_back({position.x, position.y, position.z, radius});
    }

private:
    struct Cell {
        int x, y, z;
    };
    Cell cellOf(Vec3 p) const {
        const auto along = [&](float c) { return static_cast<int>(std::floor(c / cellSize_)); };
        return {along(p.x), along(p.y), along(p.z)};
    }
    static std::uint64_t key(int x, int y, int z) {
        const auto bits = [](int c) { return static_cast<std::uint64_t>(c + (1 << 20)); };
        return bits(x) | bits(y) << 21 | bits(z) << 42;
    }
    bool cellHasRoom(std::uint64_t cell, Vec3 position, float radius) const {
        const auto found = cells_.find(cell);
        if (found == cells_.end()) return true;
        return std::none_of(found->second.begin(), found->second.end(), [&](Vec4 other) {
            const float reach = radius + other.w;
            return lengthSquared(position - xyz(other)) <= reach * reach;
        });
    }

    float cellSize_;
    std::unordered_map<std::uint64_t, std::vector<Vec4>> cells_;
};

/// Balls along each edge of the smallest cube that holds `count`.
int cubeSide(int count) { return static_cast<int>(std::ceil(std::cbrt(double(count)) - 1e-9)); }

/// Equal balls in a cube of `side` m: the world of the measuring scenes.
Scene emptyCube(const std::string& name, float side, float cellSize) {
    return {name, {}, {{0, 0, 0}, {side, side, side}}, cellSize, {0, 0, 0}, 0.0f, 1.0f / 60.0f};
}

}  // namespace

std::vector<Vec3> nonOverlappingPositions(const std::vector<float>& radii, Bounds box,
                                          std::uint64_t seed) {
    constexpr int tries = 10000;
    Random random(seed);
    const float largest = radii.empty() ? 0.0f : *std::max_element(radii.begin(), radii.end());
    PlacedBalls placed(std::max(2.0f * largest, 1e-3f));
    std::vector<Vec3> positions;
    for (const float radius : radii) {
        const Vec3 margin{radius, radius, radius};
        const Bounds room{box.lower + margin, box.upper - margin};
        int attempt = 0;
        Vec3 position = random.uniformIn(room);
        while (!placed.hasRoom(position, radius) && ++attempt < tries)
            position = random.uniformIn(room);
        if (attempt == tries)
            throw InputError("count " + std::to_string(radii.size()) +
                             ": these balls do not fit without overlap; about " +
                             std::to_string(positions.size()) + " do");
        placed.add(position, radius);
        positions.push_back(position);
    }
    return positions;
}

Scene makeGravityFall(int count, std::uint64_t seed) {
    constexpr float roomyCount = 8000.0f, density = 1.0f;
    const float scale = static_cast<float>(std::cbrt(std::min(1.0, double(roomyCount) / count)));
    Scene scene{"gravity_fall",
                {},
                {{-20, 0, -20}, {20, 40, 20}},
                2.0f * scale,
                {0, -standardGravity, 0},
                0.01f,
                1.0f / 60.0f};
    Random random(seed);
    std::vector<float> radii;
    for (int k = 0; k < count; ++k) radii.push_back(scale * random.uniform(0.3f, 0.9f));
    const std::vector<Vec3> positions =
        nonOverlappingPositions(radii, {{-18, 6, -18}, {18, 39, 18}}, random.next());
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const float radius = radii[k];
        const float mass = density * sphereVolumeFactor * radius * radius * radius;
        const Vec3 velocity = random.uniformIn({{-4, -2, -4}, {4, 2, 4}});
        scene.spheres.add(positions[k], velocity, radius, mass, random.uniform(0.3f, 0.9f),
                          paletteColor(k));
    }
    return scene;
}

Scene makeUniform(int count, std::uint64_t seed) {
    // One contact a ball: number density n with n 4/3 pi (2r)^3 = 1.
    const float radius = 0.5f;
    const float side =
        static_cast<float>(std::cbrt(double(count) * sphereVolumeFactor)) + 2.0f * radius;
    Scene scene = emptyCube("uniform", side, 2.2f * radius);
    Random random(seed);
    const Bounds room{{radius, radius, radius}, {side - radius, side - radius, side - radius}};
    for (int k = 0; k < count; ++k) {
        const Vec3 position = random.uniformIn(room);
        scene.spheres.add(position, random.uniformIn({{-1, -1, -1}, {1, 1, 1}}), radius, 1.0f, 1.0f,
                          paletteColor(static_cast<std::size_t>(k)));
    }
    return scene;
}

namespace {

/// Adds `count` balls on a simple cubic lattice, layer by layer from the floor up, each shifted at
/// random by up to `jitter`; the velocities at random in each direction up to `speed`.
void addLattice(Scene& scene, int count, float spacing, float jitter, float speed,
                float restitution, std::uint64_t seed) {
    constexpr float radius = 0.5f, mass = 1.0f;
    const int side = cubeSide(count);
    const float first = radius + jitter;
    Random random(seed);
    for (int k = 0; k < count; ++k) {
        const Vec3 place{static_cast<float>(k % side), static_cast<float>(k / side / side),
                         static_cast<float>(k / side % side)};
        const Vec3 shift =
            random.uniformIn({{-jitter, -jitter, -jitter}, {jitter, jitter, jitter}});
        const Vec3 velocity = random.uniformIn({{-speed, -speed, -speed}, {speed, speed, speed}});
        scene.spheres.add(Vec3{first, first, first} + spacing * place + shift, velocity, radius,
                          mass, restitution, paletteColor(static_cast<std::size_t>(k)));
    }
}

float latticeLength(int count, float spacing, float jitter) {
    return spacing * static_cast<float>(cubeSide(count) - 1) + 2.0f * (0.5f + jitter);
}

}  // namespace

Scene makeGas(int count, std::uint64_t seed) {
    // pi/6 / 1.03^3 = 0.48. Cells with a fifth of room, so that the grid need not be built twice.
    constexpr float spacing = 1.03f, jitter = 0.0135f, speed = 1.5f;
    Scene scene = emptyCube("gas", latticeLength(count, spacing, jitter), 1.2f);
    addLattice(scene, count, spacing, jitter, speed, 1.0f, seed);
    return scene;
}

Scene makePile(int count, std::uint64_t seed) {
    constexpr float spacing = 0.98f, jitter = 0.01f;
    Scene scene = emptyCube("pile", latticeLength(count, spacing, jitter), 1.1f);
    scene.gravity = {0, -standardGravity, 0};
    addLattice(scene, count, spacing, jitter, 0.0f, 0.3f, seed);
    return scene;
}

namespace {

constexpr SceneKind sceneKinds[] = {{"gravity_fall", 500, makeGravityFall},
                                    {"uniform", 500, makeUniform},
                                    {"gas", 500, makeGas},
                                    {"pile", 500, makePile},
                                    {"head_on", 10, makeHeadOn},
                                    {"static_overlap", 512, makeStaticOverlap},
                                    {"falling_balls", 9, makeFallingBalls},
                                    {"break", 16, makeBreak}};

/// InputError unless the host has room for the balls: asked before a scene of billions is begun.
void requireRoomFor(int count) {
    constexpr std::size_t bytesPerBall = 4 * sizeof(Vec3) + 4 * sizeof(float);
    const std::size_t needed = bytesPerBall * static_cast<std::size_t>(count);
    if (needed <= freeMemory(Device::cpu)) return;
    throw InputError("count " + std::to_string(count) + " needs " + std::to_string(needed >> 30) +
                     " GiB for the balls alone, but the machine has " +
                     std::to_string(freeMemory(Device::cpu) >> 30) + " GiB free: use fewer balls");
}

}  // namespace

SceneKind sceneKind(const std::string& name) {
    for (const SceneKind& kind : sceneKinds)
        if (name == kind.name) return kind;
    for (const stability::Entry& entry : stability::catalogue())
        if (name == entry.name)
            return {entry.name, entry.usualCount, entry.make, entry.leastCount, entry.mostCount};
    throw InputError("scene '" + name + "': known scenes are " + sceneNames());
}

std::string sceneNames() {
    const auto nameOf = [](const auto& kind) { return kind.name; };
    return commaSeparated(sceneKinds, nameOf) + ", " +
           commaSeparated(stability::catalogue(), nameOf);
}

namespace {

void requireCount(const SceneKind& kind, int count) {
    if (count < 1) throw InputError("count " + std::to_string(count) + ": at least 1 ball");
    if (count >= kind.leastCount && count <= kind.mostCount) return;
    const std::string least = std::to_string(kind.leastCount),
                      most = std::to_string(kind.mostCount);
    throw InputError("count " + std::to_string(count) + ": the scene " + kind.name + " has " +
                     (least == most ? least : least + " to " + most) + " balls");
}

}  // namespace

Scene makeScene(const std::string& name, int count, std::uint64_t seed) {
    const SceneKind kind = sceneKind(name);
    requireCount(kind, count);
    requireRoomFor(count);
    return kind.make(count, seed);
}

}  // namespace ballpit
